"""Drivers of devices with differing parameters, without connection, or with faults."""

import pytest

from rotemina.drivers.abilities import ParameterDifference, ParameterStore
from rotemina.drivers.contract import ConnectionLostError, DeviceState, DeviceStatus
from rotemina.drivers.simulator import Simulator


class DifferingParametersSimulator(Simulator, ParameterStore):
    """A simulator whose parameters differ from the robot file."""

    name = "differing"

    def __init__(self, *args, **options):
        super().__init__(*args, **options)
        self._differences = (
            ParameterDifference(7, "x pitch <b>", "mm", 0.5, 0.4),
            ParameterDifference(8, "y limit", "mm", 50.0, 55.0),
        )
        self.written = self.accepted = 0

    @property
    def differences(self):
        return self._differences

    def _accept_parameters(self):
        self.accepted += 1
        self._differences = ()

    def _write_parameters(self, permit):
        self.written += 1
        self._differences = ()


class UnpluggedSimulator(Simulator):
    """A device that is unreachable until a test plugs it in."""

    name = "absent"
    plugged_in = False

    def _open(self):
        if not self.plugged_in:
            raise ConnectionLostError("absent: nothing answers on port <COM9>")
        super()._open()


class FailingSimulator(Simulator):
    """A device whose connection can be cut, and which can report a fault."""

    name = "losing"
    is_cut = False
    fault_text = None

    def _read(self):
        if self.is_cut:
            raise ConnectionLostError("losing: the cable is torn off")
        return super()._read()

    def _status(self):
        status = super()._status()
        if self.fault_text is None:
            return status
        return DeviceStatus(DeviceState.FAULT, status.progress, self.fault_text, True, ())

    def _clear_fault(self, permit):
        self.fault_text = None


@pytest.fixture
def differing_driver():
    return DifferingParametersSimulator


@pytest.fixture
def unplugged_driver():
    return UnpluggedSimulator


@pytest.fixture
def failing_driver():
    return FailingSimulator
