"""Pin and seat: the beam, the friction's limit surface, and ramps."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.pin import compliance, pin_length, pin_stress
from rotemina.sim.plate.quasi_static_ramp import move_bottom, ramp_path
from rotemina.sim.plate.seat_friction import limits, seat_force, utilization
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.plate import Joint, Pin

LENGTH = 0.04
PIN = Pin()
JOINT = Joint()
STIFFNESS = np.diag([1.0e6, 40.0, 40.0])
COUPLED = STIFFNESS + np.array([[0.0, 900.0, 0.0], [900.0, 0.0, 3.0], [0.0, 3.0, 0.0]])


def test_pin_is_a_cantilever():
    soft = compliance(PIN, LENGTH)
    inertia = np.pi / 64.0 * PIN.diameter**4
    area = np.pi / 4.0 * PIN.diameter**2
    # A side force F at the bottom bends it by F L³ / (3 E I); as moment F L and angle v / L.
    bending = LENGTH / (3.0 * PIN.youngs_modulus * inertia)
    assert soft[1, 1] == pytest.approx(bending, rel=0.01)
    assert soft[1, 1] > bending  # shear adds to it
    assert soft[0, 0] == pytest.approx(LENGTH / (PIN.youngs_modulus * area))
    assert pin_stress(PIN, np.array([0.0, 0.3, 0.4])) == pytest.approx(
        0.5 * PIN.diameter / 2.0 / inertia
    )
    assert pin_stress(PIN, np.array([-7.0, 0.0, 0.0])) == pytest.approx(7.0 / area)


def test_seat_sticks_within_its_limits():
    force = 0.99 * limits(JOINT) / np.sqrt(3.0)
    carried = seat_force(JOINT, COUPLED, force)
    assert np.array_equal(carried.force, force)
    assert not carried.slip.any()


@given(
    trial=st.tuples(*[st.floats(-50.0, 50.0)] * 3),
    stiffness=st.sampled_from([STIFFNESS, COUPLED]),
)
def test_slip_ends_on_the_limit_and_dissipates(trial, stiffness):
    force = np.array(trial) * limits(JOINT)
    carried = seat_force(JOINT, stiffness, force)
    if utilization(JOINT, force) <= 1.0:
        return
    assert utilization(JOINT, carried.force) == pytest.approx(1.0, abs=1e-9)
    assert carried.force + stiffness @ carried.slip == pytest.approx(force, rel=1e-9, abs=1e-9)
    assert carried.force @ carried.slip >= 0.0
    # Along the limit surface's normal.
    normal = carried.force / limits(JOINT) ** 2
    size = np.linalg.norm(carried.slip) * np.linalg.norm(normal)
    assert carried.slip @ normal == pytest.approx(size, rel=1e-6)


def test_force_along_the_pin_slips_at_mu_p(solutions):
    far = 3.0 * limits(JOINT)[0] / solutions.stiffness[0, 0]
    ramp = move_bottom(solutions, LENGTH, ramp_path(np.array([far, 0.0, 0.0])))
    assert ramp.force[-1] == pytest.approx([150.0, 0.0, 0.0], abs=1e-8)
    assert ramp.slipped
    assert ramp.utilization.max() == pytest.approx(1.0)


def test_ramp_within_the_friction_is_linear_and_comes_back(solutions):
    target = np.array([65e-6, 1e-3, -0.5e-3])
    ramp = move_bottom(solutions, LENGTH, ramp_path(target, steps=10, back=True))
    assert not ramp.slipped
    assert ramp.time_s[[0, -1]] == pytest.approx([0.0, 30.0])
    assert ramp.force[5] == pytest.approx(0.5 * ramp.force[10])
    assert ramp.force[-1] == pytest.approx(np.zeros(3), abs=1e-9)
    # Plate and pin share the motion, both carrying the same force.
    soft = np.linalg.inv(solutions.stiffness) + compliance(PIN, LENGTH)
    assert soft @ ramp.force[10] == pytest.approx(target)
    assert solutions.stiffness @ ramp.hub[10] == pytest.approx(ramp.force[10])


def test_slip_leaves_the_plate_bent_and_costs_work(solutions):
    target = np.array([0.0, 0.03, 0.0])
    ramp = move_bottom(solutions, LENGTH, ramp_path(target, steps=200, back=True))
    assert ramp.slipped
    assert ramp.force[-1, 1] == pytest.approx(-0.3)  # pressed the other way by the slip
    middle = 0.5 * (ramp.force[1:, 1] + ramp.force[:-1, 1])
    work = float(np.sum(middle * np.diff(ramp.bottom[:, 1])))
    stored = 0.5 * ramp.force[-1] @ (ramp.bottom[-1] - ramp.slip[-1])
    # What is not stored went into friction: the limit moment over all the slip.
    slid = np.abs(np.diff(ramp.slip[:, 1])).sum()
    assert work - stored == pytest.approx(0.3 * slid, rel=0.01)


def test_small_steps_and_large_ones_end_alike(solutions):
    target = np.array([2e-4, 0.02, 0.01])
    ends = [
        move_bottom(solutions, LENGTH, ramp_path(target, steps=n)).force[-1] for n in (100, 800)
    ]
    assert ends[0] == pytest.approx(ends[1], rel=0.02)


@pytest.mark.parametrize(
    "path", [np.zeros((1, 3)), np.zeros((4, 2)), np.array([[0.0] * 3, [np.nan] * 3])]
)
def test_paths_must_be_rows_of_three_numbers(solutions, path):
    with pytest.raises(PlateError, match="three finite numbers"):
        move_bottom(solutions, LENGTH, path)


def test_time_must_pass(solutions):
    with pytest.raises(PlateError, match="duration of the ramp = 0 s: must be positive"):
        move_bottom(solutions, LENGTH, np.zeros((2, 3)), 0.0)


def test_pin_s_length_is_the_robot_s_unless_given():
    robot = load_robot("rotemina")
    assert pin_length(robot) == robot.pin_length
    longer = replace(robot.plate, pin=replace(PIN, length=0.05))
    assert pin_length(replace(robot, plate=longer)) == 0.05
    with pytest.raises(PlateError, match=r"plate\.pin\.length: missing"):
        pin_length(replace(robot, pin_length=None))
    block = replace(robot.plate, pin=replace(PIN, length=0.005))
    with pytest.raises(PlateError, match=r"length = 0\.005 m: must be 0\.012 to 0\.6 m"):
        pin_length(replace(robot, plate=block))
