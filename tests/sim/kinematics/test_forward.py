"""Forward kinematics match the reference positions, and Jacobians match differences."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rotemina.sim.kinematics import (
    KinematicChain,
    angle_between_tool_axes,
    compute_tip_jacobian,
    compute_tip_position,
    compute_tool_axis,
)
from rotemina.sim.kinematics.forward import axis_jacobian
from rotemina.sim.robot_files import load_robot

CHAIN = KinematicChain.of(load_robot("rotemina"))


def make_wide_joints(count=40):
    """Return joints far beyond the ranges, because the equations are exact for any tilt."""
    return np.random.default_rng(4).uniform(-1.2, 1.2, (count, 6))


def test_tips_match_the_reference_positions(shared_dir):
    rows = np.loadtxt(shared_dir / "reference" / "kinematics.csv", delimiter=",", skiprows=2)
    assert len(rows) > 100
    tip = compute_tip_position(CHAIN, rows[:, :6])
    np.testing.assert_allclose(tip, rows[:, 6:], rtol=1e-12, atol=1e-16)


def test_the_chain_is_the_product_of_its_rotations():
    joints = make_wide_joints()
    for row in joints:
        rotation = Rotation.from_euler("y", row[4]) * Rotation.from_euler("x", row[3])
        tip = row[:3] + rotation.apply([0.0, 0.0, row[5] - CHAIN.pin_length])
        np.testing.assert_allclose(compute_tip_position(CHAIN, row), tip, atol=1e-15)
        np.testing.assert_allclose(
            compute_tool_axis(row), rotation.apply([0.0, 0.0, 1.0]), atol=1e-15
        )


def test_any_leading_shape_gives_the_same_as_single_rows():
    joints = make_wide_joints(24)
    np.testing.assert_array_equal(
        compute_tip_position(CHAIN, joints.reshape(2, 3, 4, 6)).reshape(24, 3),
        [compute_tip_position(CHAIN, row) for row in joints],
    )
    assert compute_tip_jacobian(CHAIN, joints.reshape(2, 3, 4, 6)).shape == (2, 3, 4, 3, 6)


@pytest.mark.parametrize(
    ("function", "jacobian"),
    [
        (lambda q: compute_tip_position(CHAIN, q), lambda q: compute_tip_jacobian(CHAIN, q)),
        (compute_tool_axis, axis_jacobian),
    ],
)
def test_jacobians_are_exact_by_complex_step(function, jacobian):
    joints, step = make_wide_joints(), 1e-30
    for column in range(6):
        shifted = joints.astype(complex)
        shifted[:, column] += 1j * step
        slope = function(shifted).imag / step
        np.testing.assert_allclose(jacobian(joints)[..., column], slope, rtol=1e-13, atol=1e-15)


def test_signs_of_the_axes():
    rest = CHAIN.centre
    signs = np.sign(np.round(compute_tip_jacobian(CHAIN, rest), 3))
    assert signs[1, 3] == 1.0  # thx > 0 swings the tip to +y
    assert signs[0, 4] == -1.0  # thy > 0 swings the tip to −x
    assert signs[2, 5] == 1.0  # zn > 0 lifts the tip


def test_small_angles_between_tool_axes_are_exact():
    first, second = np.zeros(6), np.zeros(6)
    second[4] = 1e-9
    assert angle_between_tool_axes(first, second) == pytest.approx(1e-9, rel=1e-12)
    second[3:5] = 0.3, 0.4
    assert angle_between_tool_axes(first, second) == pytest.approx(
        np.arccos(np.cos(0.3) * np.cos(0.4))
    )
