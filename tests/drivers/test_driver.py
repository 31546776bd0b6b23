"""Rules of the base classes that no well-behaved driver can show."""

import numpy as np
import pytest

from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.driver import Driver, MachineKind
from rotemina.drivers.errors import (
    ConnectionLostError,
    DriverError,
    DriverTimeoutError,
    LimitError,
    ProtocolError,
    StateError,
)
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.drivers.settings import SettingError, resolve
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("picma")


class Plain(Driver):
    """Answers what it was told to."""

    name = "plain"

    def __init__(self):
        super().__init__(ROBOT, clock=VirtualClock())
        self.answer = DeviceStatus(DeviceState.IDLE)
        self.samples = Samples.none(1)
        self.calls = []

    def _open(self):
        self.calls.append("open")

    def _close(self):
        self.calls.append("close")

    def _status(self):
        return self.answer

    def _move_to(self, targets, speeds, permit):
        self.calls.append(targets)

    def _stop(self):
        self.calls.append("stop")

    def _clear_fault(self, permit):
        self.calls.append("clear")

    def _read(self):
        return self.samples


@pytest.fixture
def plain():
    driver = Plain()
    driver.open()
    driver.calls.clear()
    return driver


def samples(time_s, **changes):
    n = len(time_s)
    arrays = {
        "device_time_s": np.array(time_s),
        "command": np.zeros((n, 1)),
        "measured": np.zeros((n, 1)),
        "inputs": np.full((n, 1), np.nan),
        "playback_row": np.full(n, -1),
    }
    return Samples(**(arrays | changes))


def test_a_device_that_says_nothing_of_itself_is_a_real_machine():
    driver = Plain()
    assert (driver.machine_kind, driver.is_identified) == (MachineKind.REAL, False)
    driver.open()
    assert (driver.machine_kind, driver.is_identified) == (MachineKind.REAL, True)


class Emulated(Plain):
    """Says what it is, if it is asked while it answers."""

    said = MachineKind.VIRTUAL

    def _open(self):
        super()._open()
        if self.said == "nothing":
            raise ConnectionLostError("nobody answers")

    def _identify(self):
        return self.said


def test_what_a_device_said_of_itself_stays_until_it_says_something_else():
    driver = Emulated()
    driver.open()
    driver.close()
    assert driver.machine_kind is MachineKind.VIRTUAL
    driver.said = "nothing"
    with pytest.raises(ConnectionLostError):
        driver.open()
    assert driver.machine_kind is MachineKind.VIRTUAL
    driver.said = MachineKind.REAL  # another device at the same port
    driver.open()
    assert driver.machine_kind is MachineKind.REAL


def test_a_device_whose_word_makes_no_sense_is_closed_again():
    driver = Emulated()
    driver.said = "imaginary"
    with pytest.raises(ValueError, match="imaginary"):
        driver.open()
    assert driver.calls == ["open", "close"]
    assert driver.status().state is DeviceState.CLOSED
    assert driver.machine_kind is MachineKind.REAL


def test_a_driver_cannot_override_what_its_device_said():
    with pytest.raises(TypeError, match="machine_kind: final in Driver"):
        type("Boastful", (Plain,), {"machine_kind": MachineKind.VIRTUAL})


def test_a_faulty_device_is_not_moved(plain):
    plain.answer = DeviceStatus(DeviceState.FAULT, fault="limit switch")
    with pytest.raises(StateError, match="limit switch"):
        plain.move_to({"p": 1e-6})
    plain.clear_fault()
    assert plain.calls == ["clear"]


def test_nothing_moves_from_an_unknown_position(plain):
    plain.answer = DeviceStatus(DeviceState.IDLE, position_known=False)
    with pytest.raises(StateError, match="position is unknown"):
        plain.move_to({"p": 1e-6})
    assert plain.calls == []


def test_moving_no_axis_asks_the_device_nothing(plain):
    plain.move_to({})
    assert plain.calls == []


def test_a_closed_device_is_not_told_to_stop(plain):
    plain.stop()
    plain.close()
    plain.stop()
    assert plain.calls == ["stop", "close"]


def test_time_that_runs_back_between_reads_is_no_answer(plain):
    plain.samples = samples([1.0, 2.0])
    plain.read()
    plain.samples = samples([2.0, 3.0])
    with pytest.raises(ProtocolError, match="back from 2 s to 2 s"):
        plain.read()
    plain.close()
    plain.open()
    plain.read()


def test_samples_of_another_machine_are_no_answer(plain):
    plain.samples = Samples.none(3)
    with pytest.raises(ProtocolError, match="3 axes, expected 1"):
        plain.read()


@pytest.mark.parametrize(
    "changes",
    [
        {"device_time_s": np.array([1.0, 1.0])},
        {"device_time_s": np.array([1.0, np.nan])},
        {"command": np.array([[0.0], [np.inf]])},
        {"measured": np.array([[0.0], [np.nan]])},
        {"measured": np.zeros((2, 2))},
        {"playback_row": np.array([-1])},
    ],
)
def test_samples_that_make_no_sense_are_refused(changes):
    with pytest.raises(ProtocolError):
        samples([1.0, 2.0], **changes)


def test_a_driver_that_fails_to_close_counts_as_closed(plain):
    def broken():
        raise ConnectionLostError("cable pulled")

    plain._close = broken
    with pytest.raises(ConnectionLostError):
        plain.close()
    plain.close()
    assert plain.status().state is DeviceState.CLOSED


def test_a_driver_that_fails_to_open_stays_closed():
    driver = Plain()

    def broken():
        raise DriverTimeoutError("no answer in 1 s")

    driver._open = broken
    with pytest.raises(TimeoutError):
        driver.open()
    assert driver.status().state is DeviceState.CLOSED


@pytest.mark.parametrize("method", ["open", "close", "stop", "move_to", "read", "status"])
def test_rules_cannot_be_overridden(method):
    with pytest.raises(TypeError, match=f"{method}: final in Driver"):
        type("Sly", (Plain,), {method: lambda self: None})
    mixin = type("Mixin", (), {method: lambda self: None})
    with pytest.raises(TypeError, match=method):
        type("Sly", (mixin, Plain), {})


def test_play_cannot_be_overridden():
    with pytest.raises(TypeError, match="play: final in TrajectoryPlayer"):
        type("Sly", (TrajectoryPlayer,), {"play": lambda self, trajectory: None})


def test_errors_are_the_builtins_that_fit_them():
    assert issubclass(ConnectionLostError, (DriverError, ConnectionError))
    assert issubclass(DriverTimeoutError, TimeoutError)
    assert issubclass(LimitError, InputError)
    assert issubclass(LimitError, ValueError)
    assert not issubclass(StateError, ValueError)


@pytest.mark.parametrize(
    "given", [{"rate": "fast"}, {"rate": True}, {"rate": float("nan")}, {"seed": 1.0}]
)
def test_settings_of_the_wrong_type_are_named(given):
    with pytest.raises(SettingError, match=next(iter(given))):
        resolve({"rate": 1.0, "seed": 0}, given, "board")


def test_a_whole_number_passes_for_a_float():
    resolved = resolve({"rate": 1.0, "seed": 0}, {"rate": 5}, "board")
    assert resolved == {"rate": 5.0, "seed": 0}
    assert isinstance(resolved["rate"], float)


def test_a_clock_moves_on_only():
    clock = VirtualClock(2.0)
    clock.advance(0.5)
    assert clock() == 2.5
    with pytest.raises(ValueError, match="moves on"):
        clock.advance(-1.0)
