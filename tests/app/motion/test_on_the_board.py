"""End to end: a trajectory on virtual boards at the real baud rate, recorded and diagnosed."""

from importlib.resources import files

import numpy as np
import pytest
from tests.app.motion.event_log import EventLog

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    CommandRefused,
    FaultRaised,
    PlaybackFinished,
    SessionPhase,
)
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.slow
ROBOT = load_robot("rotemina")
CONNECTING_S, PLAYING_S = 20.0, 30.0
DURATION_S = 8.0
PERIOD_S = 5e-3
STANDSTILL_STATES = (DeviceState.IDLE, DeviceState.FAULT, DeviceState.CLOSED)
GAP_MESSAGE = "samples are missing"


def make_window(time_s):
    """Return a window that rises and falls in one second at the ends."""
    return np.minimum(1.0, time_s) * np.minimum(1.0, time_s[-1] - time_s)


def make_excitations(period_s):
    time_s = np.arange(round(DURATION_S / period_s)) * period_s
    window = make_window(time_s)
    sweep = window * np.sin(2 * np.pi * (0.3 * time_s + 0.25 * time_s**2))
    swing = window * np.sin(2 * np.pi * 1.1 * time_s)
    units = {"x": "m", "zn": "m"}
    for x, zn in ((4e-4 * swing, 20e-6 * sweep), (5e-5 * sweep, 25e-6 * swing)):
        commands = {("x", Tap.CMD): 0.0275 + x, ("zn", Tap.CMD): 32e-6 + zn}
        yield Record.from_signals(time_s, commands, units)


@pytest.fixture
def record_excitations(board_process, retry_when_starved):
    """Return a function that plays both excitations on the boards of a robot."""
    return lambda robot: retry_when_starved(
        lambda events: play_excitations(board_process(robot), events)
    )


def play_excitations(boards, events):
    with boards as ((port, second), _):
        session = MotionSession(MC68HC11Driver(ROBOT, {"port": port, "second_port": second}))
        event_log = EventLog(session, events)
        session.start()
        try:
            event_log.wait_until(
                lambda: session.snapshot().phase is SessionPhase.READY, CONNECTING_S
            )
            for number, trajectory in enumerate(make_excitations(session.setpoint_period_s)):
                session.play(trajectory)
                event_log.wait_until(
                    lambda n=number: len(event_log.list_events(PlaybackFinished)) > n, PLAYING_S
                )
                # An interrupted playback still brakes; its reason is reported at standstill.
                event_log.wait_until(
                    lambda: session.snapshot().activity in STANDSTILL_STATES, PLAYING_S
                )
                assert event_log.list_events(PlaybackFinished)[number].completed
            link = session.snapshot().link
        finally:
            session.close()
    assert not event_log.list_events(FaultRaised)
    assert not event_log.list_events(CommandRefused)
    assert link.rejected == 0
    records = [record.record for record in event_log.list_events(PlaybackFinished)]
    for record in records:
        np.testing.assert_allclose(np.diff(record.time_s), PERIOD_S, rtol=1e-6, err_msg=GAP_MESSAGE)
    return records


def write_effect_file(folder, axis, effect):
    path = folder / f"{effect}.toml"
    text = files("rotemina.resources.robots").joinpath("rotemina.toml").read_text("utf-8")
    path.write_text(f'{text}\n[[axis.{axis}.effect]]\nid = "{effect}"\n', "utf-8")
    return path


def test_a_record_of_the_nominal_machine_shows_no_gap(record_excitations):
    records = record_excitations("rotemina")
    for record, trajectory in zip(records, make_excitations(PERIOD_S), strict=True):
        for axis, step in (("x", 1e-7), ("zn", 1e-9)):
            command = trajectory.signal(axis, Tap.CMD)
            assert np.abs(record.signal(axis, Tap.CMD) - command).max() <= 0.5001 * step
    diagnosis = diagnose(ROBOT, records)
    assert diagnosis.verdict.value == "none"
    assert not diagnosis.causes


@pytest.mark.parametrize(("axis", "effect"), [("zn", "hysteresis"), ("x", "backlash")])
def test_the_effect_of_a_machine_is_diagnosed(tmp_path, record_excitations, axis, effect):
    records = record_excitations(write_effect_file(tmp_path, axis, effect))
    diagnosis = diagnose(ROBOT, records)
    assert diagnosis.verdict.value == "explained"
    assert [(cause.axis, cause.effect) for cause in diagnosis.causes] == [(axis, effect)]
    assert diagnosis.causes[0].closed >= 0.95
