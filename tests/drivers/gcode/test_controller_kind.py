"""The emulated controller reports that it is virtual. Any other controller counts as real."""

import pytest

from rotemina.drivers.contract import ConnectionLostError, MachineKind


@pytest.fixture
def open_with_altered_replies(make_bench):
    """Return a function that opens a driver and replaces bytes in its controller's replies."""

    def open_driver(old=b"", new=b""):
        bench = make_bench()
        bench.line = {"alter": lambda data: data.replace(old, new)}
        bench.driver.open()
        return bench.driver

    return open_driver


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"[MACHINE:virtual]\r\n", b""),
        (b"[MACHINE:virtual]", b"MACHINE:virtual]"),
        (b"[MACHINE:virtual]", b"[VER:1.1h.20190830:MACHINE:virtual]"),
    ],
    ids=["plain GRBL", "lost bracket", "text of a user"],
)
def test_a_controller_without_an_intact_virtual_report_is_real(open_with_altered_replies, old, new):
    assert open_with_altered_replies(old, new).machine_kind is MachineKind.REAL


def test_a_virtual_stage_keeps_its_kind_when_it_is_lost(make_bench):
    bench = make_bench()
    assert not bench.driver.is_identified
    bench.driver.open()
    assert bench.driver.machine_kind is MachineKind.VIRTUAL
    bench.set_cut(True)
    with pytest.raises(ConnectionLostError):
        bench.run(10.0)
    bench.driver.close()
    assert bench.driver.machine_kind is MachineKind.VIRTUAL
