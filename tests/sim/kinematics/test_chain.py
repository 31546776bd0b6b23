"""Which robots have the hybrid chain, and what its joints may be."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.kinematics.chain import JOINTS, Chain, ChainError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

ROBOT = load_robot("rotemina")
CHAIN = Chain.of(ROBOT)


def changed(axis, **values):
    return replace(ROBOT, axes={**ROBOT.axes, axis: replace(ROBOT.axes[axis], **values)})


def test_a_robot_without_the_axes_is_told_which_are_missing():
    with pytest.raises(ChainError, match=r"'EMPS' has no axis x, y, z, thx, thy, zn.* has q"):
        Chain.of(load_robot("emps"))
    fewer = {name: axis for name, axis in ROBOT.axes.items() if name not in ("thy", "zn")}
    with pytest.raises(ChainError, match="has no axis thy, zn"):
        Chain.of(replace(ROBOT, axes=fewer))


@pytest.mark.parametrize(
    ("robot", "message"),
    [
        (replace(ROBOT, pin_length=None), "pin_length missing"),
        (replace(ROBOT, pin_length=60e-6), r"pin_length 60 µm must be greater than .* 65 µm"),
        (changed("thx", unit="m"), "axis thx moves in m; the hybrid chain needs rad"),
        (changed("thy", range=(-1.6, 0.0), voltage_range=None), "axis thy may tilt from -1.6 rad"),
    ],
)
def test_other_misfits_are_named(robot, message):
    with pytest.raises(ChainError, match=message):
        Chain.of(robot)


def test_joints_are_found_by_name_wherever_they_stand():
    order = ["zn", "y", "x", "thy", "thx", "z"]
    extra = {"w": ROBOT.axes["x"], **{name: ROBOT.axes[name] for name in order}}
    chain = Chain.of(replace(ROBOT, axes=extra))
    positions = np.arange(14.0).reshape(2, 7)
    joints = chain.joints_of(positions)
    assert joints[0].tolist() == [1.0 + order.index(name) for name in JOINTS]
    np.testing.assert_array_equal(chain.positions_of(joints, positions), positions)
    back = chain.positions_of(joints + 0.5, positions[0])
    np.testing.assert_array_equal(back[:, 0], 0.0)
    np.testing.assert_array_equal(back[:, 1:], positions[:, 1:] + 0.5)


def test_the_amplifier_cuts_a_range_that_it_does_not_reach():
    chain = Chain.of(changed("zn", voltage_range=(5.0, 100.0)))
    assert chain.lower[5] == pytest.approx(2.5e-6, abs=1e-10)
    assert chain.upper[5] == pytest.approx(50e-6, abs=1e-10)
    negative = Chain.of(changed("zn", voltage_range=(-100.0, -5.0), gain=-5e-7))
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


def test_rounding_at_the_end_of_a_range_is_allowed_and_no_more():
    joints = CHAIN.upper.copy()
    joints[0] += 1e-12
    CHAIN.check(joints)
    joints[0] += 1e-9
    with pytest.raises(OutOfLimitsError, match="axis x"):
        CHAIN.check(joints)
