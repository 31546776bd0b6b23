"""The tip's bounds: what is swept contains every way, and nothing leaves."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotemina.sim.kinematics.chain import ChainError
from rotemina.sim.kinematics.keep_out import SLOW_SPEED, KeepOutZone
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import KeepOut
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

ROBOT = load_robot("rotemina")
MIDDLE = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
RANGES = np.array([axis.range for axis in ROBOT.axes.values()])


def zone(**bounds):
    return KeepOutZone.of(replace(ROBOT, keep_out=KeepOut(**bounds)))


@st.composite
def places(draw):
    shares = draw(st.lists(st.floats(0, 1), min_size=6, max_size=6))
    return RANGES[:, 0] + np.array(shares) * np.ptp(RANGES, axis=1)


@settings(max_examples=60)
@given(places(), places(), st.integers(0, 2**32 - 1))
def test_the_swept_box_holds_every_way_between_two_places(first, second, seed):
    low, high = np.minimum(first, second), np.maximum(first, second)
    free = zone()
    box = free.swept(low, high)
    tips = free.tip(np.random.default_rng(seed).uniform(low, high, (200, 6)))
    assert (tips >= box.low - 1e-12).all()
    assert (tips <= box.high + 1e-12).all()
    corners = free.tip(np.stack([low, high]))
    assert box.high[2] - box.low[2] <= np.ptp(corners[:, 2]) + 1e-6


def test_a_robot_without_bounds_is_not_bounded():
    assert not zone().bounded
    zone().check_sweep(RANGES[:, 0], RANGES[:, 1])
    assert KeepOutZone.of(load_robot("picma")) is None
    with pytest.raises(ChainError, match="needs a tip to limit"):
        KeepOutZone.of(replace(load_robot("picma"), keep_out=KeepOut(floor=0.0)))


@pytest.mark.parametrize(
    ("bounds", "axis", "to", "message"),
    [
        ({"floor": -0.01}, "z", 0.02, "its floor is"),
        ({"objective": 0.01}, "z", 0.06, "the objective is at"),
        ({"objective": -0.02}, "z", 0.01, "its floor is"),
        ({"radius": 0.01}, "x", 0.04, "from the middle"),
    ],
)
def test_each_bound_refuses_what_leaves_it_and_allows_the_rest(bounds, axis, to, message):
    column = list(ROBOT.axes).index(axis)
    wrong, right = MIDDLE.copy(), MIDDLE.copy()
    wrong[column] = to
    right[column] = MIDDLE[column] + 0.1 * (to - MIDDLE[column])
    bound = zone(**bounds)
    for end, refused in ((wrong, True), (right, False)):
        sweep = np.minimum(MIDDLE, end), np.maximum(MIDDLE, end)
        path = np.linspace(MIDDLE, end, 50)
        time_s = np.arange(50) * 1.0
        if not refused:
            bound.check_sweep(*sweep)
            bound.check_path(path, 100 * time_s)
            continue
        with pytest.raises(OutOfLimitsError, match=message):
            bound.check_sweep(*sweep)
        with pytest.raises(OutOfLimitsError, match=rf"{message}|descends"):
            bound.check_path(path, time_s)


def test_a_tip_that_is_out_already_is_refused_every_way_and_bounds_about_it_hold_it():
    bound = zone(floor=0.01)
    present = bound.swept(MIDDLE, MIDDLE)
    up, down = MIDDLE.copy(), MIDDLE.copy()
    up[2] += 0.02
    down[2] -= 1e-6
    assert bound.excess(present).any
    with pytest.raises(OutOfLimitsError, match="its floor is"):
        bound.check_sweep(MIDDLE, up)
    bound.beyond(present).check_sweep(MIDDLE, up)
    with pytest.raises(OutOfLimitsError, match="its floor is"):
        bound.beyond(present).check_sweep(down, MIDDLE)


@pytest.mark.parametrize(("objective", "side"), [(-0.02, 0), (0.02, 1)])
def test_floor_and_objective_are_bounds_of_their_own(objective, side):
    bound = zone(objective=objective)
    for floor in (-0.03, -0.01, None):
        taught = bound.taught(floor)
        assert taught.objective == bound.objective
        assert taught.objective[side] == objective
    assert bound.taught(-0.03).low == (objective if side == 0 else -0.03)
    assert bound.taught(-0.03).taught(None).low == bound.low


@pytest.mark.parametrize("floor", [np.nan, np.inf, -np.inf, 1e308, -0.041, 0.021])
def test_a_floor_is_a_height_that_the_tip_can_have(floor):
    with pytest.raises(OutOfLimitsError, match=r"must be between -40(\.\d+)? mm and 20 mm"):
        zone(objective=0.02).taught(floor)


@pytest.mark.parametrize(("times", "refused"), [(0.9, False), (1.1, True)])
def test_a_path_goes_down_slowly_close_above_the_floor(times, refused):
    tip = float(zone().tip(MIDDLE)[2])
    bound = zone(floor=tip - 1e-3)
    time_s = np.linspace(0, 1.0, 101)
    path = np.tile(MIDDLE, (101, 1))
    path[:, 2] -= 0.6e-3 + times * SLOW_SPEED * np.minimum(time_s, 0.7)
    path[0, 2] = MIDDLE[2] - 0.6e-3
    if refused:
        with pytest.raises(OutOfLimitsError, match="make the approach slower"):
            bound.check_path(path, time_s)
    else:
        bound.check_path(path, time_s)


def test_a_taught_floor_replaces_the_one_of_the_file():
    bound = zone(floor=-0.03).taught(0.0)
    assert bound.low == 0.0
    assert not bound.taught(None).bounded
