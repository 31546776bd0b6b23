"""The reach of the tip, compared with random samples and its corners."""

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
    solve_tip,
)
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
CHAIN = KinematicChain.of(ROBOT)
WORKSPACE = TipWorkspace.of(CHAIN)


def draw_joints(count, chain=CHAIN):
    """Return random joints, each at one of its ends in half of the cases."""
    rng = np.random.default_rng(1)
    share = rng.random((count, 6))
    share = np.where(rng.random((count, 6)) < 0.5, np.round(share), share)
    return chain.lower + share * (chain.upper - chain.lower)


def make_chain(**ranges):
    axes = dict(ROBOT.axes)
    for name, ends in ranges.items():
        axes[name] = replace(axes[name], range=ends, voltage_range=None)
    return KinematicChain.of(replace(ROBOT, axes=axes))


def compute_cylinder_margin(diameter, height):
    """Return the smallest distance of an upright cylinder to the boundary of the core."""
    return 0.5 * (WORKSPACE.core.high - WORKSPACE.core.low - [diameter, diameter, height]).min()


def is_reachable(tip):
    return WORKSPACE.margin_at(tip) >= -CHAIN.slack[:3].min()


def test_the_cylinder_of_the_paper_lies_inside_the_workspace():
    """A cylinder of diameter 50 mm and height 50 mm is reachable at the worst nano poses."""
    assert compute_cylinder_margin(0.050, 0.050) == pytest.approx(2.4767e-3, rel=1e-4)
    assert compute_cylinder_margin(0.056, 0.050) < 0.0
    assert compute_cylinder_margin(0.050, 0.081) < 0.0
    angle, height = np.meshgrid(np.linspace(0, 2 * np.pi, 73), np.linspace(-0.025, 0.025, 11))
    surface = np.stack([0.025 * np.cos(angle), 0.025 * np.sin(angle), height], axis=-1)
    surface += 0.5 * (WORKSPACE.core.low + WORKSPACE.core.high)
    for nano in (CHAIN.lower, CHAIN.centre, CHAIN.upper):
        start = np.concatenate([CHAIN.centre[:3], nano[3:]])
        joints = solve_tip(CHAIN, surface, start, StageSplit.MICRO_ONLY)
        np.testing.assert_allclose(compute_tip_position(CHAIN, joints), surface, atol=1e-15)


@pytest.mark.parametrize(
    "chain", [CHAIN, make_chain(thx=(-0.5, 0.3), thy=(-0.2, 0.6)), make_chain(thx=(0.2, 0.5))]
)
def test_the_hull_is_the_bounding_box_of_all_tips(chain):
    joints = draw_joints(10_000, chain)
    level = np.clip(0.0, chain.lower[3:5], chain.upper[3:5])
    joints[::2, 3:5] = np.where(np.arange(5_000)[:, None] % 3 == 0, level, joints[::2, 3:5])
    joints[1::4, 3] = level[0]
    tips, hull = compute_tip_position(chain, joints), TipWorkspace.of(chain).hull
    np.testing.assert_allclose(tips.min(axis=0), hull.low, rtol=0, atol=1e-15)
    np.testing.assert_allclose(tips.max(axis=0), hull.high, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    "chain",
    [CHAIN, make_chain(zn=(0.0, 1e-9)), make_chain(thy=(0.0, 1e-9)), make_chain(thx=(0.0, 1e-9))],
)
def test_the_margin_is_conservative_by_at_most_its_error(chain):
    workspace, tips = (
        TipWorkspace.of(chain),
        compute_tip_position(chain, draw_joints(10_000, chain)),
    )
    worst = float(workspace.margin_at(tips).min())
    assert -workspace.max_margin_error - 1e-15 <= worst < -0.9 * workspace.max_margin_error
    beyond = tips.copy()
    beyond[:, 0] = workspace.hull.high[0] + 1e-9
    assert (workspace.margin_at(beyond) < 0).all()


def test_the_error_of_the_margin_is_below_a_tenth_of_a_micrometre():
    assert WORKSPACE.max_margin_error == pytest.approx(75.7e-9, rel=1e-3)


@given(
    share=st.lists(st.floats(-0.2, 1.2), min_size=3, max_size=3).map(np.array),
    start_share=st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6).map(np.array),
)
def test_reachable_tips_are_solvable(share, start_share):
    tip = WORKSPACE.hull.low + share * (WORKSPACE.hull.high - WORKSPACE.hull.low)
    start = CHAIN.lower + start_share * (CHAIN.upper - CHAIN.lower)
    if WORKSPACE.margin_at(tip) > WORKSPACE.max_margin_error:
        solve_tip(CHAIN, tip, start)
        solve_tip(CHAIN, tip, start, StageSplit.NANO_FIRST)
    elif WORKSPACE.margin_at(tip) < -WORKSPACE.max_margin_error:
        assert not is_reachable(tip)
        with pytest.raises(OutOfLimitsError):
            solve_tip(CHAIN, tip, start)


def test_the_margin_is_the_length_of_the_longest_possible_step():
    tip = np.add(compute_tip_position(CHAIN, CHAIN.centre), [0.02, -0.01, 0.003])
    margin = float(WORKSPACE.margin_at(tip))
    corners = np.stack(np.meshgrid(*[[-1.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    assert is_reachable(tip + margin * corners).all()
    assert not is_reachable(
        tip + (margin + WORKSPACE.max_margin_error + 1e-9) * np.array([1.0, 0, 0])
    )
