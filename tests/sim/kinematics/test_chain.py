"""The robots that have the hybrid chain, and the limits of its joints."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import ChainError, OutOfLimitsError
from rotemina.sim.kinematics import JOINTS, KinematicChain
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
CHAIN = KinematicChain.of(ROBOT)


def replace_axis(axis, **values):
    return replace(ROBOT, axes={**ROBOT.axes, axis: replace(ROBOT.axes[axis], **values)})


def test_a_robot_with_missing_axes_is_refused():
    with pytest.raises(ChainError, match=r"'EMPS' has no axis x, y, z, thx, thy, zn.* has q"):
        KinematicChain.of(load_robot("emps"))
    remaining = {name: axis for name, axis in ROBOT.axes.items() if name not in ("thy", "zn")}
    with pytest.raises(ChainError, match="has no axis thy, zn"):
        KinematicChain.of(replace(ROBOT, axes=remaining))


@pytest.mark.parametrize(
    ("robot", "message"),
    [
        (replace(ROBOT, pin_length=None), "pin_length missing"),
        (replace(ROBOT, pin_length=60e-6), r"pin_length 60 µm must be greater than .* 65 µm"),
        (replace_axis("thx", unit="m"), "axis thx moves in m; the hybrid chain needs rad"),
        (
            replace_axis("thy", range=(-1.6, 0.0), voltage_range=None),
            "axis thy may tilt from -1.6 rad",
        ),
    ],
)
def test_axes_that_do_not_fit_are_refused(robot, message):
    with pytest.raises(ChainError, match=message):
        KinematicChain.of(robot)


def test_joints_are_found_by_name_in_any_order():
    order = ["zn", "y", "x", "thy", "thx", "z"]
    axes = {"w": ROBOT.axes["x"], **{name: ROBOT.axes[name] for name in order}}
    chain = KinematicChain.of(replace(ROBOT, axes=axes))
    positions = np.arange(14.0).reshape(2, 7)
    joints = chain.select_joints(positions)
    assert joints[0].tolist() == [1.0 + order.index(name) for name in JOINTS]
    np.testing.assert_array_equal(chain.select_positions(joints, positions), positions)
    restored = chain.select_positions(joints + 0.5, positions[0])
    np.testing.assert_array_equal(restored[:, 0], 0.0)
    np.testing.assert_array_equal(restored[:, 1:], positions[:, 1:] + 0.5)


def test_the_voltage_range_limits_the_joint_range():
    chain = KinematicChain.of(replace_axis("zn", voltage_range=(5.0, 100.0)))
    assert chain.lower[5] == pytest.approx(2.5e-6, abs=1e-10)
    assert chain.upper[5] == pytest.approx(50e-6, abs=1e-10)
    negative = KinematicChain.of(replace_axis("zn", voltage_range=(-100.0, -5.0), gain=-5e-7))
    np.testing.assert_allclose(negative.lower, chain.lower, atol=1e-15)


def test_refusals_name_axis_value_bounds_and_row():
    joints = np.tile(CHAIN.centre, (3, 1))
    assert CHAIN.check(joints) is joints
    joints[1, 3] = -2e-4
    with pytest.raises(OutOfLimitsError, match=r"axis thx: position -0.2 mrad at row 1 is outs"):
        CHAIN.check(joints)
    joints[2, 2] = 0.5
    with pytest.raises(OutOfLimitsError, match=r"axis z: .*500 mm at row 2 .* 0 mm to 80 mm"):
        CHAIN.check(joints)
    joints[0, 1] = np.nan
    with pytest.raises(OutOfLimitsError, match=r"axis y: position nan"):
        CHAIN.check(joints)


def test_rounding_errors_at_the_end_of_a_range_are_allowed():
    joints = CHAIN.upper.copy()
    joints[0] += 1e-12
    CHAIN.check(joints)
    joints[0] += 1e-9
    with pytest.raises(OutOfLimitsError, match="axis x"):
        CHAIN.check(joints)
