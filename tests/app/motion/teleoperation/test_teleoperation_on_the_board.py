"""Teleoperation end to end: from HID reports to virtual boards at the real baud rate.

An operator steers, switches stage and scaling during a move, penetrates the simulated cell, aborts,
and replays the recording.
"""

import struct
import threading
import time
from collections import deque
from contextlib import contextmanager
from importlib.resources import files

import numpy as np
import pytest

from rotemina.app.motion.inputs import OperatorAction
from rotemina.app.motion.penetration import PenetrationParameters, PenetrationPhase as Penetrating
from rotemina.app.motion.recording import Recording, make_trajectory
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    CommandRefused,
    FaultRaised,
    PlaybackFinished,
    SessionPhase,
)
from rotemina.app.motion.teleoperation import LawKind
from rotemina.app.operation import OperatorControl
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.inputs import HidSource
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.sim.records import Tap
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.slow
ROBOT = load_robot("rotemina")
MAX_WAIT_S = 30.0
CELL_POSITION_M = 50e-6  # zn at which the pin touches the membrane on its way down, m

# Three axes of 16 bits and sixteen buttons.
DESCRIPTOR = bytes.fromhex(
    "05 01 09 04 A1 01 16 01 80 26 FF 7F 75 10 95 03 09 30 09 31 09 35 81 02"
    "05 09 19 01 29 10 15 00 25 01 75 01 95 10 81 02 C0"
)
# Buttons of the default profile for a stick with this number of buttons.
BUTTONS = {
    OperatorAction.DEAD_MAN: 0,
    OperatorAction.STOP: 1,
    OperatorAction.STAGE: 2,
    OperatorAction.FINE: 3,
    OperatorAction.LAW: 6,
    OperatorAction.PENETRATION: 9,
}


class HidStick:
    """A joystick in the form of hidapi: reports that wait until they are read."""

    path = b"/dev/hidraw0"

    def __init__(self):
        self.waiting = deque()
        self.is_plugged_in = True
        self._state = (0.0, 0.0, 0.0, 0)
        self.report_axes()

    # Interface of the hidapi module.

    def enumerate(self):
        device_info = {"vendor_id": 0x1234, "product_id": 1, "usage_page": 1, "usage": 4}
        names = {"manufacturer_string": "Test", "product_string": "Stick", "serial_number": "1"}
        location = {"path": self.path, "interface_number": 0}
        return [{**device_info, **names, **location}] if self.is_plugged_in else []

    def device(self):
        return self

    # Interface of its devices.

    def open_path(self, path):
        assert path == self.path

    def set_nonblocking(self, on):
        return 0

    def get_report_descriptor(self, max_length=4096):
        return list(DESCRIPTOR)

    def read(self, max_length):
        if not self.is_plugged_in:
            raise OSError("read error")
        return list(self.waiting.popleft()) if self.waiting else []

    def error(self):
        return "Success"

    def close(self):
        pass

    # Actions of the operator's hand.

    def report_axes(self, **axes):
        """Send a report with these axes."""
        x, y, z, buttons = self._state
        self._state = (axes.get("x", x), axes.get("y", y), axes.get("z", z), buttons)
        self._send()

    def hold(self, action, is_held=True):
        x, y, z, buttons = self._state
        bit = 1 << BUTTONS[action]
        self._state = (x, y, z, buttons | bit if is_held else buttons & ~bit)
        self._send()

    def _send(self):
        *axes, buttons = self._state
        self.waiting.append(struct.pack("<3hH", *(round(32767 * a) for a in axes), buttons))


def write_robot_with_cell(folder):
    """Write a file of the nominal machine with a cell below its tip; return its path."""
    text = files("rotemina.resources.robots").joinpath("rotemina.toml").read_text("utf-8")
    effect = f'id = "contact"\nplace = {CELL_POSITION_M!r}\nstiffness = -0.08'
    robot = folder / "cell.toml"
    robot.write_text(f"{text}\n[[axis.zn.effect]]\n{effect}\n", "utf-8")
    return robot


class OperatorAtBoards:
    """An operator with a stick at a session on virtual boards."""

    def __init__(self, ports, folder, events):
        self.stick = HidStick()
        self.messages = []
        self.session = MotionSession(
            MC68HC11Driver(ROBOT, {"port": ports[0], "second_port": ports[1]})
        )
        self.operation = OperatorControl(
            self.session,
            folder / "config",
            folder / "data",
            sources={"hid": HidSource(load=lambda: self.stick)},
            notify=self.messages.append,
        )
        self._ticks = threading.Condition()
        self.samples = []
        self.events = events
        self.session.subscribe(self.events.append)
        self.session.tap(self._note)

    def _note(self, samples, _):
        with self._ticks:
            self.samples.append(samples)
            self._ticks.notify_all()

    def wait_until(self, condition, limit_s=MAX_WAIT_S):
        """Wait until a condition holds; it is checked after every report of the boards."""
        end_s = time.monotonic() + limit_s
        with self._ticks:
            while not condition():
                assert time.monotonic() < end_s, (
                    self.session.snapshot(),
                    self.operation.teleoperator.state,
                    self.operation.penetration.status,
                    self.messages,
                )
                self._ticks.wait(0.02)

    def wait_device_time(self, device_s):
        """Wait for this time, s, on the clock of the boards."""
        begin_s = self.session.snapshot().device_time_s
        self.wait_until(lambda: self.session.snapshot().device_time_s >= begin_s + device_s)

    def is_at_rest(self):
        state = self.session.snapshot()
        return state.activity is DeviceState.IDLE and not state.queued

    def has_released_stick(self):
        """Return whether the stick is centred and the axes that it moved are at rest."""
        state = self.operation.teleoperator.state
        return not state.is_driving and not any(view.deflection for view in state.coordinates)

    def press(self, action):
        self.stick.hold(action)
        self.wait_device_time(0.1)
        self.stick.hold(action, False)
        self.wait_device_time(0.1)

    def read_commands(self):
        times = np.concatenate([samples.device_time_s for samples in self.samples])
        return times, np.concatenate([samples.command for samples in self.samples])

    def close(self):
        self.operation.close()
        self.session.close()


@contextmanager
def run_operator(boards, folder, events):
    """Start boards and operator, and check at the end that nothing failed."""
    with boards as (ports, _):
        operator = OperatorAtBoards(ports, folder, events)
        try:
            operator.session.start()
            operator.wait_until(lambda: operator.session.snapshot().phase is SessionPhase.READY)
            operator.operation.start()
            operator.wait_until(lambda: operator.operation.intent.device.startswith("hid:"))
            yield operator
        finally:
            operator.close()
        assert not [event for event in events if isinstance(event, FaultRaised | CommandRefused)]


def assert_no_jump(operator, first_sample):
    """Assert that no command exceeds the speed and acceleration of its axis, except by rounding."""
    times, commands = operator.read_commands()
    times, commands = times[first_sample:], commands[first_sample:]
    for column, axis in enumerate(ROBOT.axes):
        model = ROBOT.axes[axis]
        step = 1e-7 if axis in "xyz" else model.span / 2**16
        path, dt = commands[:, column], np.diff(times)
        speed = np.diff(path) / dt
        assert np.abs(np.diff(path)).max() <= model.max_speed * dt.max() + step
        change = np.abs(np.diff(speed)).max()
        assert change <= model.max_acceleration * 2.0 * dt.max() + 4.0 * step / dt.min(), axis


def test_steer_switch_penetrate_abort_and_replay(
    tmp_path_factory, board_process, retry_when_starved
):
    def work(events):
        folder = tmp_path_factory.mktemp("operator")
        with run_operator(board_process(write_robot_with_cell(folder)), folder, events) as operator:
            operator.session.go_to({"zn": 60e-6})
            operator.wait_until(operator.is_at_rest)
            path = operator.operation.start_recording({"test": True})
            section_s = steer_and_switch(operator)
            penetrate_and_abort(operator)
            unplug_during_move(operator)
            assert operator.operation.stop_recording() == path
            replay(operator, Recording.open(path), section_s)

    retry_when_starved(work)


def steer_and_switch(operator):
    """Switch law and stage during a move; return its begin and end, s."""
    stick, session = operator.stick, operator.session
    teleoperator = operator.operation.teleoperator
    first_sample, start_state = sum(map(len, operator.samples)), session.snapshot()
    stick.hold(OperatorAction.DEAD_MAN)
    operator.wait_until(lambda: "x" in operator.operation.intent.deflections)
    operator.wait_device_time(0.1)
    stick.report_axes(x=0.8)
    operator.wait_until(lambda: teleoperator.state.is_driving)
    operator.wait_device_time(0.5)
    operator.press(OperatorAction.LAW)
    assert teleoperator.state.law is LawKind.IMPEDANCE
    assert teleoperator.state.is_driving
    operator.wait_device_time(0.3)
    operator.press(OperatorAction.STAGE)
    assert teleoperator.state.mode == "nano"
    operator.wait_device_time(0.3)
    assert session.snapshot().command["x"] - start_state.command["x"] > 2e-4
    stick.report_axes(x=0.0)
    operator.wait_until(lambda: not any(view.is_waiting for view in teleoperator.state.coordinates))
    stick.report_axes(y=1.0)
    operator.wait_device_time(0.5)
    # A stick that reports only changes counts as released if it is held still.
    stick.report_axes(y=0.99)
    operator.wait_device_time(0.5)
    stick.report_axes(y=0.0)
    operator.press(OperatorAction.LAW)
    assert teleoperator.state.law is LawKind.POSITION
    stick.report_axes(x=-0.5)
    operator.wait_device_time(0.5)
    stick.report_axes(x=0.0)
    operator.wait_until(operator.has_released_stick)
    operator.wait_until(operator.is_at_rest)
    assert session.snapshot().command["thx"] != start_state.command["thx"]
    assert teleoperator.state.refusal_reason is None
    assert_no_jump(operator, first_sample)
    operator.wait_device_time(0.5)
    stick.hold(OperatorAction.DEAD_MAN, False)
    return start_state.sample_host_time_s, session.snapshot().sample_host_time_s


def penetrate_and_abort(operator):
    session, operation = operator.session, operator.operation
    before = session.snapshot().command["zn"]
    operation.arm_penetration(
        PenetrationParameters(
            approach_distance=1.5e-5, depth=2.5e-5, duration_s=0.06, hold_s=20.0, overload=2e-5
        )
    )
    operator.press(OperatorAction.PENETRATION)
    operator.wait_until(lambda: operation.penetration.status.phase is Penetrating.HOLD)
    assert session.snapshot().command["zn"] < CELL_POSITION_M - 2e-5
    operator.press(OperatorAction.PENETRATION)
    operator.wait_until(lambda: operation.penetration.status.phase is Penetrating.ABORTED)
    run = operation.penetration.status.run
    assert abs(run.contact - CELL_POSITION_M) < 3e-6
    assert session.snapshot().command["zn"] == pytest.approx(before, abs=2e-8)
    operator.wait_until(operator.is_at_rest)
    operator.wait_until(lambda: session.snapshot().owners == {})


def unplug_during_move(operator):
    stick, teleoperator = operator.stick, operator.operation.teleoperator
    teleoperator.use_law(LawKind.RATE)
    teleoperator.use_mode("micro")
    stick.hold(OperatorAction.DEAD_MAN)
    operator.wait_until(
        lambda: teleoperator.state.mode == "micro" and teleoperator.state.coordinates
    )
    operator.wait_device_time(0.1)
    stick.report_axes(x=1.0)
    operator.wait_until(lambda: teleoperator.state.is_driving)
    stick.is_plugged_in = False
    operator.wait_until(lambda: not teleoperator.state.is_driving)
    operator.wait_until(operator.is_at_rest)
    assert (
        "unplug" in teleoperator.state.refusal_reason or "gone" in teleoperator.state.refusal_reason
    )


def replay(operator, recording, section_s):
    """Play the steered section on the boards, and compare each row."""
    trajectory = make_trajectory(recording, *section_s, operator.session.setpoint_period_s)
    operator.session.play(trajectory)
    operator.wait_until(
        lambda: any(isinstance(event, PlaybackFinished) for event in operator.events)
    )
    # An interrupted playback still brakes; its reason is reported at standstill.
    operator.wait_until(lambda: operator.session.snapshot().activity is not DeviceState.MOVING)
    played = next(event for event in operator.events if isinstance(event, PlaybackFinished))
    assert played.completed
    commands = trajectory.commands
    since_s = commands.time_s - commands.time_s[0]
    for axis in commands.axes:
        expected = np.interp(played.record.time_s, since_s, commands.signal(axis, Tap.CMD))
        step = 1e-7 if axis in "xyz" else ROBOT.axes[axis].span / 2**16
        tolerance = 1.01 * step + np.abs(np.diff(expected)).max()
        assert np.abs(played.record.signal(axis, Tap.CMD) - expected).max() <= tolerance
