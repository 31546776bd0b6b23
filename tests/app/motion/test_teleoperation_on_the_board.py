"""The whole way of teleoperation: HID reports in, virtual boards at true baud out.

One operator steers, switches stage and scaling in mid-move, penetrates the simulated cell, aborts,
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

from rotemina.app.motion.operation import Operation
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.status import Phase as Penetrating
from rotemina.app.motion.recording.exporting import trajectory
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import CommandRefused, Faulted, Phase, PlaybackFinished
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.scales import LawKind
from rotemina.drivers.inputs.hid.hid_discovery import HidSource
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.slow
ROBOT = load_robot("rotemina")
PATIENCE_S = 30.0
CELL = 50e-6  # m of zn, at which the pin meets the membrane on its way down

# Three axes of 16 bits, sixteen buttons.
DESCRIPTOR = bytes.fromhex(
    "05 01 09 04 A1 01 16 01 80 26 FF 7F 75 10 95 03 09 30 09 31 09 35 81 02"
    "05 09 19 01 29 10 15 00 25 01 75 01 95 10 81 02 C0"
)
# Of the profile that is made for a stick with this many buttons: the order of its actions.
BUTTONS = {
    Action.DEAD_MAN: 0,
    Action.STOP: 1,
    Action.STAGE: 2,
    Action.FINE: 3,
    Action.LAW: 6,
    Action.PENETRATION: 9,
}


class Stick:
    """A joystick as hidapi shows it: bytes that wait for whoever reads them."""

    path = b"/dev/hidraw0"

    def __init__(self):
        self.waiting = deque()
        self.there = True
        self._state = (0.0, 0.0, 0.0, 0)
        self.tell()

    # What hidapi's module has.

    def enumerate(self):
        about = {"vendor_id": 0x1234, "product_id": 1, "usage_page": 1, "usage": 4}
        names = {"manufacturer_string": "Test", "product_string": "Stick", "serial_number": "1"}
        where = {"path": self.path, "interface_number": 0}
        return [{**about, **names, **where}] if self.there else []

    def device(self):
        return self

    # What its devices have.

    def open_path(self, path):
        assert path == self.path

    def set_nonblocking(self, on):
        return 0

    def get_report_descriptor(self, max_length=4096):
        return list(DESCRIPTOR)

    def read(self, max_length):
        if not self.there:
            raise OSError("read error")
        return list(self.waiting.popleft()) if self.waiting else []

    def error(self):
        return "Success"

    def close(self):
        pass

    # What a hand does.

    def tell(self, **axes):
        """Send a report with the axes there."""
        x, y, z, buttons = self._state
        self._state = (axes.get("x", x), axes.get("y", y), axes.get("z", z), buttons)
        self._send()

    def hold(self, action, held=True):
        x, y, z, buttons = self._state
        bit = 1 << BUTTONS[action]
        self._state = (x, y, z, buttons | bit if held else buttons & ~bit)
        self._send()

    def _send(self):
        *axes, buttons = self._state
        self.waiting.append(struct.pack("<3hH", *(round(32767 * a) for a in axes), buttons))


def robot_above_a_cell(folder):
    """Write the nominal machine with a cell below its tip; return the file."""
    text = files("rotemina.resources.robots").joinpath("rotemina.toml").read_text("utf-8")
    effect = f'id = "contact"\nplace = {CELL!r}\nstiffness = -0.08'
    robot = folder / "cell.toml"
    robot.write_text(f"{text}\n[[axis.zn.effect]]\n{effect}\n", "utf-8")
    return robot


class Operator:
    """Somebody at the stick, who looks at the machine, and waits for nothing in particular."""

    def __init__(self, ports, folder, events):
        self.stick = Stick()
        self.told = []
        self.session = MotionSession(MC68HC11(ROBOT, {"port": ports[0], "second_port": ports[1]}))
        self.operation = Operation(
            self.session,
            folder / "config",
            folder / "data",
            sources={"hid": HidSource(load=lambda: self.stick)},
            told=self.told.append,
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

    def until(self, condition, limit_s=PATIENCE_S):
        """Wait until something is so, looking whenever the boards have told something."""
        end_s = time.monotonic() + limit_s
        with self._ticks:
            while not condition():
                assert time.monotonic() < end_s, (
                    self.session.snapshot(),
                    self.operation.teleoperator.state,
                    self.operation.penetration.status,
                    self.told,
                )
                self._ticks.wait(0.02)

    def look_on(self, device_s):
        """Let so much of the boards' time go by."""
        begin_s = self.session.snapshot().device_time_s
        self.until(lambda: self.session.snapshot().device_time_s >= begin_s + device_s)

    def at_rest(self):
        state = self.session.snapshot()
        return state.activity is DeviceState.IDLE and not state.queued

    def let_go(self):
        """Whether the stick was seen in the middle, and what it moved stands."""
        state = self.operation.teleoperator.state
        return not state.driving and not any(one.deflection for one in state.coordinates)

    def press(self, action):
        self.stick.hold(action)
        self.look_on(0.1)
        self.stick.hold(action, False)
        self.look_on(0.1)

    def command(self):
        times = np.concatenate([one.device_time_s for one in self.samples])
        return times, np.concatenate([one.command for one in self.samples])

    def close(self):
        self.operation.close()
        self.session.close()


@contextmanager
def at_work(boards, folder, events):
    """Give an operator at boards, stick and machine in order."""
    with boards as (ports, _):
        operator = Operator(ports, folder, events)
        try:
            operator.session.start()
            operator.until(lambda: operator.session.snapshot().phase is Phase.READY)
            operator.operation.start()
            operator.until(lambda: operator.operation.intent.device.startswith("hid:"))
            yield operator
        finally:
            operator.close()
        assert not [event for event in events if isinstance(event, Faulted | CommandRefused)]


def assert_no_jump(operator, since):
    """No command has a step beyond the axis' speed and acceleration, and rounding."""
    times, commands = operator.command()
    times, commands = times[since:], commands[since:]
    for column, axis in enumerate(ROBOT.axes):
        model = ROBOT.axes[axis]
        step = 1e-7 if axis in "xyz" else model.span / 2**16
        path, dt = commands[:, column], np.diff(times)
        speed = np.diff(path) / dt
        assert np.abs(np.diff(path)).max() <= model.max_speed * dt.max() + step
        change = np.abs(np.diff(speed)).max()
        assert change <= model.max_acceleration * 2.0 * dt.max() + 4.0 * step / dt.min(), axis


def test_steer_switch_penetrate_abort_and_replay(tmp_path_factory, board_process, patiently):
    def work(events):
        folder = tmp_path_factory.mktemp("operator")
        with at_work(board_process(robot_above_a_cell(folder)), folder, events) as operator:
            operator.session.go_to({"zn": 60e-6})
            operator.until(operator.at_rest)
            path = operator.operation.start_recording({"test": True})
            steered = steer_and_switch(operator)
            penetrate_and_abort(operator)
            unplug_in_mid_move(operator)
            assert operator.operation.stop_recording() == path
            replay(operator, Recording.open(path), steered)

    patiently(work)


def steer_and_switch(operator):
    """Switch law and stage in mid-move; return from when till when it was."""
    stick, session = operator.stick, operator.session
    teleoperator = operator.operation.teleoperator
    since, began = sum(map(len, operator.samples)), session.snapshot()
    stick.hold(Action.DEAD_MAN)
    operator.until(lambda: "x" in operator.operation.intent.deflections)
    operator.look_on(0.1)
    stick.tell(x=0.8)
    operator.until(lambda: teleoperator.state.driving)
    operator.look_on(0.5)
    operator.press(Action.LAW)
    assert teleoperator.state.law is LawKind.IMPEDANCE
    assert teleoperator.state.driving
    operator.look_on(0.3)
    operator.press(Action.STAGE)
    assert teleoperator.state.mode == "nano"
    operator.look_on(0.3)
    assert session.snapshot().command["x"] - began.command["x"] > 2e-4
    stick.tell(x=0.0)
    operator.until(lambda: not any(one.waiting for one in teleoperator.state.coordinates))
    stick.tell(y=1.0)
    operator.look_on(0.5)
    stick.tell(y=0.99)  # this stick reports only changes: held still, it would count as released
    operator.look_on(0.5)
    stick.tell(y=0.0)
    operator.press(Action.LAW)
    assert teleoperator.state.law is LawKind.POSITION
    stick.tell(x=-0.5)
    operator.look_on(0.5)
    stick.tell(x=0.0)
    operator.until(operator.let_go)
    operator.until(operator.at_rest)
    assert session.snapshot().command["thx"] != began.command["thx"]
    assert teleoperator.state.refused is None
    assert_no_jump(operator, since)
    operator.look_on(0.5)
    stick.hold(Action.DEAD_MAN, False)
    return began.sample_host_time_s, session.snapshot().sample_host_time_s


def penetrate_and_abort(operator):
    session, operation = operator.session, operator.operation
    before = session.snapshot().command["zn"]
    operation.arm_penetration(
        PenetrationParameters(
            approach_distance=1.5e-5, depth=2.5e-5, duration_s=0.06, hold_s=20.0, overload=2e-5
        )
    )
    operator.press(Action.PENETRATION)
    operator.until(lambda: operation.penetration.status.phase is Penetrating.HOLD)
    assert session.snapshot().command["zn"] < CELL - 2e-5
    operator.press(Action.PENETRATION)
    operator.until(lambda: operation.penetration.status.phase is Penetrating.ABORTED)
    run = operation.penetration.status.run
    assert abs(run.contact - CELL) < 3e-6
    assert session.snapshot().command["zn"] == pytest.approx(before, abs=2e-8)
    operator.until(operator.at_rest)
    operator.until(lambda: session.snapshot().owners == {})


def unplug_in_mid_move(operator):
    stick, teleoperator = operator.stick, operator.operation.teleoperator
    teleoperator.use_law(LawKind.RATE)
    teleoperator.use_mode("micro")
    stick.hold(Action.DEAD_MAN)
    operator.until(lambda: teleoperator.state.mode == "micro" and teleoperator.state.coordinates)
    operator.look_on(0.1)
    stick.tell(x=1.0)
    operator.until(lambda: teleoperator.state.driving)
    stick.there = False
    operator.until(lambda: not teleoperator.state.driving)
    operator.until(operator.at_rest)
    assert "unplug" in teleoperator.state.refused or "gone" in teleoperator.state.refused


def replay(operator, recording, steered):
    """Play on the boards what was steered, and compare each row."""
    again = trajectory(recording, *steered, operator.session.setpoint_period_s)
    operator.session.play(again)
    operator.until(lambda: any(isinstance(e, PlaybackFinished) for e in operator.events))
    # What was cut off still brakes; why it was is told when it stands.
    operator.until(lambda: operator.session.snapshot().activity is not DeviceState.MOVING)
    played = next(e for e in operator.events if isinstance(e, PlaybackFinished))
    assert played.completed
    asked = again.commands
    since_s = asked.time_s - asked.time_s[0]
    for axis in asked.axes:
        wanted = np.interp(played.record.time_s, since_s, asked.signal(axis, Tap.CMD))
        step = 1e-7 if axis in "xyz" else ROBOT.axes[axis].span / 2**16
        tolerance = 1.01 * step + np.abs(np.diff(wanted)).max()
        assert np.abs(played.record.signal(axis, Tap.CMD) - wanted).max() <= tolerance
