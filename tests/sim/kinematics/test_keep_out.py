"""Bounds of the tip: the swept box contains all paths, and moves out of bounds are refused."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotemina.sim.errors import ChainError, OutOfLimitsError
from rotemina.sim.kinematics import MAX_SLOW_ZONE_SPEED_M_PER_S, KeepOutZone
from rotemina.sim.robot import KeepOut
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
MIDDLE = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
RANGES = np.array([axis.range for axis in ROBOT.axes.values()])


def make_zone(**bounds):
    return KeepOutZone.of(replace(ROBOT, keep_out=KeepOut(**bounds)))


@st.composite
def draw_positions(draw):
    shares = draw(st.lists(st.floats(0, 1), min_size=6, max_size=6))
    return RANGES[:, 0] + np.array(shares) * np.ptp(RANGES, axis=1)


@settings(max_examples=60)
@given(draw_positions(), draw_positions(), st.integers(0, 2**32 - 1))
def test_the_swept_box_contains_every_path_between_two_positions(first, second, seed):
    low, high = np.minimum(first, second), np.maximum(first, second)
    unbounded_zone = make_zone()
    box = unbounded_zone.find_swept_box(low, high)
    tips = unbounded_zone.tip_at(np.random.default_rng(seed).uniform(low, high, (200, 6)))
    assert (tips >= box.low - 1e-12).all()
    assert (tips <= box.high + 1e-12).all()
    corners = unbounded_zone.tip_at(np.stack([low, high]))
    assert box.high[2] - box.low[2] <= np.ptp(corners[:, 2]) + 1e-6


def test_a_robot_without_bounds_is_not_bounded():
    assert not make_zone().is_bounded
    make_zone().check_sweep(RANGES[:, 0], RANGES[:, 1])
    assert KeepOutZone.of(load_robot("picma")) is None
    with pytest.raises(ChainError, match="needs a tip to limit"):
        KeepOutZone.of(replace(load_robot("picma"), keep_out=KeepOut(floor=0.0)))


@pytest.mark.parametrize(
    ("bounds", "axis", "position", "message"),
    [
        ({"floor": -0.01}, "z", 0.02, "its floor is"),
        ({"objective": 0.01}, "z", 0.06, "the objective is at"),
        ({"objective": -0.02}, "z", 0.01, "its floor is"),
        ({"radius": 0.01}, "x", 0.04, "from the middle"),
    ],
)
def test_each_bound_refuses_moves_out_of_it_and_allows_others(bounds, axis, position, message):
    column = list(ROBOT.axes).index(axis)
    outside, inside = MIDDLE.copy(), MIDDLE.copy()
    outside[column] = position
    inside[column] = MIDDLE[column] + 0.1 * (position - MIDDLE[column])
    zone = make_zone(**bounds)
    for end, is_refused in ((outside, True), (inside, False)):
        sweep = np.minimum(MIDDLE, end), np.maximum(MIDDLE, end)
        path = np.linspace(MIDDLE, end, 50)
        time_s = np.arange(50) * 1.0
        if not is_refused:
            zone.check_sweep(*sweep)
            zone.check_path(path, 100 * time_s)
            continue
        with pytest.raises(OutOfLimitsError, match=message):
            zone.check_sweep(*sweep)
        with pytest.raises(OutOfLimitsError, match=rf"{message}|descends"):
            zone.check_path(path, time_s)


def test_a_tip_out_of_bounds_is_refused_unless_the_bounds_are_widened():
    zone = make_zone(floor=0.01)
    present = zone.find_swept_box(MIDDLE, MIDDLE)
    up, down = MIDDLE.copy(), MIDDLE.copy()
    up[2] += 0.02
    down[2] -= 1e-6
    assert zone.measure_excess(present).is_outside
    with pytest.raises(OutOfLimitsError, match="its floor is"):
        zone.check_sweep(MIDDLE, up)
    zone.widen_to(present).check_sweep(MIDDLE, up)
    with pytest.raises(OutOfLimitsError, match="its floor is"):
        zone.widen_to(present).check_sweep(down, MIDDLE)


@pytest.mark.parametrize(("objective", "side"), [(-0.02, 0), (0.02, 1)])
def test_floor_and_objective_are_independent_bounds(objective, side):
    zone = make_zone(objective=objective)
    for floor in (-0.03, -0.01, None):
        taught = zone.with_floor(floor)
        assert taught.objective == zone.objective
        assert taught.objective[side] == objective
    assert zone.with_floor(-0.03).low == (objective if side == 0 else -0.03)
    assert zone.with_floor(-0.03).with_floor(None).low == zone.low
    taught = make_zone(floor=-0.03).with_floor(0.0)
    assert taught.low == 0.0
    assert not taught.with_floor(None).is_bounded


@pytest.mark.parametrize("floor", [np.nan, np.inf, -0.041, 0.021])
def test_a_floor_that_the_tip_cannot_reach_is_refused(floor):
    with pytest.raises(OutOfLimitsError, match=r"must be between -40(\.\d+)? mm and 20 mm"):
        make_zone(objective=0.02).with_floor(floor)


@pytest.mark.parametrize(("speed_ratio", "is_refused"), [(0.9, False), (1.1, True)])
def test_a_path_close_above_the_floor_must_descend_slowly(speed_ratio, is_refused):
    tip = float(make_zone().tip_at(MIDDLE)[2])
    zone = make_zone(floor=tip - 1e-3)
    time_s = np.linspace(0, 1.0, 101)
    path = np.tile(MIDDLE, (101, 1))
    path[:, 2] -= 0.6e-3 + speed_ratio * MAX_SLOW_ZONE_SPEED_M_PER_S * np.minimum(time_s, 0.7)
    path[0, 2] = MIDDLE[2] - 0.6e-3
    if is_refused:
        with pytest.raises(OutOfLimitsError, match="make the approach slower"):
            zone.check_path(path, time_s)
    else:
        zone.check_path(path, time_s)
