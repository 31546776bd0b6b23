"""Rules of the base classes that a correct driver cannot demonstrate."""

import numpy as np
import pytest

from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.contract import (
    ConnectionLostError,
    DeviceSamples,
    DeviceState,
    DeviceStatus,
    Driver,
    DriverSettingError,
    DriverTimeoutError,
    MachineKind,
    ProtocolError,
    StateError,
    VirtualClock,
)
from rotemina.drivers.contract.settings import resolve_settings
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("picma")


class ScriptedDriver(Driver):
    """A driver with given answers."""

    name = "plain"

    def __init__(self):
        super().__init__(ROBOT, clock=VirtualClock())
        self.given_status = DeviceStatus(DeviceState.IDLE)
        self.samples = DeviceSamples.empty(1)
        self.calls = []

    def _open(self):
        self.calls.append("open")

    def _close(self):
        self.calls.append("close")

    def _status(self):
        return self.given_status

    def _move_to(self, targets, speeds, permit):
        self.calls.append(targets)

    def _stop(self):
        self.calls.append("stop")

    def _clear_fault(self, permit):
        self.calls.append("clear")

    def _read(self):
        return self.samples


@pytest.fixture
def driver():
    driver = ScriptedDriver()
    driver.open()
    driver.calls.clear()
    return driver


def make_samples(time_s, **changes):
    count = len(time_s)
    arrays = {
        "device_time_s": np.array(time_s),
        "command": np.zeros((count, 1)),
        "measured": np.zeros((count, 1)),
        "inputs": np.full((count, 1), np.nan),
        "playback_row": np.full(count, -1),
    }
    return DeviceSamples(**(arrays | changes))


def test_a_device_that_does_not_report_its_kind_is_real():
    driver = ScriptedDriver()
    assert (driver.machine_kind, driver.is_identified) == (MachineKind.REAL, False)
    driver.open()
    assert (driver.machine_kind, driver.is_identified) == (MachineKind.REAL, True)


class SelfIdentifyingDriver(ScriptedDriver):
    """A driver whose device reports what kind of machine it is, if it is connected."""

    reported_kind = MachineKind.VIRTUAL
    is_connected = True

    def _open(self):
        super()._open()
        if not self.is_connected:
            raise ConnectionLostError("no answer")

    def _identify(self):
        return self.reported_kind


def test_a_reported_kind_stays_until_the_device_reports_another_one():
    driver = SelfIdentifyingDriver()
    driver.open()
    driver.close()
    assert driver.machine_kind is MachineKind.VIRTUAL
    driver.is_connected = False
    with pytest.raises(ConnectionLostError):
        driver.open()
    assert driver.machine_kind is MachineKind.VIRTUAL
    # Another device is connected to the same port.
    driver.is_connected = True
    driver.reported_kind = MachineKind.REAL
    driver.open()
    assert driver.machine_kind is MachineKind.REAL


def test_a_device_that_reports_an_invalid_kind_is_closed():
    driver = SelfIdentifyingDriver()
    driver.reported_kind = "imaginary"
    with pytest.raises(ValueError, match="imaginary"):
        driver.open()
    assert driver.calls == ["open", "close"]
    assert driver.status().state is DeviceState.CLOSED
    assert driver.machine_kind is MachineKind.REAL


def test_a_faulty_device_is_not_moved(driver):
    driver.given_status = DeviceStatus(DeviceState.FAULT, fault="limit switch")
    with pytest.raises(StateError, match="limit switch"):
        driver.move_to({"p": 1e-6})
    driver.clear_fault()
    assert driver.calls == ["clear"]


def test_nothing_moves_from_an_unknown_position(driver):
    driver.given_status = DeviceStatus(DeviceState.IDLE, position_known=False)
    with pytest.raises(StateError, match="position is unknown"):
        driver.move_to({"p": 1e-6})
    assert driver.calls == []


def test_a_move_without_axes_sends_nothing(driver):
    driver.move_to({})
    assert driver.calls == []


def test_a_closed_device_gets_no_stop(driver):
    driver.stop()
    driver.close()
    driver.stop()
    assert driver.calls == ["stop", "close"]


def test_device_time_that_runs_back_is_an_error(driver):
    driver.samples = make_samples([1.0, 2.0])
    driver.read()
    driver.samples = make_samples([2.0, 3.0])
    with pytest.raises(ProtocolError, match="back from 2 s to 2 s"):
        driver.read()
    driver.close()
    driver.open()
    driver.read()


def test_samples_with_another_number_of_axes_are_an_error(driver):
    driver.samples = DeviceSamples.empty(3)
    with pytest.raises(ProtocolError, match="3 axes, expected 1"):
        driver.read()


def test_inconsistent_samples_are_refused():
    for name, values in (
        ("device_time_s", [1.0, 1.0]),
        ("device_time_s", [1.0, np.nan]),
        ("command", [[0.0], [np.inf]]),
        ("measured", [[0.0], [np.nan]]),
        ("measured", np.zeros((2, 2))),
        ("playback_row", [-1]),
    ):
        with pytest.raises(ProtocolError):
            make_samples([1.0, 2.0], **{name: np.array(values)})


def test_a_driver_that_fails_to_close_counts_as_closed(driver):
    def raise_error():
        raise ConnectionLostError("cable pulled")

    driver._close = raise_error
    with pytest.raises(ConnectionLostError):
        driver.close()
    driver.close()
    assert driver.status().state is DeviceState.CLOSED


def test_a_driver_that_fails_to_open_stays_closed():
    driver = ScriptedDriver()

    def raise_error():
        raise DriverTimeoutError("no answer in 1 s")

    driver._open = raise_error
    with pytest.raises(TimeoutError):
        driver.open()
    assert driver.status().state is DeviceState.CLOSED


def test_final_methods_cannot_be_overridden():
    for name in ("open", "close", "stop", "move_to", "read", "status", "machine_kind"):
        with pytest.raises(TypeError, match=f"{name}: final in Driver"):
            type("Sly", (ScriptedDriver,), {name: lambda self: None})
        mixin = type("Mixin", (), {name: lambda self: None})
        with pytest.raises(TypeError, match=name):
            type("Sly", (mixin, ScriptedDriver), {})
    with pytest.raises(TypeError, match="play: final in TrajectoryPlayer"):
        type("Sly", (TrajectoryPlayer,), {"play": lambda self, trajectory: None})


def test_settings_of_the_wrong_type_are_refused():
    for values in ({"rate": "fast"}, {"rate": True}, {"rate": float("nan")}, {"seed": 1.0}):
        with pytest.raises(DriverSettingError, match=next(iter(values))):
            resolve_settings({"rate": 1.0, "seed": 0}, values, "board")


def test_a_whole_number_is_accepted_as_a_float():
    resolved = resolve_settings({"rate": 1.0, "seed": 0}, {"rate": 5}, "board")
    assert resolved == {"rate": 5.0, "seed": 0}
    assert isinstance(resolved["rate"], float)


def test_a_clock_only_moves_forward():
    clock = VirtualClock(2.0)
    clock.advance(0.5)
    assert clock() == 2.5
    with pytest.raises(ValueError, match="cannot advance"):
        clock.advance(-1.0)
