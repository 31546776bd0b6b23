"""What a board tells is used only if its axes can have gone there."""

import pytest

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11.board_messages import Telemetry


@pytest.fixture
def strange_reports(monkeypatch):
    """Return how many of the boards' next reports put the axes a hundred thousand steps away."""
    left = {"reports": 0}
    tell = Telemetry.of.__func__

    def of(cls, time_us, state, fault, switches, expected, axes):
        if left["reports"] > 0:
            left["reports"] -= 1
            axes = tuple((reading + 100_000, command + 100_000) for reading, command in axes)
        return tell(cls, time_us, state, fault, switches, expected, axes)

    monkeypatch.setattr(Telemetry, "of", classmethod(of))
    return left


def test_a_report_that_cannot_be_true_is_discarded_and_counted(
    robot, joined_bench, strange_reports
):
    bench = joined_bench(robot, ports=1)
    bench.driver.open()
    before = bench.run(0.3)
    rejected = bench.driver.link_quality().rejected
    strange_reports["reports"] = 2
    samples = bench.run(0.3)
    assert bench.driver.link_quality().rejected == rejected + 2
    assert abs(samples.command - before.command[-1]).max() < 1e-9
    target = float(before.command[-1, 0]) + 1e-3
    bench.driver.move_to({"x": target})
    after = bench.run(1.0)
    assert after.command[-1, 0] == pytest.approx(target, abs=1e-7)


def test_a_board_that_insists_on_another_place_is_no_longer_trusted(
    robot, joined_bench, strange_reports
):
    bench = joined_bench(robot, ports=1)
    bench.driver.open()
    bench.run(0.3)
    strange_reports["reports"] = 1000
    with pytest.raises(ProtocolError, match=r"3 reports in a row .* home or confirm"):
        bench.run(0.3)
