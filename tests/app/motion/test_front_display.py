"""The display of two rows at the machine: mode, position, and what is wrong."""

from dataclasses import replace

import pytest

from rotemina.app.motion.front_display import FrontDisplay, rows_of
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection, SessionState
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
READY = SessionState(
    connection=Connection.CONNECTED,
    activity=DeviceState.IDLE,
    command={"x": 0.0275, "y": 0.001, "z": 0.04, "thx": 5.8178e-4, "thy": -1e-6, "zn": 3.25e-5},
    position_known=True,
    tip=(0.0275, -0.001, 0.0),
)


@pytest.mark.parametrize(
    ("mode", "above", "below"),
    [
        ("micro", "micro mm       ready", "27.500  1.000 40.000"),
        ("nano", "nano urad um   ready", "581.78 -1.000 32.500"),
        ("fine", "fine tip mm    ready", "27.500 -1.000  0.000"),
    ],
)
def test_mode_and_position(mode, above, below):
    assert rows_of(READY, mode, ROBOT, 0.0) == (above, below)


def test_a_robot_without_stages_shows_its_axes_and_unknown_ones_as_dashes():
    robot = load_robot("picma")
    shown = rows_of(replace(READY, command={"p": 1.5e-5}), "axes", robot, 0.0)
    assert shown == ("axes um        ready", "15.000")
    assert rows_of(replace(READY, command={}), "axes", robot, 0.0)[1] == "------"


@pytest.mark.parametrize(
    ("wrong", "word", "said"),
    [
        ({"fault": "board 1: watchdog"}, "fault", "board 1: watchdog"),
        ({"latched": "the emergency stop"}, "ready", "the emergency stop"),
        ({"fault": "axis θx: 3 µm"}, "fault", "axis thx: 3 um"),
        (
            {"position_known": False, "locked": "home first"},
            "position unknown", "home first",
        ),
    ],
)  # fmt: skip
def test_what_is_wrong_takes_the_place_of_the_position(wrong, word, said):
    above, below = rows_of(replace(READY, **wrong), "micro", ROBOT, 0.0)
    assert above.endswith(word)
    assert len(above) == 20
    assert below == said


def test_a_long_text_comes_part_by_part():
    state = replace(READY, fault="the sensor of axis x says what cannot be")
    parts = [rows_of(state, "micro", ROBOT, 2.0 * k)[1] for k in range(3)]
    assert parts == ["the sensor of axis x", "says what cannot be", "the sensor of axis x"]


class Told(Simulator):
    """A simulator that counts what it is asked to show."""

    def _show(self, row, text):
        self.__dict__.setdefault("asked", []).append((row, text.rstrip()))
        super()._show(row, text)


@pytest.fixture
def machine(clock):
    driver = Told(ROBOT, clock=clock)
    session = MotionSession(driver)
    yield driver, session, FrontDisplay(session, lambda: "micro")
    session.close()


def test_only_what_has_changed_is_sent_and_nothing_without_a_connection(machine, clock):
    driver, session, display = machine
    display.step(clock())
    assert not hasattr(driver, "asked")
    session.connect()
    session.run_once()
    clock.advance(0.1)
    session.run_once()
    for _ in range(3):
        display.step(clock())
        session.run_once()
    assert driver.asked == [(0, "micro mm       ready"), (1, "27.500 27.500 40.000")]
    session.go_to({"x": 0.0280})
    session.run_once()
    clock.advance(0.03)
    session.run_once()
    display.step(clock())
    session.run_once()
    assert driver.asked[2] == (0, "micro mm      moving")
    assert driver.shown[1].startswith("27.5")
    session.disconnect()
    session.run_once()
    display.step(clock())
    session.connect()
    session.run_once()
    clock.advance(0.1)
    session.run_once()
    before = len(driver.asked)
    display.step(clock())
    session.run_once()
    assert len(driver.asked) == before + 2  # to a device that may be another one: both rows


def test_while_a_trajectory_plays_the_line_is_left_to_it(machine, clock, monkeypatch):
    driver, session, display = machine
    session.connect()
    session.run_once()
    playing = replace(READY, activity=DeviceState.PLAYING)
    monkeypatch.setattr(session, "snapshot", lambda: playing)
    display.step(clock())
    session.run_once()
    assert not hasattr(driver, "asked")
