"""What the control menu says, and what a typed target means."""

import numpy as np
import pytest

from rotemina.app.display_units import axis_scale
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.simulator.driver import Simulator
from rotemina.plugins.control.large_move_confirmation import SETTLE_S, Confirmation
from rotemina.plugins.control.panel import forbidden
from rotemina.plugins.control.wording import (
    age_text,
    bounds_text,
    difference_text,
    echo,
    grade_of,
    is_little,
    range_tip,
    room_left_text,
    status_text,
    taken,
    tip_short,
    tip_text,
    typed,
    way,
)
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
X, ZN = ROBOT.axes["x"], ROBOT.axes["zn"]
MM, UM = axis_scale(X), axis_scale(ZN)


@pytest.mark.parametrize(
    "text", ["1_0", "٢٥", "nan", "inf", "0x10", "2 8", "", "1e", "2,8", "1,000", "1.000,5", "+-1"]
)
def test_only_plain_numbers_mean_a_position(text):
    assert typed(text, MM) is None
    assert way(text, MM, 0.0) == ""


def test_a_typed_number_is_read_back_with_its_unit_and_its_way():
    assert typed(" 28.5 ", MM) == pytest.approx(0.0285)
    assert echo("28.5", MM) == "to 28.5000 mm"
    assert way("28.5", MM, 0.0275) == "+1.0000 mm"
    assert way("26.5", MM, 0.0275) == "-1.0000 mm"
    assert echo("1e1", UM) == "to 10.000 µm"
    assert echo("", MM) == ""
    assert "no comma" in echo("2,8", MM)
    assert echo("two", MM) == "not a number"


def test_ages_keep_short():
    assert [age_text(age) for age in (None, 1.25, 600.0, 36000.0)] == [
        "no data",
        "1.2 s old",
        "10 min old",
        "10 h old",
    ]


def test_what_matters_most_of_an_axis_is_said():
    state = SessionState(measured={"x": 0.02}, command={"x": 0.021}, position_known=True, age_s=0.1)
    assert status_text("x", state, MM) == "→ 21.0000"
    assert status_text("y", state, MM) == ""
    driven = SessionState(
        measured={"x": 0.02},
        command={"x": 0.021},
        position_known=True,
        age_s=0.1,
        owners={"x": "joystick"},
    )
    assert status_text("x", driven, MM) == "→ 21.0000"
    old = SessionState(measured={"x": 0.02}, command={"x": 0.0}, position_known=True, age_s=3.0)
    assert status_text("x", old, MM) == "3.0 s old"
    lost = SessionState(measured={"x": 0.02}, command={"x": 0.0}, age_s=3.0, unhomed=("x",))
    assert status_text("x", lost, MM) == "not homed"


def test_what_is_left_of_a_piezo_is_the_way_to_the_nearer_end():
    low, high = ZN.range
    assert room_left_text(high - 2e-6, ZN.range, UM) == "2.0 µm left"
    assert room_left_text(low + 3e-6, ZN.range, UM) == "3.0 µm left"
    assert room_left_text(high + 1e-6, ZN.range, UM) == "0.0 µm left"
    assert room_left_text(None, ZN.range, UM) == ""
    assert is_little(high - 2e-6, ZN.range)
    assert not is_little((low + high) / 2, ZN.range)
    assert "2.000 µm up" in range_tip("zn", high - 2e-6, ZN.range, UM)


def test_a_playback_cannot_be_taken_over():
    state = SessionState(owners={"x": "joystick", "y": "joystick", "zn": "playback"})
    assert taken(state) == ("x", "y")


def test_the_tip_is_told_over_its_floor():
    clock = VirtualClock(1.0)
    session = MotionSession(Simulator(ROBOT, clock=clock), clock=clock)
    session.connect()
    session.run_once()
    clock.advance(0.02)
    session.run_once()
    state = session.snapshot()
    assert tip_short(state, session.bounds.keep_out) == "No floor taught"
    assert "Only the axis ranges limit the tip" in bounds_text(session.bounds.keep_out)
    session.bounds.teach_floor(2e-4)
    assert tip_short(state, session.bounds.keep_out) == "Tip over floor 0.2000 mm"
    assert tip_text(state, session.bounds.keep_out).endswith("; slow zone.")
    assert "500 µm/s at most" in bounds_text(session.bounds.keep_out)
    session.close()
    assert tip_text(SessionState(), session.bounds.keep_out) == "Tip: unknown."
    assert "no kinematic chain" in tip_text(state, None)


@pytest.fixture
def session():
    clock = VirtualClock(1.0)
    return MotionSession(Simulator(ROBOT, clock=clock), clock=clock)


def test_a_large_move_is_asked_for_twice_and_a_small_one_once(session):
    asked = Confirmation(1.0, session)
    assert asked.take(0.55, 0.5, 10.0)
    assert not asked.take(0.9, 0.5, 10.0)
    assert not asked.take(0.9, 0.5, 10.0 + 0.5 * SETTLE_S)  # a double click is no answer
    assert asked.take(0.9, 0.5, 10.0 + SETTLE_S)
    assert asked.asked is None


def test_a_stop_withdraws_the_question_whoever_asks_for_it(session):
    asked = Confirmation(1.0, session)
    for stop in (session.stop, session.emergency_stop):
        assert not asked.take(0.9, 0.5, 10.0)
        stop()
        session.release()
        assert asked.asked is None
        assert not asked.take(0.9, 0.5, 20.0)  # asked anew
        asked.withdraw()


def test_another_target_or_another_place_is_another_question(session):
    asked = Confirmation(1.0, session)
    assert not asked.take(0.9, 0.5, 10.0)
    assert not asked.take(0.8, 0.5, 20.0)
    assert not asked.take(0.8, 0.1, 30.0)
    asked.follow(0.1)
    assert asked.asked is not None
    asked.follow(0.11)
    assert asked.asked is None
    assert not asked.take(0.8, 0.11, 40.0)
    asked.withdraw()
    assert not asked.take(0.8, 0.11, 50.0)


@pytest.mark.parametrize(
    ("floors", "grade"), [(0.0, "plain"), (2.9, "plain"), (-3.1, "apart"), (1e5, "beyond")]
)
def test_a_reading_apart_from_its_command_is_graded_by_the_sensors_floor(floors, grade):
    plain = max(ZN.sensor.noise_floor, 2.0 / 3.0 * ZN.sensor.resolution)
    assert grade_of(floors * plain, ZN) == grade
    assert grade_of(-1.001 * ZN.following, ZN) == "beyond"


def test_a_difference_has_a_sign_and_the_digits_of_its_reading():
    assert difference_text(4.7e-6, UM) == "+4.700"
    assert difference_text(-1.2e-8, UM) == "-0.012"


def test_what_the_tips_bounds_forbid_begins_where_the_tip_would_reach_them():
    command = {name: sum(axis.range) / 2 for name, axis in ROBOT.axes.items()}
    zone = KeepOutZone.of(ROBOT)
    height = zone.tip(np.array(list(command.values())))[2]
    found = forbidden(ROBOT, zone.taught(height - 1e-3), command)
    ((low, high),) = found["z"]
    assert low == ROBOT.axes["z"].range[0]
    assert high == pytest.approx(command["z"] - 1e-3, abs=1e-6)
    assert "x" not in found
    assert forbidden(ROBOT, None, command) == {}
