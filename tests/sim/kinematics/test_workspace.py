"""The reach of the tip, from samples and from its corners."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.inverse import Split, solve_tip
from rotemina.sim.kinematics.workspace import Workspace
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

ROBOT = load_robot("rotemina")
CHAIN = Chain.of(ROBOT)
SPACE = Workspace.of(CHAIN)


def random_joints(count, chain=CHAIN):
    """Joints anywhere, each at one of its ends half of the time."""
    rng = np.random.default_rng(1)
    share = rng.random((count, 6))
    share = np.where(rng.random((count, 6)) < 0.5, np.round(share), share)
    return chain.lower + share * (chain.upper - chain.lower)


def chain_with(**ranges):
    axes = dict(ROBOT.axes)
    for name, ends in ranges.items():
        axes[name] = replace(axes[name], range=ends, voltage_range=None)
    return Chain.of(replace(ROBOT, axes=axes))


def cylinder_margin(diameter, height):
    """How much room an upright cylinder has on each side in the core."""
    return 0.5 * (SPACE.core.high - SPACE.core.low - [diameter, diameter, height]).min()


def reachable(tip):
    return SPACE.margin(tip) >= -CHAIN.slack[:3].min()


def test_the_cylinder_of_the_paper_lies_inside_with_room():
    """Diameter 50 mm, height 50 mm: every point of its skin, at the worst nano poses."""
    assert cylinder_margin(0.050, 0.050) == pytest.approx(2.4767e-3, rel=1e-4)
    angle, height = np.meshgrid(np.linspace(0, 2 * np.pi, 73), np.linspace(-0.025, 0.025, 11))
    skin = np.stack([0.025 * np.cos(angle), 0.025 * np.sin(angle), height], axis=-1)
    skin += 0.5 * (SPACE.core.low + SPACE.core.high)
    for nano in (CHAIN.lower, CHAIN.centre, CHAIN.upper):
        start = np.concatenate([CHAIN.centre[:3], nano[3:]])
        joints = solve_tip(CHAIN, skin, start, Split.MICRO_ONLY)
        np.testing.assert_allclose(tip_position(CHAIN, joints), skin, atol=1e-15)


def test_a_cylinder_that_is_too_large_is_not_inside():
    assert cylinder_margin(0.056, 0.050) < 0.0
    assert cylinder_margin(0.050, 0.081) < 0.0


@pytest.mark.parametrize(
    "chain", [CHAIN, chain_with(thx=(-0.5, 0.3), thy=(-0.2, 0.6)), chain_with(thx=(0.2, 0.5))]
)
def test_every_tip_lies_in_the_hull_and_some_touch_it(chain):
    joints = random_joints(40_000, chain)
    level = np.clip(0.0, chain.lower[3:5], chain.upper[3:5])
    joints[::2, 3:5] = np.where(np.arange(20_000)[:, None] % 3 == 0, level, joints[::2, 3:5])
    joints[1::4, 3] = level[0]
    tips, hull = tip_position(chain, joints), Workspace.of(chain).hull
    np.testing.assert_allclose(tips.min(axis=0), hull.low, rtol=0, atol=1e-15)
    np.testing.assert_allclose(tips.max(axis=0), hull.high, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    "chain",
    [CHAIN, chain_with(zn=(0.0, 1e-9)), chain_with(thy=(0.0, 1e-9)), chain_with(thx=(0.0, 1e-9))],
)
def test_the_margin_errs_to_the_safe_side_by_the_blur_and_no_more(chain):
    space, tips = Workspace.of(chain), tip_position(chain, random_joints(40_000, chain))
    worst = float(space.margin(tips).min())
    assert -space.blur - 1e-15 <= worst < -0.9 * space.blur
    beyond = tips.copy()
    beyond[:, 0] = space.hull.high[0] + 1e-9
    assert (space.margin(beyond) < 0).all()


def test_the_blur_is_below_a_tenth_of_a_micrometre():
    assert SPACE.blur == pytest.approx(75.7e-9, rel=1e-3)


@given(
    share=st.lists(st.floats(-0.2, 1.2), min_size=3, max_size=3).map(np.array),
    begin=st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6).map(np.array),
)
def test_reachable_means_solvable(share, begin):
    tip = SPACE.hull.low + share * (SPACE.hull.high - SPACE.hull.low)
    start = CHAIN.lower + begin * (CHAIN.upper - CHAIN.lower)
    if SPACE.margin(tip) > SPACE.blur:
        solve_tip(CHAIN, tip, start)
        solve_tip(CHAIN, tip, start, Split.NANO_FIRST)
    elif SPACE.margin(tip) < -SPACE.blur:
        assert not reachable(tip)
        with pytest.raises(OutOfLimitsError):
            solve_tip(CHAIN, tip, start)


def test_the_margin_is_the_length_of_the_last_step_that_still_goes():
    tip = np.add(tip_position(CHAIN, CHAIN.centre), [0.02, -0.01, 0.003])
    margin = float(SPACE.margin(tip))
    corners = np.stack(np.meshgrid(*[[-1.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    assert reachable(tip + margin * corners).all()
    assert not reachable(tip + (margin + SPACE.blur + 1e-9) * np.array([1.0, 0, 0]))
