"""Inverse kinematics: round trips, the split between stages, refusals."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.kinematics import (
    KinematicChain,
    StageSplit,
    TipWorkspace,
    compute_tip_position,
    solve_nano,
    solve_tip,
)
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
CHAIN = KinematicChain.of(ROBOT)
START = CHAIN.centre
START_TIP = compute_tip_position(CHAIN, START)


def make_wide_chain(tilt=0.6):
    """Return a chain whose large tilts make all equations nonlinear."""
    axes = dict(ROBOT.axes)
    for name in ("thx", "thy"):
        axes[name] = replace(axes[name], range=(-tilt, tilt), voltage_range=None)
    axes["zn"] = replace(axes["zn"], range=(0.0, 0.01), voltage_range=None)
    return KinematicChain.of(replace(ROBOT, axes=axes))


WIDE = make_wide_chain()
shares = st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6).map(np.array)
splits = st.sampled_from(StageSplit)


def compute_joints(chain, share):
    return chain.lower + share * (chain.upper - chain.lower)


def compute_core_point(chain, share):
    core = TipWorkspace.of(chain).core
    return core.low + share[:3] * (core.high - core.low)


@given(share=shares, start_share=shares, split=splits, wide=st.booleans())
def test_round_trip_over_the_workspace(share, start_share, split, wide):
    chain = WIDE if wide else CHAIN
    target, start = compute_core_point(chain, share), compute_joints(chain, start_share)
    joints = solve_tip(chain, target, start, split)
    np.testing.assert_allclose(compute_tip_position(chain, joints), target, rtol=0, atol=1e-15)
    assert chain.is_inside(joints)


@given(share=shares, start_share=shares, wide=st.booleans())
def test_nano_joints_are_recovered_without_moving_the_tables(share, start_share, wide):
    """If only the nano joints differ, they follow from the tip, and no table moves."""
    chain = WIDE if wide else CHAIN
    joints, start = compute_joints(chain, share), compute_joints(chain, start_share)
    start[:3] = joints[:3]
    target = compute_tip_position(chain, joints)
    length = chain.pin_length - joints[5]
    for solved in (
        solve_nano(chain, target, start),
        solve_tip(chain, target, start, StageSplit.NANO_FIRST),
        solve_tip(chain, target, start, StageSplit.HYBRID),
    ):
        np.testing.assert_array_equal(solved[:3], start[:3])
        np.testing.assert_allclose(solved, joints, rtol=0, atol=1e-16 / length + 1e-15)


def test_a_small_step_is_made_by_the_nano_stage():
    step = np.array([1e-6, 2e-6, 3e-6])
    joints = solve_tip(CHAIN, START_TIP + step, START)
    np.testing.assert_array_equal(joints[:3], START[:3])
    expected = [step[1] / CHAIN.pin_length, -step[0] / CHAIN.pin_length, step[2]]
    np.testing.assert_allclose(joints[3:] - START[3:], expected, rtol=3e-3)


def test_micro_only_keeps_the_nano_stage():
    joints = solve_tip(CHAIN, np.add(START_TIP, [1e-3, -2e-3, 1e-6]), START, StageSplit.MICRO_ONLY)
    np.testing.assert_array_equal(joints[3:], START[3:])
    np.testing.assert_allclose(joints[:3] - START[:3], [1e-3, -2e-3, 1e-6], atol=1e-15)


def test_nano_first_uses_the_whole_nano_range_before_the_tables():
    joints = solve_tip(CHAIN, np.add(START_TIP, [1e-4, 0.0, -1e-4]), START, StageSplit.NANO_FIRST)
    assert joints[4] == CHAIN.lower[4]
    assert joints[5] == CHAIN.lower[5]
    assert joints[1] == START[1]
    assert joints[0] - START[0] == pytest.approx(1e-4 - 40e-3 * START[4], rel=1e-3)
    assert joints[2] - START[2] == pytest.approx(-1e-4 + START[5], rel=1e-3)


def test_only_the_table_of_a_joint_at_its_limit_moves():
    """At tilts of 0.6 rad the joints depend on each other and must be solved together."""
    for axis, step in ((0, [-0.03, 0.005, 0.01]), (1, [0.005, 0.03, 0.01])):
        start = WIDE.centre
        target = compute_tip_position(WIDE, start) + np.array(step)
        table_motion = solve_tip(WIDE, target, start, StageSplit.NANO_FIRST)[:3] - start[:3]
        assert abs(table_motion[axis]) > 1e-3
        np.testing.assert_array_equal(np.delete(table_motion, axis), 0.0)


def test_hybrid_centres_only_joints_that_reach_their_limit():
    start = START.copy()
    start[5] = 60e-6
    joints = solve_tip(CHAIN, np.add(compute_tip_position(CHAIN, start), [2e-6, 0.0, 10e-6]), start)
    assert joints[5] == CHAIN.centre[5]
    np.testing.assert_array_equal(joints[:2], start[:2])
    assert joints[2] - start[2] == pytest.approx(37.5e-6, rel=1e-3)
    assert joints[4] - start[4] == pytest.approx(-50e-6, rel=1e-2)
    assert joints[5] == pytest.approx(CHAIN.centre[5], rel=1e-5)


def test_hybrid_uses_the_nano_stage_if_a_table_is_at_its_limit():
    start = CHAIN.centre.copy()
    start[2] = CHAIN.upper[2]
    target = np.add(compute_tip_position(CHAIN, start), [0.0, 0.0, 32.5e-6])
    start[2] -= 10e-6
    joints = solve_tip(CHAIN, target, start)
    assert joints[5] == CHAIN.upper[5]
    np.testing.assert_allclose(compute_tip_position(CHAIN, joints), target, atol=1e-15)


@given(share=shares, start_share=shares, split=splits)
def test_a_requested_tilt_is_kept(share, start_share, split):
    target, start = compute_core_point(CHAIN, share), compute_joints(CHAIN, start_share)
    tilt = compute_joints(CHAIN, share)[3:5]
    joints = solve_tip(CHAIN, target, start, split, tilt)
    np.testing.assert_array_equal(joints[3:5], tilt)
    np.testing.assert_allclose(compute_tip_position(CHAIN, joints), target, rtol=0, atol=1e-15)


def test_many_targets_at_once_give_the_same_as_single_targets():
    rng = np.random.default_rng(7)
    targets = START_TIP + rng.uniform(-1e-4, 1e-4, (5, 4, 3))
    starts = START + rng.uniform(-1, 1, (4, 6)) * 0.4 * (CHAIN.upper - CHAIN.lower)
    for split in StageSplit:
        together = solve_tip(CHAIN, targets, starts, split)
        for i, j in np.ndindex(5, 4):
            alone = solve_tip(CHAIN, targets[i, j], starts[j], split)
            np.testing.assert_allclose(together[i, j], alone, rtol=0, atol=1e-16)


@pytest.mark.parametrize(
    ("target", "axis", "split"),
    [
        ([0.1, 0.02, 0.0], "x", StageSplit.HYBRID),
        ([0.02, -0.01, 0.0], "y", StageSplit.NANO_FIRST),
        ([0.02, 0.02, 0.06], "z", StageSplit.MICRO_ONLY),
    ],
)
def test_a_target_out_of_reach_is_refused_with_the_axis(target, axis, split):
    with pytest.raises(OutOfLimitsError, match=rf"axis {axis}: position .* is outside"):
        solve_tip(CHAIN, np.array(target), START, split)


def test_a_tilt_out_of_range_is_refused():
    message = "axis thy: position 2 mrad is outside its bounds, 0 mrad to"
    with pytest.raises(OutOfLimitsError, match=message):
        solve_tip(CHAIN, START_TIP, START, tilt=np.array([0.0, 2e-3]))


@pytest.mark.parametrize(
    ("step", "axis"),
    [([0.0, 30e-6, 0.0], "thx"), ([30e-6, 0.0, 0.0], "thy"), ([0.0, 0.0, 0.05], "zn")],
)
def test_solve_nano_refuses_targets_beyond_the_nano_stage(step, axis):
    with pytest.raises(OutOfLimitsError, match=f"axis {axis}"):
        solve_nano(CHAIN, START_TIP + step, START)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_target_that_is_no_number_is_refused(value):
    with pytest.raises(OutOfLimitsError, match="not a finite position"):
        solve_tip(CHAIN, np.array([0.02, value, 0.0]), START)
