"""The texts of the control panel, and how typed targets are read."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.language import choose_axis_scale
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.plugins.control.large_move_confirmation import (
    MIN_ANSWER_DELAY_S,
    LargeMoveConfirmation,
)
from rotemina.plugins.control.panel import find_forbidden_stretches
from rotemina.plugins.control.wording import (
    describe_bounds,
    describe_status,
    describe_tip,
    describe_tip_briefly,
    echo_target,
    find_takeable_axes,
    format_distance,
    format_remaining_travel,
    grade_deviation,
    is_near_end,
    parse_target,
)
from rotemina.sim.kinematics import KeepOutZone
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
X, ZN = ROBOT.axes["x"], ROBOT.axes["zn"]
MM, UM = choose_axis_scale(X), choose_axis_scale(ZN)


@pytest.fixture
def clock():
    return VirtualClock(1.0)


@pytest.fixture
def session(clock):
    return MotionSession(Simulator(ROBOT, clock=clock), clock=clock)


@pytest.mark.parametrize("text", ["1_0", "٢٥", "nan", "inf", "0x10", "2 8", "", "1e", "2,8", "+-1"])
def test_only_plain_numbers_are_read_as_positions(text):
    assert parse_target(text, MM) is None
    assert format_distance(text, MM, 0.0) == ""


def test_a_typed_target_is_echoed_with_its_unit_and_distance():
    assert parse_target(" 28.5 ", MM) == pytest.approx(0.0285)
    assert echo_target("28.5", MM) == "to 28.5000 mm"
    assert format_distance("28.5", MM, 0.0275) == "+1.0000 mm"
    assert format_distance("26.5", MM, 0.0275) == "-1.0000 mm"
    assert echo_target("1e1", UM) == "to 10.000 µm"
    assert echo_target("", MM) == ""
    assert "no comma" in echo_target("2,8", MM)
    assert echo_target("two", MM) == "not a number"


def test_the_status_shows_what_matters_most_of_an_axis():
    state = SessionState(measured={"x": 0.02}, command={"x": 0.021}, position_known=True, age_s=0.1)
    outdated = replace(state, age_s=3.0)
    for axis, axis_state, text in (
        ("x", state, "→ 21.0000"),
        ("y", state, ""),
        ("x", replace(state, owners={"x": "joystick"}), "→ 21.0000"),
        ("x", outdated, "3.0 s old"),
        ("x", replace(outdated, position_known=False, unhomed=("x",)), "not homed"),
    ):
        assert describe_status(axis, axis_state, MM) == text


def test_the_room_left_of_a_piezo_is_the_distance_to_the_nearer_end():
    low, high = ZN.range
    assert format_remaining_travel(high - 2e-6, ZN.range, UM) == "2.0 µm left"
    assert format_remaining_travel(low + 3e-6, ZN.range, UM) == "3.0 µm left"
    assert format_remaining_travel(high + 1e-6, ZN.range, UM) == "0.0 µm left"
    assert format_remaining_travel(None, ZN.range, UM) == ""
    assert is_near_end(high - 2e-6, ZN.range)
    assert not is_near_end((low + high) / 2, ZN.range)


def test_a_playback_cannot_be_taken_over():
    state = SessionState(owners={"x": "joystick", "y": "joystick", "zn": "playback"})
    assert find_takeable_axes(state) == ("x", "y")


def test_the_tip_is_described_by_its_height_above_the_floor(session, clock):
    session.connect()
    session.run_once()
    clock.advance(0.02)
    session.run_once()
    state = session.snapshot()
    assert describe_tip_briefly(state, session.bounds.keep_out) == "No floor taught"
    assert "Only the axis ranges limit the tip" in describe_bounds(session.bounds.keep_out)
    session.bounds.teach_floor(2e-4)
    assert describe_tip_briefly(state, session.bounds.keep_out) == "Tip 0.2000 mm above floor"
    assert describe_tip(state, session.bounds.keep_out).endswith("; slow zone.")
    assert "500 µm/s at most" in describe_bounds(session.bounds.keep_out)
    session.close()
    assert describe_tip(SessionState(), session.bounds.keep_out) == "Tip: unknown."
    assert "no kinematic chain" in describe_tip(state, None)


def test_only_a_large_move_must_be_requested_twice(session):
    confirmation = LargeMoveConfirmation(1.0, session)
    assert confirmation.request_permit(0.55, 0.5, 10.0)
    assert not confirmation.request_permit(0.9, 0.5, 10.0)
    # A double click does not count as a confirmation.
    assert not confirmation.request_permit(0.9, 0.5, 10.0 + 0.5 * MIN_ANSWER_DELAY_S)
    assert confirmation.request_permit(0.9, 0.5, 10.0 + MIN_ANSWER_DELAY_S)
    assert confirmation.unconfirmed_move is None


def test_every_kind_of_stop_cancels_the_confirmation(session):
    confirmation = LargeMoveConfirmation(1.0, session)
    for stop in (session.stop, session.emergency_stop):
        assert not confirmation.request_permit(0.9, 0.5, 10.0)
        stop()
        session.release()
        assert confirmation.unconfirmed_move is None
        assert not confirmation.request_permit(0.9, 0.5, 20.0)  # needs another confirmation
        confirmation.cancel()


def test_another_target_or_start_needs_another_confirmation(session):
    confirmation = LargeMoveConfirmation(1.0, session)
    assert not confirmation.request_permit(0.9, 0.5, 10.0)
    assert not confirmation.request_permit(0.8, 0.5, 20.0)
    assert not confirmation.request_permit(0.8, 0.1, 30.0)
    confirmation.cancel_if_moved(0.1)
    assert confirmation.unconfirmed_move is not None
    confirmation.cancel_if_moved(0.11)
    assert confirmation.unconfirmed_move is None
    assert not confirmation.request_permit(0.8, 0.11, 40.0)
    confirmation.cancel()
    assert not confirmation.request_permit(0.8, 0.11, 50.0)


@pytest.mark.parametrize(
    ("floors", "grade"), [(0.0, "plain"), (2.9, "plain"), (-3.1, "apart"), (1e5, "beyond")]
)
def test_a_deviation_from_the_command_is_graded_by_the_noise_floor(floors, grade):
    noise_floor = max(ZN.sensor.noise_floor, 2.0 / 3.0 * ZN.sensor.resolution)
    assert grade_deviation(floors * noise_floor, ZN) == grade
    assert grade_deviation(-1.001 * ZN.following_limit, ZN) == "beyond"


def test_forbidden_stretches_begin_where_the_tip_reaches_the_floor():
    command = {name: sum(axis.range) / 2 for name, axis in ROBOT.axes.items()}
    zone = KeepOutZone.of(ROBOT)
    height = zone.tip_at(np.array(list(command.values())))[2]
    stretches = find_forbidden_stretches(ROBOT, zone.with_floor(height - 1e-3), command)
    ((low, high),) = stretches["z"]
    assert low == ROBOT.axes["z"].range[0]
    assert high == pytest.approx(command["z"] - 1e-3, abs=1e-6)
    assert "x" not in stretches
    assert find_forbidden_stretches(ROBOT, None, command) == {}
