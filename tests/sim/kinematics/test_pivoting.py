"""Moves that keep the tip in place."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.kinematics import KinematicChain, compute_tip_position, recentre
from rotemina.sim.kinematics.pivoting import hold_tip, pivot
from rotemina.sim.robot_files import load_robot

CHAIN = KinematicChain.of(load_robot("rotemina"))
inner_shares = st.lists(st.floats(0.01, 0.99), min_size=6, max_size=6).map(np.array)
nano_shares = st.lists(st.floats(0.0, 1.0), min_size=3, max_size=3).map(np.array)


@given(share=inner_shares, nano_share=nano_shares)
def test_the_tip_stays_in_every_nano_pose(share, nano_share):
    joints = CHAIN.lower + share * (CHAIN.upper - CHAIN.lower)
    nano = CHAIN.lower[3:] + nano_share * (CHAIN.upper - CHAIN.lower)[3:]
    tip = compute_tip_position(CHAIN, joints)
    held = hold_tip(CHAIN, joints, nano)
    np.testing.assert_array_equal(held[3:], nano)
    np.testing.assert_allclose(compute_tip_position(CHAIN, held), tip, rtol=0, atol=1e-15)
    centred = recentre(CHAIN, joints)
    np.testing.assert_array_equal(centred[3:], CHAIN.centre[3:])
    np.testing.assert_allclose(compute_tip_position(CHAIN, centred), tip, rtol=0, atol=1e-15)


def test_a_pivot_turns_by_its_angles():
    turned = pivot(CHAIN, CHAIN.centre, np.array([1e-4, -2e-4]))
    np.testing.assert_allclose(turned[3:] - CHAIN.centre[3:], [1e-4, -2e-4, 0.0], atol=1e-18)
    np.testing.assert_allclose(turned[:2] - CHAIN.centre[:2], [-8e-6, -4e-6], rtol=2e-3)


def test_a_path_of_turns_keeps_the_tip_at_every_row():
    angle = np.linspace(0, 2 * np.pi, 50)
    turns = 3e-4 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    path = pivot(CHAIN, CHAIN.centre, turns)
    assert path.shape == (50, 6)
    deviation = compute_tip_position(CHAIN, path) - compute_tip_position(CHAIN, CHAIN.centre)
    assert np.abs(deviation).max() < 1e-15


def interpolate_held(joints, nano, rows):
    """Return joints (rows, 6) from ``joints`` (6,) to ``nano`` (3,) with the tip held in place."""
    return hold_tip(CHAIN, joints, np.linspace(joints[3:], nano, rows))


def test_the_tip_deviates_between_rows_by_the_square_of_the_turn():
    """The documented bound half-way between two rows is pin_length · turn² / 8."""
    nano = CHAIN.lower[3:].copy()
    path = interpolate_held(CHAIN.centre, nano, 2)
    half_way_deviation = compute_tip_position(CHAIN, path.mean(axis=0)) - compute_tip_position(
        CHAIN, CHAIN.centre
    )
    turn = np.hypot(*CHAIN.centre[3:5])
    bound = CHAIN.pin_length * turn**2 / 8
    # Shortening the pin during the turn adds the product of both.
    assert np.linalg.norm(half_way_deviation) <= bound + turn * CHAIN.centre[5] / 4
    finer = interpolate_held(CHAIN.centre, nano, 11)
    tips_between = compute_tip_position(CHAIN, 0.5 * (finer[1:] + finer[:-1]))
    deviation = np.linalg.norm(tips_between - compute_tip_position(CHAIN, CHAIN.centre), axis=-1)
    assert deviation.max() == pytest.approx(np.linalg.norm(half_way_deviation) / 100, rel=0.02)


def test_a_turn_beyond_the_range_is_refused_with_its_row():
    with pytest.raises(OutOfLimitsError, match=r"axis thx: position 1\.58178 mrad at row 1"):
        pivot(CHAIN, CHAIN.centre, np.array([[0.0, 0.0], [1e-3, 0.0]]))


def test_a_turn_that_needs_a_table_beyond_its_end_is_refused():
    joints = CHAIN.centre.copy()
    joints[0] = CHAIN.upper[0]
    with pytest.raises(OutOfLimitsError, match="axis x: position"):
        pivot(CHAIN, joints, np.array([0.0, 1e-4]))
