"""The reach of the tip, from samples and from its corners."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.inverse import Split, solve_tip
from rotemina.sim.kinematics.workspace import Workspace, nano_grid, nano_outline
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.limits import OutOfLimitsError

CHAIN = Chain.of(load_robot("rotemina"))
SPACE = Workspace.of(CHAIN)


def random_joints(count, seed=1, ends=True):
    """Joints anywhere, each at one of its ends half of the time."""
    rng = np.random.default_rng(seed)
    share = rng.random((count, 6))
    if ends:
        share = np.where(rng.random((count, 6)) < 0.5, np.round(share), share)
    return CHAIN.lower + share * (CHAIN.upper - CHAIN.lower)


def test_the_cylinder_of_the_paper_lies_inside_with_room():
    """Diameter 50 mm, height 50 mm: every point of its skin, at the worst nano poses."""
    assert SPACE.cylinder_margin(0.050, 0.050) == pytest.approx(2.4767e-3, rel=1e-4)
    angle, height = np.meshgrid(np.linspace(0, 2 * np.pi, 73), np.linspace(-0.025, 0.025, 11))
    skin = np.stack([0.025 * np.cos(angle), 0.025 * np.sin(angle), height], axis=-1)
    skin += 0.5 * (SPACE.core.low + SPACE.core.high)
    for nano in (CHAIN.lower, CHAIN.centre, CHAIN.upper):
        start = np.concatenate([CHAIN.centre[:3], nano[3:]])
        joints = solve_tip(CHAIN, skin, start, Split.MICRO_ONLY)
        np.testing.assert_allclose(tip_position(CHAIN, joints), skin, atol=1e-15)


def test_a_cylinder_that_is_too_large_is_not_inside():
    assert SPACE.cylinder_margin(0.056, 0.050) < 0.0
    assert SPACE.cylinder_margin(0.050, 0.081) < 0.0


def test_every_tip_lies_in_the_hull_and_touches_it():
    tips = tip_position(CHAIN, random_joints(40_000))
    assert (tips >= SPACE.hull.low - 1e-15).all()
    assert (tips <= SPACE.hull.high + 1e-15).all()
    np.testing.assert_allclose(tips.min(axis=0), SPACE.hull.low, atol=1e-12)
    np.testing.assert_allclose(tips.max(axis=0), SPACE.hull.high, atol=1e-12)


def test_the_margin_errs_to_the_safe_side_by_less_than_the_blur():
    tips = tip_position(CHAIN, random_joints(40_000))
    margin = SPACE.margin(tips)
    assert margin.min() >= -SPACE.blur
    assert SPACE.blur < 0.08e-6
    beyond = tips.copy()
    beyond[:, 0] = SPACE.hull.high[0] + 1e-9
    assert (SPACE.margin(beyond) < 0).all()


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
        assert not SPACE.reachable(tip)
        with pytest.raises(OutOfLimitsError):
            solve_tip(CHAIN, tip, start)


def test_the_margin_is_the_length_of_the_last_step_that_still_goes():
    tip = np.add(tip_position(CHAIN, CHAIN.centre), [0.02, -0.01, 0.003])
    margin = float(SPACE.margin(tip))
    corners = np.stack(np.meshgrid(*[[-1.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    assert SPACE.reachable(tip + margin * corners).all()
    assert not SPACE.reachable(tip + (margin + SPACE.blur + 1e-9) * np.array([1.0, 0, 0]))


def test_the_nano_stage_s_own_reach():
    joints = CHAIN.centre
    box, grid = SPACE.nano_box(joints), nano_grid(CHAIN, joints, 9)
    assert grid.shape == (9, 9, 9, 3)
    np.testing.assert_allclose(grid.min(axis=(0, 1, 2)), box.low, atol=1e-15)
    np.testing.assert_allclose(grid.max(axis=(0, 1, 2)), box.high, atol=1e-15)
    # 1.16355 mrad at 40 mm, and 65 µm with what tilting lifts.
    np.testing.assert_allclose(box.high - box.low, [46.54e-6, 46.54e-6, 65.05e-6], rtol=1e-3)


def test_the_outline_is_closed_and_encloses_what_tilt_reaches():
    outline = nano_outline(CHAIN, CHAIN.centre, 4)
    assert outline.shape == (17, 3)
    np.testing.assert_array_equal(outline[0], outline[-1])
    assert np.ptp(outline[:, 0]) == pytest.approx(46.5e-6, rel=2e-3)
    assert np.ptp(outline[:, 1]) == pytest.approx(46.5e-6, rel=2e-3)
    assert np.ptp(outline[:, 2]) < 0.1e-6
