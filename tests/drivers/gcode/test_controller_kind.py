"""The emulated controller says itself that it is a program; without that word it is a real one."""

import pytest

from rotemina.drivers.driver import MachineKind
from rotemina.drivers.errors import ConnectionLostError


@pytest.fixture
def opened(joined):
    """Return a driver that was opened while what its controller says was altered."""

    def opened(old=b"", new=b""):
        bench = joined()
        bench.line = {"alter": lambda data: data.replace(old, new)}
        bench.driver.open()
        return bench.driver

    return opened


def test_the_emulated_stage_says_that_it_is_virtual(joined):
    driver = joined().driver
    assert not driver.is_identified
    driver.open()
    assert driver.machine_kind is MachineKind.VIRTUAL


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"[MACHINE:virtual]\r\n", b""),
        (b"[MACHINE:virtual]", b"[MACHINE:virtal]"),
        (b"[MACHINE:virtual]", b"MACHINE:virtual]"),
        (b"[MACHINE:virtual]", b"[VER:1.1h.20190830:MACHINE:virtual]"),
        (b"[MACHINE:virtual]", b"[MSG:Machine: virtual]"),
    ],
    ids=["plain GRBL", "a letter lost", "a bracket lost", "text of a user", "name of a machine"],
)
def test_a_controller_that_does_not_say_so_undamaged_is_a_real_machine(opened, old, new):
    assert opened(old, new).machine_kind is MachineKind.REAL


def test_a_lost_stage_stays_what_it_said(joined):
    bench = joined()
    bench.driver.open()
    bench.cut(True)
    with pytest.raises(ConnectionLostError):
        bench.run(10.0)
    bench.driver.close()
    assert bench.driver.machine_kind is MachineKind.VIRTUAL
