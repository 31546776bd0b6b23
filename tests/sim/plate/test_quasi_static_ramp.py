"""Pin and seat: the beam, the limit surface of the friction, and ramps."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import PlateError
from rotemina.sim.plate import make_ramp_path, move_bottom, pin_length
from rotemina.sim.plate.pin import pin_compliance, pin_stress
from rotemina.sim.plate.seat_friction import friction_limits, friction_utilization, solve_seat_force
from rotemina.sim.robot import PinJoint, PlatePin
from rotemina.sim.robot_files import load_robot

LENGTH = 0.04
PIN = PlatePin()
JOINT = PinJoint()
STIFFNESS = np.diag([1.0e6, 40.0, 40.0])
COUPLED = STIFFNESS + np.array([[0.0, 900.0, 0.0], [900.0, 0.0, 3.0], [0.0, 3.0, 0.0]])


def test_the_pin_is_a_cantilever():
    compliance = pin_compliance(PIN, LENGTH)
    inertia = np.pi / 64.0 * PIN.diameter**4
    area = np.pi / 4.0 * PIN.diameter**2
    # A side force F at the bottom deflects it by F L³ / (3 E I), here given as angle over moment.
    bending = LENGTH / (3.0 * PIN.youngs_modulus * inertia)
    assert compliance[1, 1] == pytest.approx(bending, rel=0.01)
    assert compliance[1, 1] > bending  # shear adds to it
    assert compliance[0, 0] == pytest.approx(LENGTH / (PIN.youngs_modulus * area))
    assert pin_stress(PIN, np.array([0.0, 0.3, 0.4])) == pytest.approx(
        0.5 * PIN.diameter / 2.0 / inertia
    )
    assert pin_stress(PIN, np.array([-7.0, 0.0, 0.0])) == pytest.approx(7.0 / area)


def test_the_seat_sticks_within_its_limits():
    force = 0.99 * friction_limits(JOINT) / np.sqrt(3.0)
    seat_force = solve_seat_force(JOINT, COUPLED, force)
    assert np.array_equal(seat_force.force, force)
    assert not seat_force.slip.any()


@given(
    trial=st.tuples(*[st.floats(-50.0, 50.0)] * 3),
    stiffness=st.sampled_from([STIFFNESS, COUPLED]),
)
def test_slip_ends_on_the_limit_and_dissipates(trial, stiffness):
    force = np.array(trial) * friction_limits(JOINT)
    seat_force = solve_seat_force(JOINT, stiffness, force)
    if friction_utilization(JOINT, force) <= 1.0:
        return
    assert friction_utilization(JOINT, seat_force.force) == pytest.approx(1.0, abs=1e-9)
    assert seat_force.force + stiffness @ seat_force.slip == pytest.approx(
        force, rel=1e-9, abs=1e-9
    )
    assert seat_force.force @ seat_force.slip >= 0.0
    # The slip is normal to the limit surface.
    normal = seat_force.force / friction_limits(JOINT) ** 2
    size = np.linalg.norm(seat_force.slip) * np.linalg.norm(normal)
    assert seat_force.slip @ normal == pytest.approx(size, rel=1e-6)


def test_force_along_the_pin_slips_at_mu_p(solutions):
    distance = 3.0 * friction_limits(JOINT)[0] / solutions.stiffness[0, 0]
    ramp = move_bottom(solutions, LENGTH, make_ramp_path(np.array([distance, 0.0, 0.0])))
    assert ramp.force[-1] == pytest.approx([150.0, 0.0, 0.0], abs=1e-8)
    assert ramp.has_slipped
    assert ramp.utilization.max() == pytest.approx(1.0)


def test_a_ramp_within_the_friction_limits_is_linear_and_reversible(solutions):
    target = np.array([65e-6, 1e-3, -0.5e-3])
    ramp = move_bottom(solutions, LENGTH, make_ramp_path(target, steps=10, back=True))
    assert not ramp.has_slipped
    assert ramp.time_s[[0, -1]] == pytest.approx([0.0, 30.0])
    assert ramp.force[5] == pytest.approx(0.5 * ramp.force[10])
    assert ramp.force[-1] == pytest.approx(np.zeros(3), abs=1e-9)
    # Plate and pin share the motion and carry the same force.
    compliance = np.linalg.inv(solutions.stiffness) + pin_compliance(PIN, LENGTH)
    assert compliance @ ramp.force[10] == pytest.approx(target)
    assert solutions.stiffness @ ramp.hub[10] == pytest.approx(ramp.force[10])


def test_slip_leaves_the_plate_bent_and_dissipates_work(solutions):
    target = np.array([0.0, 0.03, 0.0])
    ramp = move_bottom(solutions, LENGTH, make_ramp_path(target, steps=200, back=True))
    assert ramp.has_slipped
    assert ramp.force[-1, 1] == pytest.approx(-0.3)  # the slip reverses the force
    middle = 0.5 * (ramp.force[1:, 1] + ramp.force[:-1, 1])
    work = float(np.sum(middle * np.diff(ramp.bottom[:, 1])))
    stored = 0.5 * ramp.force[-1] @ (ramp.bottom[-1] - ramp.slip[-1])
    # The work that is not stored is that of friction, the limit moment over all slip.
    slip_distance = np.abs(np.diff(ramp.slip[:, 1])).sum()
    assert work - stored == pytest.approx(0.3 * slip_distance, rel=0.01)


def test_small_and_large_steps_end_alike(solutions):
    target = np.array([2e-4, 0.02, 0.01])
    end_forces = [
        move_bottom(solutions, LENGTH, make_ramp_path(target, steps=n)).force[-1]
        for n in (100, 800)
    ]
    assert end_forces[0] == pytest.approx(end_forces[1], rel=0.02)


@pytest.mark.parametrize(
    "path", [np.zeros((1, 3)), np.zeros((4, 2)), np.array([[0.0] * 3, [np.nan] * 3])]
)
def test_paths_must_be_rows_of_three_numbers(solutions, path):
    with pytest.raises(PlateError, match="three finite numbers"):
        move_bottom(solutions, LENGTH, path)


def test_a_ramp_without_duration_is_refused(solutions):
    with pytest.raises(PlateError, match="duration of the ramp = 0 s: must be positive"):
        move_bottom(solutions, LENGTH, np.zeros((2, 3)), 0.0)


def test_the_length_of_the_pin_defaults_to_that_of_the_robot():
    robot = load_robot("rotemina")
    assert pin_length(robot) == robot.pin_length
    longer = replace(robot.plate, pin=replace(PIN, length=0.05))
    assert pin_length(replace(robot, plate=longer)) == 0.05
    with pytest.raises(PlateError, match=r"plate\.pin\.length: missing"):
        pin_length(replace(robot, pin_length=None))
    block = replace(robot.plate, pin=replace(PIN, length=0.005))
    with pytest.raises(PlateError, match=r"length = 0\.005 m: must be 0\.012 to 0\.6 m"):
        pin_length(replace(robot, plate=block))
