"""Devices that differ, fail, or have yet to be homed."""

import pytest

from rotemina.drivers.abilities import Parameterised
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.parameters import ParameterDifference
from rotemina.drivers.samples import DeviceState, DeviceStatus
from rotemina.drivers.simulator.driver import Simulator


class Differing(Simulator, Parameterised):
    """A simulator whose pitch is not as the robot file says."""

    name = "differing"

    def __init__(self, *args, **options):
        super().__init__(*args, **options)
        self._open_questions = (
            ParameterDifference(7, "x pitch <b>", "mm", 0.5, 0.4),
            ParameterDifference(8, "y limit", "mm", 50.0, 55.0),
        )
        self.written = self.accepted = 0

    @property
    def differences(self):
        return self._open_questions

    def _accept_parameters(self):
        self.accepted += 1
        self._open_questions = ()

    def _write_parameters(self, permit):
        self.written += 1
        self._open_questions = ()


class Absent(Simulator):
    """A device that cannot be reached until somebody plugs it in."""

    name = "absent"
    plugged_in = False

    def _open(self):
        if not self.plugged_in:
            raise ConnectionLostError("absent: nothing answers on port <COM9>")
        super()._open()


class Losing(Simulator):
    """A device whose line may be cut, and which may report a fault."""

    name = "losing"
    cut = False
    trouble = None

    def _read(self):
        if self.cut:
            raise ConnectionLostError("losing: the cable is torn off")
        return super()._read()

    def _status(self):
        status = super()._status()
        if self.trouble is None:
            return status
        return DeviceStatus(DeviceState.FAULT, status.progress, self.trouble, True, ())

    def _clear_fault(self, permit):
        self.trouble = None


@pytest.fixture
def differing():
    return Differing


@pytest.fixture
def absent():
    return Absent


@pytest.fixture
def losing():
    return Losing
