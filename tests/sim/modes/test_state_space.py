"""State-space matrices match the equation of motion and the simulated plant."""

import numpy as np
import pytest
from scipy.linalg import expm

from rotemina.sim.errors import StateSpaceError
from rotemina.sim.modes.state_space import (
    OutputQuantity,
    make_perturbation_state_space,
    make_state_space,
)
from rotemina.sim.plant import Perturbation, Plant
from rotemina.sim.robot_files import load_robot, parse_robot

ROBOT = load_robot("rotemina")


def test_the_derivative_satisfies_the_equation_of_motion():
    system = make_state_space(ROBOT)
    assert system.inputs == system.states == tuple(ROBOT.axes)
    rng = np.random.default_rng(0)
    q, v, u = rng.random((3, 6))
    mass = np.diag([40.0, 40.0, 42.0, 2e-5, 2e-5, 0.15])
    mass[2, 5] = mass[5, 2] = 0.15
    mass[3, 4] = mass[4, 3] = 3e-7
    stiffness = np.array([2e7, 2e7, 2e7, 71.061, 71.061, 1.0446e6])
    damping = np.array([8485.0, 8485.0, 8695.0, 2.2619e-3, 2.2619e-3, 19.792])
    gain = np.array([1.0, 1.0, 1.0, 8.9503846e-6, 8.9503846e-6, 5e-7])
    slope = system.a @ np.concatenate([q, v]) + system.b @ u
    np.testing.assert_array_equal(slope[:6], v)
    force = stiffness * gain * u - damping * v - stiffness * q
    np.testing.assert_allclose(mass @ slope[6:], force, rtol=1e-9, atol=1e-6)


def test_the_state_space_moves_like_the_simulated_plant():
    system, plant = make_state_space(ROBOT), Plant.of(ROBOT)
    step_s, zero_position = 1e-4, np.zeros(6)
    command = np.array([1e-3, 2e-3, 3e-3, 1e-4, 2e-4, 3e-5])
    time_s = np.arange(200) * step_s
    motion, _ = plant.advance(
        plant.find_rest_state(0.0, zero_position), time_s, np.tile(command, (200, 1))
    )
    inputs = plant.compute_open_loop_inputs(command)
    steady_state = -np.linalg.solve(system.a, system.b @ inputs)
    state = steady_state - expm(system.a * time_s[-1]) @ steady_state
    np.testing.assert_allclose(system.c @ state, motion.position[-1], rtol=1e-8)
    velocity_system = make_state_space(ROBOT, OutputQuantity.VELOCITY)
    np.testing.assert_allclose(
        velocity_system.c @ state, motion.velocity[-1], rtol=1e-6, atol=1e-12
    )


def test_velocity_and_acceleration_are_derivatives_of_position():
    frequency = np.array([10.0, 297.0, 900.0])
    rate = 2j * np.pi * frequency[:, None, None]
    position = make_state_space(ROBOT).response(frequency)
    velocity = make_state_space(ROBOT, OutputQuantity.VELOCITY).response(frequency)
    acceleration = make_state_space(ROBOT, OutputQuantity.ACCELERATION).response(frequency)
    np.testing.assert_allclose(velocity, rate * position, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(acceleration, rate**2 * position, rtol=1e-7, atol=1e-10)


def test_static_axes_have_only_direct_feedthrough():
    robot = parse_robot(
        "[robot]\nname='two'\naxes=['s','a','p']\n"
        "[axis.s]\nkind='stepper'\nrange=[0,1.0]\nstatic=true\n"
        "[axis.a]\nkind='stepper'\nrange=[0,1.0]\nmass=2.0\ndamping=3.0\nstiffness=800.0\n"
        "[axis.p]\nkind='piezo'\nrange=[0,1.0]\nstatic=true\ngain=0.5\n"
    )
    system = make_state_space(robot)
    assert system.states == ("a",)
    assert system.a.shape == (2, 2)
    np.testing.assert_array_equal(system.b, [[0, 0, 0], [0, 400, 0]])
    np.testing.assert_array_equal(system.d, np.diag([1.0, 0.0, 0.5]))
    assert not make_state_space(robot, OutputQuantity.VELOCITY).d.any()
    only_static = make_state_space(load_robot("picma"))
    assert only_static.a.shape == (0, 0)
    assert only_static.response(np.array(5.0)) == pytest.approx(12.53e-6)


RATE_MATRIX, LEVEL_MATRIX = 1e-3 * np.random.default_rng(1).uniform(-1.0, 1.0, (2, 6, 6))


@pytest.mark.parametrize("output", [OutputQuantity.POSITION, OutputQuantity.VELOCITY])
def test_a_perturbation_moves_the_state_space_like_the_plant(output):
    """Q is held between samples, so the state advances by the matrix exponential."""
    system, plant = (
        make_perturbation_state_space(ROBOT, RATE_MATRIX, LEVEL_MATRIX, output),
        Plant.of(ROBOT),
    )
    step_s, rows = 1e-3, 50
    acceleration = np.random.default_rng(2).normal(size=(rows, 6))
    zero_position, time_s = np.zeros(6), np.arange(rows) * step_s
    motion, _ = plant.advance(
        plant.find_rest_state(0.0, zero_position),
        time_s,
        np.zeros((rows, 6)),
        perturbation=Perturbation(acceleration, RATE_MATRIX, LEVEL_MATRIX),
    )
    exact = motion.position if output is OutputQuantity.POSITION else motion.velocity
    transition = expm(np.block([[system.a, system.b], [np.zeros((6, 18))]]) * step_s)
    state, previous, outputs = np.zeros(12), np.zeros(6), []
    for sample in acceleration:
        outputs.append(system.c @ state + system.d @ previous)
        state, previous = (transition @ np.concatenate([state, sample]))[:12], sample
    scale = np.abs(exact).max(axis=0)
    assert (np.abs(np.array(outputs) - exact).max(axis=0) < 1e-8 * scale).all()


def test_a_perturbation_at_one_frequency_follows_the_equation_of_motion():
    """Solve (−ω²M + iωD + C) q = (iωA + B) Q directly."""
    frequency = 130.0
    rate = 2j * np.pi * frequency
    mass = np.diag([40.0, 40.0, 42.0, 2e-5, 2e-5, 0.15])
    mass[2, 5] = mass[5, 2] = 0.15
    mass[3, 4] = mass[4, 3] = 3e-7
    damping = np.diag([8485.0, 8485.0, 8695.0, 2.2619e-3, 2.2619e-3, 19.792])
    stiffness = np.diag([2e7, 2e7, 2e7, 71.061, 71.061, 1.0446e6])
    dynamic = rate**2 * mass + rate * damping + stiffness
    exact = np.linalg.solve(dynamic, rate * RATE_MATRIX + LEVEL_MATRIX)
    for power, output in enumerate([OutputQuantity.POSITION, OutputQuantity.VELOCITY]):
        response = make_perturbation_state_space(ROBOT, RATE_MATRIX, LEVEL_MATRIX, output).response(
            np.array(frequency)
        )
        np.testing.assert_allclose(response, rate**power * exact, rtol=1e-8)
    exact = rate**2 * np.linalg.solve(dynamic, LEVEL_MATRIX)
    system = make_perturbation_state_space(
        ROBOT, 0.0 * RATE_MATRIX, LEVEL_MATRIX, OutputQuantity.ACCELERATION
    )
    np.testing.assert_allclose(system.response(np.array(frequency)), exact, rtol=1e-8)


def test_perturbations_that_do_not_fit_are_refused():
    with pytest.raises(StateSpaceError, match=r"rate has shape \(5, 6\); it must have \(6, 6\)"):
        make_perturbation_state_space(ROBOT, RATE_MATRIX[:5], LEVEL_MATRIX)
    with pytest.raises(StateSpaceError, match="level has shape"):
        make_perturbation_state_space(ROBOT, RATE_MATRIX, np.full((6, 6), np.nan))
    with pytest.raises(StateSpaceError, match="use velocities"):
        make_perturbation_state_space(ROBOT, RATE_MATRIX, LEVEL_MATRIX, OutputQuantity.ACCELERATION)
