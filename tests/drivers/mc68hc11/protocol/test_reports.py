"""A board's report is used only if its axes can have reached the reported positions."""

import pytest

from rotemina.drivers.contract import ProtocolError
from rotemina.drivers.mc68hc11.protocol import Telemetry


@pytest.fixture
def implausible_reports(monkeypatch):
    """Return a dictionary whose ``reports`` is the number of next reports that are implausible.

    An implausible report is a hundred thousand steps away.
    """
    remaining = {"reports": 0}
    make_telemetry = Telemetry.from_samples.__func__

    def make_report(cls, time_us, state, fault, switches, expected, axes):
        if remaining["reports"] > 0:
            remaining["reports"] -= 1
            axes = tuple((reading + 100_000, command + 100_000) for reading, command in axes)
        return make_telemetry(cls, time_us, state, fault, switches, expected, axes)

    monkeypatch.setattr(Telemetry, "from_samples", classmethod(make_report))
    return remaining


def test_an_implausible_report_is_discarded_and_counted(open_bench, implausible_reports):
    bench = open_bench(ports=1)
    samples_before = bench.run(0.3)
    rejected = bench.driver.link_quality().rejected
    implausible_reports["reports"] = 2
    samples = bench.run(0.3)
    assert bench.driver.link_quality().rejected == rejected + 2
    assert abs(samples.command - samples_before.command[-1]).max() < 1e-9
    target = float(samples_before.command[-1, 0]) + 1e-3
    bench.driver.move_to({"x": target})
    samples_after = bench.run(1.0)
    assert samples_after.command[-1, 0] == pytest.approx(target, abs=1e-7)


def test_a_board_that_repeats_an_implausible_position_loses_its_trust(
    open_bench, implausible_reports
):
    bench = open_bench(ports=1)
    bench.run(0.3)
    implausible_reports["reports"] = 1000
    with pytest.raises(ProtocolError, match=r"3 reports in a row .* home or confirm"):
        bench.run(0.3)
