"""Forward kinematics against the reference positions, and Jacobians against differences."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import (
    axis_jacobian,
    tip_jacobian,
    tip_position,
    tool_axis,
    turned_angle,
)
from rotemina.sim.robot.file import load_robot

CHAIN = Chain.of(load_robot("rotemina"))


def wide_joints(count=40):
    """Joints far beyond the ranges: the equations hold for any tilt."""
    return np.random.default_rng(4).uniform(-1.2, 1.2, (count, 6))


def test_reference_positions(shared_dir):
    rows = np.loadtxt(shared_dir / "reference" / "kinematics.csv", delimiter=",", skiprows=2)
    assert len(rows) > 100
    tip = tip_position(CHAIN, rows[:, :6])
    np.testing.assert_allclose(tip, rows[:, 6:], rtol=1e-12, atol=1e-16)


def test_the_chain_is_the_product_of_its_rotations():
    joints = wide_joints()
    for row in joints:
        turn = Rotation.from_euler("y", row[4]) * Rotation.from_euler("x", row[3])
        tip = row[:3] + turn.apply([0.0, 0.0, row[5] - CHAIN.pin_length])
        np.testing.assert_allclose(tip_position(CHAIN, row), tip, atol=1e-15)
        np.testing.assert_allclose(tool_axis(row), turn.apply([0.0, 0.0, 1.0]), atol=1e-15)


def test_any_leading_shape_is_one_row_after_another():
    joints = wide_joints(24)
    np.testing.assert_array_equal(
        tip_position(CHAIN, joints.reshape(2, 3, 4, 6)).reshape(24, 3),
        [tip_position(CHAIN, row) for row in joints],
    )
    assert tip_jacobian(CHAIN, joints.reshape(2, 3, 4, 6)).shape == (2, 3, 4, 3, 6)


@pytest.mark.parametrize(
    ("function", "jacobian"),
    [
        (lambda q: tip_position(CHAIN, q), lambda q: tip_jacobian(CHAIN, q)),
        (tool_axis, axis_jacobian),
    ],
)
def test_jacobians_are_exact_by_complex_step(function, jacobian):
    joints, step = wide_joints(), 1e-30
    for column in range(6):
        moved = joints.astype(complex)
        moved[:, column] += 1j * step
        slope = function(moved).imag / step
        np.testing.assert_allclose(jacobian(joints)[..., column], slope, rtol=1e-13, atol=1e-15)


def test_central_differences_approach_the_jacobian_with_order_two():
    joints = wide_joints()
    errors = []
    for step in (1e-2, 5e-3):
        nudges = step * np.eye(6)
        ahead, behind = (
            tip_position(CHAIN, joints[:, None] + sign * nudges) for sign in (1.0, -1.0)
        )
        slope = np.swapaxes((ahead - behind) / (2 * step), -1, -2)
        errors.append(np.abs(slope - tip_jacobian(CHAIN, joints)).max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.01)


def test_a_milliradian_is_forty_micrometres():
    rest, tilted = np.zeros(6), np.zeros(6)
    tilted[3] = 1e-3
    moved = tip_position(CHAIN, tilted) - tip_position(CHAIN, rest)
    assert moved[1] == pytest.approx(CHAIN.pin_length * np.sin(1e-3), rel=1e-12)
    assert moved[1] == pytest.approx(40e-6, rel=1e-6)


def test_signs_of_the_axes():
    rest = CHAIN.centre
    signs = np.sign(np.round(tip_jacobian(CHAIN, rest), 3))
    assert signs[1, 3] == 1.0  # thx > 0 swings the tip to +y
    assert signs[0, 4] == -1.0  # thy > 0 swings it to −x
    assert signs[2, 5] == 1.0  # zn > 0 lifts it


def test_turned_angle_is_exact_when_small():
    first, second = np.zeros(6), np.zeros(6)
    second[4] = 1e-9
    assert turned_angle(first, second) == pytest.approx(1e-9, rel=1e-12)
    second[3:5] = 0.3, 0.4
    assert turned_angle(first, second) == pytest.approx(np.arccos(np.cos(0.3) * np.cos(0.4)))
