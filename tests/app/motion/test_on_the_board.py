"""The whole way: a trajectory on virtual boards at true baud, recorded, and diagnosed."""

import threading
import time
from contextlib import suppress
from importlib.resources import files

import numpy as np
import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import CommandRefused, Faulted, Phase, PlaybackFinished
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.samples import DeviceState
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.slow
ROBOT = load_robot("rotemina")
CONNECTING_S, PLAYING_S = 20.0, 30.0
DURATION_S = 8.0
PERIOD_S = 5e-3
STILL = (DeviceState.IDLE, DeviceState.FAULT, DeviceState.CLOSED)
HOLES = "samples are missing"
MISBEHAVING_S = 25.0


class Told:
    """The events of a session, and a way to wait for them."""

    def __init__(self, session, events):
        self.session = session
        self.events = events
        self._came = threading.Condition()
        session.subscribe(self._note)

    def _note(self, event):
        with self._came:
            self.events.append(event)
            self._came.notify_all()

    def until(self, condition, limit_s):
        with self._came:
            end_s = time.monotonic() + limit_s
            while not condition():
                left_s = end_s - time.monotonic()
                assert left_s > 0.0, (self.session.snapshot(), self.events)
                self._came.wait(min(left_s, 0.05))

    def wait(self, limit_s):
        """Wait for the next event, or so long."""
        with self._came:
            self._came.wait(limit_s)

    def of(self, kind):
        return [event for event in self.events if isinstance(event, kind)]


def gentle(time_s):
    """Rise and fall at the ends."""
    return np.minimum(1.0, time_s) * np.minimum(1.0, time_s[-1] - time_s)


def excitations(period_s):
    time_s = np.arange(round(DURATION_S / period_s)) * period_s
    window = gentle(time_s)
    sweep = window * np.sin(2 * np.pi * (0.3 * time_s + 0.25 * time_s**2))
    swing = window * np.sin(2 * np.pi * 1.1 * time_s)
    units = {"x": "m", "zn": "m"}
    for x, zn in ((4e-4 * swing, 20e-6 * sweep), (5e-5 * sweep, 25e-6 * swing)):
        commands = {("x", Tap.CMD): 0.0275 + x, ("zn", Tap.CMD): 32e-6 + zn}
        yield Record.from_signals(time_s, commands, units)


@pytest.fixture
def record(board_process, patiently):
    """Play both excitations on boards with a robot behind them; return the records."""
    return lambda robot: patiently(lambda events: played(board_process(robot), events))


def played(boards, events):
    with boards as ((port, second), _):
        session = MotionSession(MC68HC11(ROBOT, {"port": port, "second_port": second}))
        told = Told(session, events)
        session.start()
        try:
            told.until(lambda: session.snapshot().phase is Phase.READY, CONNECTING_S)
            for number, trajectory in enumerate(excitations(session.setpoint_period_s)):
                session.play(trajectory)
                told.until(lambda n=number: len(told.of(PlaybackFinished)) > n, PLAYING_S)
                # What was cut off still brakes; why it was is told when it stands.
                told.until(lambda: session.snapshot().activity in STILL, PLAYING_S)
                assert told.of(PlaybackFinished)[number].completed
            link = session.snapshot().link
        finally:
            session.close()
    assert not told.of(Faulted)
    assert not told.of(CommandRefused)
    assert link.rejected == 0
    records = [one.record for one in told.of(PlaybackFinished)]
    for one in records:
        np.testing.assert_allclose(np.diff(one.time_s), PERIOD_S, rtol=1e-6, err_msg=HOLES)
    return records


def effects_file(folder, axis, effect):
    path = folder / f"{effect}.toml"
    text = files("rotemina.resources.robots").joinpath("rotemina.toml").read_text("utf-8")
    path.write_text(f'{text}\n[[axis.{axis}.effect]]\nid = "{effect}"\n', "utf-8")
    return path


def test_what_the_nominal_machine_played_shows_no_gap(record):
    records = record("rotemina")
    for one, asked in zip(records, excitations(PERIOD_S), strict=True):
        for axis, step in (("x", 1e-7), ("zn", 1e-9)):
            wanted = asked.signal(axis, Tap.CMD)
            assert np.abs(one.signal(axis, Tap.CMD) - wanted).max() <= 0.5001 * step
    diagnosis = diagnose(ROBOT, records)
    assert diagnosis.verdict.value == "none"
    assert not diagnosis.causes


@pytest.mark.parametrize(("axis", "effect"), [("zn", "hysteresis"), ("x", "backlash")])
def test_a_machine_with_one_effect_is_diagnosed_as_that_effect(tmp_path, record, axis, effect):
    records = record(effects_file(tmp_path, axis, effect))
    diagnosis = diagnose(ROBOT, records)
    assert diagnosis.verdict.value == "explained"
    assert [(one.axis, one.effect) for one in diagnosis.causes] == [(axis, effect)]
    assert diagnosis.causes[0].closed >= 0.95


def recover(session):
    """Do the next thing that an operator would do to be able to move again."""
    state = session.snapshot()
    if state.phase is Phase.DISCONNECTED:
        session.reconnect()
    elif state.fault is not None:
        session.service.clear_fault()
    elif state.unhomed:
        session.home()
    elif state.locked and "confirm" in state.locked:
        session.confirm_position()


def test_the_worker_outlives_a_line_that_misbehaves(board_process):
    rng = np.random.default_rng(0)
    faults = ("silence 0.2 s", "silence 1 s", "reset 1", "brown-out 2", "garbage 20", "space 0.1 s")
    with board_process("rotemina", "--mishaps", "2") as ((port, second), commands):
        session = MotionSession(MC68HC11(ROBOT, {"port": port, "second_port": second}))
        told = Told(session, [])
        session.start()
        asked = 0
        try:
            told.until(lambda: session.snapshot().phase is Phase.READY, CONNECTING_S)
            end_s = time.monotonic() + MISBEHAVING_S
            while time.monotonic() < end_s:
                with suppress(RefusedError):
                    recover(session)
                    session.go_to({"zn": float(rng.uniform(5e-6, 60e-6))})
                    asked += 1
                if rng.uniform() < 0.05:
                    commands.write(f"{faults[rng.integers(len(faults))]}\n")
                    commands.flush()
                until_s = min(time.monotonic() + 0.1, end_s)
                while time.monotonic() < until_s:
                    told.wait(until_s - time.monotonic())
            session.stop()
        finally:
            ended = session.close()
    assert ended
    assert asked > 20
    assert not [event for event in told.of(Faulted) if "unexpected" in event.message]
