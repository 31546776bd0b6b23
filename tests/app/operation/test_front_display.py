"""The two-row display at the machine: mode, position and problems."""

from dataclasses import replace

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.app.operation.front_display import FrontDisplay, format_rows
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
READY = SessionState(
    connection=ConnectionState.CONNECTED,
    activity=DeviceState.IDLE,
    command={"x": 0.0275, "y": 0.001, "z": 0.04, "thx": 5.8178e-4, "thy": -1e-6, "zn": 3.25e-5},
    position_known=True,
    tip=(0.0275, -0.001, 0.0),
)


@pytest.mark.parametrize(
    ("mode", "first_row", "second_row"),
    [
        ("micro", "micro mm       ready", "27.500  1.000 40.000"),
        ("nano", "nano urad um   ready", "581.78 -1.000 32.500"),
        ("fine", "fine tip mm    ready", "27.500 -1.000  0.000"),
    ],
)
def test_the_rows_show_mode_and_position(mode, first_row, second_row):
    assert format_rows(READY, mode, ROBOT, 0.0) == (first_row, second_row)


def test_a_robot_without_stages_shows_its_axes_and_unknown_ones_as_dashes():
    robot = load_robot("picma")
    rows = format_rows(replace(READY, command={"p": 1.5e-5}), "axes", robot, 0.0)
    assert rows == ("axes um        ready", "15.000")
    assert format_rows(replace(READY, command={}), "axes", robot, 0.0)[1] == "------"


@pytest.mark.parametrize(
    ("problem", "status", "text"),
    [
        ({"fault": "board 1: watchdog"}, "fault", "board 1: watchdog"),
        ({"latch_reason": "the emergency stop"}, "ready", "the emergency stop"),
        ({"fault": "axis θx: 3 µm"}, "fault", "axis thx: 3 um"),
        (
            {"position_known": False, "lock_reason": "home first"},
            "position unknown", "home first",
        ),
    ],
)  # fmt: skip
def test_a_problem_replaces_the_position(problem, status, text):
    first_row, second_row = format_rows(replace(READY, **problem), "micro", ROBOT, 0.0)
    assert first_row.endswith(status)
    assert len(first_row) == 20
    assert second_row == text


def test_a_long_text_is_shown_in_parts():
    state = replace(READY, fault="the sensor of axis x says what cannot be")
    parts = [format_rows(state, "micro", ROBOT, 2.0 * k)[1] for k in range(3)]
    assert parts == ["the sensor of axis x", "says what cannot be", "the sensor of axis x"]


class RecordingSimulator(Simulator):
    """A simulator that records the rows that it shows."""

    def _show(self, row, text):
        self.__dict__.setdefault("shown_rows", []).append((row, text.rstrip()))
        super()._show(row, text)


@pytest.fixture
def machine(clock):
    driver = RecordingSimulator(ROBOT, clock=clock)
    session = MotionSession(driver)
    yield driver, session, FrontDisplay(session, lambda: "micro")
    session.close()


def test_only_changed_rows_are_sent_and_none_without_a_connection(machine, clock):
    driver, session, display = machine
    display.step(clock())
    assert not hasattr(driver, "shown_rows")
    session.connect()
    session.run_once()
    clock.advance(0.1)
    session.run_once()
    for _ in range(3):
        display.step(clock())
        session.run_once()
    assert driver.shown_rows == [(0, "micro mm       ready"), (1, "27.500 27.500 40.000")]
    session.go_to({"x": 0.0280})
    session.run_once()
    clock.advance(0.03)
    session.run_once()
    display.step(clock())
    session.run_once()
    assert driver.shown_rows[2] == (0, "micro mm      moving")
    assert driver.display_rows[1].startswith("27.5")
    session.disconnect()
    session.run_once()
    display.step(clock())
    session.connect()
    session.run_once()
    clock.advance(0.1)
    session.run_once()
    previous_count = len(driver.shown_rows)
    display.step(clock())
    session.run_once()
    # Both rows, because the device may be another one.
    assert len(driver.shown_rows) == previous_count + 2


def test_nothing_is_sent_while_a_trajectory_plays(machine, clock, monkeypatch):
    driver, session, display = machine
    session.connect()
    session.run_once()
    playing_state = replace(READY, activity=DeviceState.PLAYING)
    monkeypatch.setattr(session, "snapshot", lambda: playing_state)
    display.step(clock())
    session.run_once()
    assert not hasattr(driver, "shown_rows")
