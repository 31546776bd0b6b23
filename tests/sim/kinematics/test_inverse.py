"""Inverse kinematics: round trips, the split between stages, refusals."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.inverse import (
    Split,
    solve_nano,
    solve_tip,
)
from rotemina.sim.kinematics.workspace import Workspace
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError, check_target

ROBOT = load_robot("rotemina")
CHAIN = Chain.of(ROBOT)
START = CHAIN.centre
HERE = tip_position(CHAIN, START)


def wide_chain(tilt=0.6):
    """A chain whose tilts are so large that nothing is nearly linear."""
    axes = dict(ROBOT.axes)
    for name in ("thx", "thy"):
        axes[name] = replace(axes[name], range=(-tilt, tilt), voltage_range=None)
    axes["zn"] = replace(axes["zn"], range=(0.0, 0.01), voltage_range=None)
    return Chain.of(replace(ROBOT, axes=axes))


WIDE = wide_chain()
shares = st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6).map(np.array)
splits = st.sampled_from(Split)


def joints_at(chain, share):
    return chain.lower + share * (chain.upper - chain.lower)


def in_core(chain, share):
    core = Workspace.of(chain).core
    return core.low + share[:3] * (core.high - core.low)


@given(share=shares, begin=shares, split=splits, wide=st.booleans())
def test_round_trip_over_the_workspace(share, begin, split, wide):
    chain = WIDE if wide else CHAIN
    target, start = in_core(chain, share), joints_at(chain, begin)
    joints = solve_tip(chain, target, start, split)
    np.testing.assert_allclose(tip_position(chain, joints), target, rtol=0, atol=1e-15)
    assert chain.inside(joints)


@given(share=shares)
def test_solutions_pass_the_limits_of_every_other_command(share):
    joints = solve_tip(CHAIN, in_core(CHAIN, share), START)
    for name, position in zip(JOINTS, joints, strict=True):
        check_target(ROBOT, name, float(position))


@given(share=shares, other=shares, wide=st.booleans())
def test_the_nano_stage_alone_is_recovered(share, other, wide):
    """Two nano poses over the same tables: the tip tells the joints, and no table moves."""
    chain = WIDE if wide else CHAIN
    joints, start = joints_at(chain, share), joints_at(chain, other)
    start[:3] = joints[:3]
    target = tip_position(chain, joints)
    length = chain.pin_length - joints[5]
    for solved in (
        solve_nano(chain, target, start),
        solve_tip(chain, target, start, Split.NANO_FIRST),
        solve_tip(chain, target, start, Split.HYBRID),
    ):
        np.testing.assert_array_equal(solved[:3], start[:3])
        np.testing.assert_allclose(solved, joints, rtol=0, atol=1e-16 / length + 1e-15)


def test_a_small_step_is_the_nano_stage_s_and_costs_tilt():
    step = np.array([1e-6, 2e-6, 3e-6])
    joints = solve_tip(CHAIN, HERE + step, START)
    np.testing.assert_array_equal(joints[:3], START[:3])
    expected = [step[1] / CHAIN.pin_length, -step[0] / CHAIN.pin_length, step[2]]
    np.testing.assert_allclose(joints[3:] - START[3:], expected, rtol=3e-3)


def test_micro_only_keeps_the_nano_stage():
    joints = solve_tip(CHAIN, np.add(HERE, [1e-3, -2e-3, 1e-6]), START, Split.MICRO_ONLY)
    np.testing.assert_array_equal(joints[3:], START[3:])
    np.testing.assert_allclose(joints[:3] - START[:3], [1e-3, -2e-3, 1e-6], atol=1e-15)


def test_nano_first_uses_all_of_the_nano_stage_before_the_tables():
    joints = solve_tip(CHAIN, np.add(HERE, [1e-4, 0.0, -1e-4]), START, Split.NANO_FIRST)
    assert joints[4] == CHAIN.lower[4]
    assert joints[5] == CHAIN.lower[5]
    assert joints[1] == START[1]
    assert joints[0] - START[0] == pytest.approx(1e-4 - 40e-3 * START[4], rel=1e-3)
    assert joints[2] - START[2] == pytest.approx(-1e-4 + START[5], rel=1e-3)


def test_only_the_table_of_the_joint_that_ends_has_to_move():
    """At tilts of 0.6 rad the joints depend on one another: they must be found together."""
    for axis, step in ((0, [-0.03, 0.005, 0.01]), (1, [0.005, 0.03, 0.01])):
        start = WIDE.centre
        target = tip_position(WIDE, start) + np.array(step)
        moved = solve_tip(WIDE, target, start, Split.NANO_FIRST)[:3] - start[:3]
        assert abs(moved[axis]) > 1e-3
        np.testing.assert_array_equal(np.delete(moved, axis), 0.0)


def test_hybrid_centres_only_what_overflows():
    start = START.copy()
    start[5] = 60e-6
    joints = solve_tip(CHAIN, np.add(tip_position(CHAIN, start), [2e-6, 0.0, 10e-6]), start)
    assert joints[5] == CHAIN.centre[5]
    np.testing.assert_array_equal(joints[:2], start[:2])
    assert joints[2] - start[2] == pytest.approx(37.5e-6, rel=1e-3)
    assert joints[4] - start[4] == pytest.approx(-50e-6, rel=1e-2)
    assert joints[5] == pytest.approx(CHAIN.centre[5], rel=1e-5)


def test_hybrid_falls_back_where_a_table_cannot_make_room():
    start = CHAIN.centre.copy()
    start[2] = CHAIN.upper[2]
    target = np.add(tip_position(CHAIN, start), [0.0, 0.0, 32.5e-6])
    start[2] -= 10e-6
    joints = solve_tip(CHAIN, target, start)
    assert joints[5] == CHAIN.upper[5]
    np.testing.assert_allclose(tip_position(CHAIN, joints), target, atol=1e-15)


@given(share=shares, begin=shares, split=splits)
def test_a_tilt_that_is_asked_for_is_kept(share, begin, split):
    target, start = in_core(CHAIN, share), joints_at(CHAIN, begin)
    tilt = joints_at(CHAIN, share)[3:5]
    joints = solve_tip(CHAIN, target, start, split, tilt)
    np.testing.assert_array_equal(joints[3:5], tilt)
    np.testing.assert_allclose(tip_position(CHAIN, joints), target, rtol=0, atol=1e-15)


def test_many_targets_at_once_are_each_by_itself():
    rng = np.random.default_rng(7)
    targets = HERE + rng.uniform(-1e-4, 1e-4, (5, 4, 3))
    starts = START + rng.uniform(-1, 1, (4, 6)) * 0.4 * (CHAIN.upper - CHAIN.lower)
    for split in Split:
        together = solve_tip(CHAIN, targets, starts, split)
        for i, j in np.ndindex(5, 4):
            alone = solve_tip(CHAIN, targets[i, j], starts[j], split)
            np.testing.assert_allclose(together[i, j], alone, rtol=0, atol=1e-16)


@pytest.mark.parametrize("split", Split)
@pytest.mark.parametrize(
    ("target", "axis"),
    [([0.1, 0.02, 0.0], "x"), ([0.02, -0.01, 0.0], "y"), ([0.02, 0.02, 0.06], "z")],
)
def test_out_of_reach_names_the_axis(split, target, axis):
    with pytest.raises(OutOfLimitsError, match=rf"axis {axis}: position .* is outside"):
        solve_tip(CHAIN, np.array(target), START, split)


def test_a_tilt_out_of_range_is_refused():
    told = "axis thy: position 2 mrad is outside its bounds, 0 mrad to"
    with pytest.raises(OutOfLimitsError, match=told):
        solve_tip(CHAIN, HERE, START, tilt=np.array([0.0, 2e-3]))


@pytest.mark.parametrize(
    ("step", "axis"),
    [([0.0, 30e-6, 0.0], "thx"), ([30e-6, 0.0, 0.0], "thy"), ([0.0, 0.0, 0.05], "zn")],
)
def test_the_nano_stage_alone_refuses_what_it_does_not_reach(step, axis):
    with pytest.raises(OutOfLimitsError, match=f"axis {axis}"):
        solve_nano(CHAIN, HERE + step, START)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_target_that_is_no_number_is_refused(bad):
    with pytest.raises(OutOfLimitsError, match="not a finite position"):
        solve_tip(CHAIN, np.array([0.02, bad, 0.0]), START)
