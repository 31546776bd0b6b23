"""The perturbation of Eq. (1), compared with independent solutions."""

import numpy as np
import pytest
from scipy.linalg import expm

from rotemina.sim.errors import PlantError
from rotemina.sim.plant import Perturbation, Plant
from rotemina.sim.robot_files import parse_robot

MASS, DAMPING, STIFFNESS = 2.0, 30.0, 8.0e4  # 31.8 Hz, damping ratio 0.0375

ONE_AXIS_TEXT = f"""
[robot]
name = "one"
axes = ["x"]
[axis.x]
kind = "stepper"
range = [0.0, 0.01]
mass = {MASS}
damping = {DAMPING}
stiffness = {STIFFNESS}
"""

TWO_AXIS_TEXT = (
    ONE_AXIS_TEXT.replace('["x"]', '["x", "tip"]')
    + """
[axis.tip]
kind = "piezo"
unit = "rad"
range = [0.0, 0.001]
gain = 1e-5
mass = 0.5
damping = 3.0
stiffness = 3e4
[[coupling]]
matrix = "M"
axes = ["x", "tip"]
value = 0.4
[[coupling]]
matrix = "D"
axes = ["x", "tip"]
value = -2.0
[[coupling]]
matrix = "C"
axes = ["x", "tip"]
value = 5e3
"""
)
M = np.array([[MASS, 0.4], [0.4, 0.5]])
D = np.array([[DAMPING, -2.0], [-2.0, 3.0]])
C = np.array([[STIFFNESS, 5e3], [5e3, 3e4]])
A = np.array([[0.02, -0.01], [0.003, 0.04]])
B = np.array([[-2.0, 0.1], [0.3, -0.5]])


def simulate_motion(plant, time_s, perturbation, command=None):
    command = np.zeros((len(time_s), len(plant.axes))) if command is None else command
    state = plant.find_rest_state(time_s[0], command[0])
    return plant.advance(state, time_s, command, perturbation=perturbation)[0]


def test_a_change_of_q_is_an_impulse():
    """After q̇ jumps by A/M the axis vibrates freely, and the sample precedes the jump."""
    plant, time_s = Plant.of(parse_robot(ONE_AXIS_TEXT)), np.arange(500) / 700
    motion = simulate_motion(
        plant, time_s, Perturbation(np.ones((500, 1)), [[0.5]], np.zeros((1, 1)))
    )
    decay = DAMPING / (2.0 * MASS)
    damped = np.sqrt(STIFFNESS / MASS - decay**2)
    exact = 0.5 / MASS / damped * np.exp(-decay * time_s) * np.sin(damped * time_s)
    assert motion.position[:, 0] == pytest.approx(exact, abs=1e-10 * exact.max())
    assert motion.velocity[0, 0] == 0.0
    oscillation = np.cos(damped * time_s) - decay / damped * np.sin(damped * time_s)
    speed = 0.5 / MASS * np.exp(-decay * time_s) * oscillation
    assert motion.velocity[1:, 0] == pytest.approx(speed[1:], abs=1e-10 * speed[0])


def solve_by_matrix_exponential(time_s, acceleration, command):
    """Return [q, q̇] of both axes before each sample's impulse, by the matrix exponential."""
    zeros, identity = np.zeros((2, 2)), np.eye(2)
    dynamics = np.block([[zeros, identity], [-np.linalg.solve(M, C), -np.linalg.solve(M, D)]])
    drive_force = command * [STIFFNESS, 3e4]  # E U: stiffness·cmd of a stepper and of a piezo
    rest_state = np.concatenate([np.linalg.solve(C, drive_force[0]), np.zeros(2)])
    rows, state, previous = [], rest_state, np.zeros(2)
    for row, sample in enumerate(acceleration):
        rows.append(state)
        state = state + np.concatenate([np.zeros(2), np.linalg.solve(M, A @ (sample - previous))])
        previous = sample
        if row + 1 < len(time_s):
            input_vector = np.concatenate(
                [np.zeros(2), np.linalg.solve(M, B @ sample + drive_force[row])]
            )
            step = np.block([[dynamics, input_vector[:, None]], [np.zeros((1, 5))]])
            state = (expm(step * (time_s[row + 1] - time_s[row])) @ np.append(state, 1.0))[:4]
    return np.array(rows)


def make_uneven_samples():
    rng = np.random.default_rng(4)
    time_s = np.cumsum(rng.uniform(5e-4, 3e-3, 300))
    return time_s, rng.normal(size=(300, 2)), rng.uniform(0.0, 1e-3, (300, 2))


def test_the_motion_of_coupled_axes_matches_the_matrix_exponential():
    time_s, acceleration, command = make_uneven_samples()
    motion = simulate_motion(
        Plant.of(parse_robot(TWO_AXIS_TEXT)), time_s, Perturbation(acceleration, A, B), command
    )
    exact = solve_by_matrix_exponential(time_s, acceleration, command)
    assert np.abs(motion.position - exact[:, :2]).max() < 1e-9 * np.abs(exact[:, :2]).max()
    assert np.abs(motion.velocity - exact[:, 2:]).max() < 1e-9 * np.abs(exact[:, 2:]).max()


def test_impulses_of_a_ramp_converge_to_the_force_of_its_slope():
    """Q = r t has the force A r. Because Q is held between samples, the error has order 1."""
    plant, errors = Plant.of(parse_robot(ONE_AXIS_TEXT)), []
    for rate_hz in (500, 1000, 2000):
        time_s = np.arange(rate_hz // 10 + 1) / rate_hz
        ramp = 7.0 * time_s[:, None]
        motion = simulate_motion(plant, time_s, Perturbation(ramp, [[0.5]], np.zeros((1, 1))))
        decay = DAMPING / (2.0 * MASS)
        damped = np.sqrt(STIFFNESS / MASS - decay**2)
        oscillation = np.cos(damped * time_s) + decay / damped * np.sin(damped * time_s)
        exact = 3.5 / STIFFNESS * (1.0 - np.exp(-decay * time_s) * oscillation)
        errors.append(np.abs(motion.position[:, 0] - exact).max() / exact.max())
    assert errors[0] < 0.2
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(2.0, rel=0.1)


def test_static_axes_do_not_respond():
    static = ONE_AXIS_TEXT[: ONE_AXIS_TEXT.index("mass")] + "static = true"
    motion = simulate_motion(
        Plant.of(parse_robot(static)),
        np.arange(5) / 1000,
        Perturbation(np.ones((5, 1)), [[1.0]], [[1.0]]),
        np.full((5, 1), 0.002),
    )
    assert motion.position[:, 0].tolist() == [0.002] * 5


ROWS = np.ones((5, 2))


@pytest.mark.parametrize(
    ("acceleration", "a", "b", "message"),
    [
        (np.ones(5), A, B, r"acceleration has shape \(5,\); give it a row for each sample"),
        (ROWS, np.ones((2, 3)), B, r"a has shape \(2, 3\); .* 2 axes, so it must be \(2, 2\)"),
        (ROWS, A, np.ones(2), r"b has shape \(2,\)"),
        (np.where(np.eye(5, 2), np.nan, ROWS), A, B, r"acceleration\[0, 0\] is not finite"),
        (ROWS, A, [[1.0, 0.0], [np.inf, 0.0]], r"b\[1, 0\] is not finite"),
    ],
)
def test_invalid_perturbations_are_refused(acceleration, a, b, message):
    with pytest.raises(PlantError, match=message):
        Perturbation(acceleration, a, b)


@pytest.mark.parametrize(
    ("shape", "message"),
    [((4, 2), r"it has 4 rows; the commands have 5"), ((5, 1), r"it has 1 axes; the plant has 2")],
)
def test_a_perturbation_that_does_not_fit_the_run_is_refused(shape, message):
    perturbation = Perturbation(np.ones(shape), *np.zeros((2, shape[1], shape[1])))
    with pytest.raises(PlantError, match=message):
        simulate_motion(Plant.of(parse_robot(TWO_AXIS_TEXT)), np.arange(5) / 1000, perturbation)


def test_a_perturbation_cannot_end_silently():
    plant, time_s = Plant.of(parse_robot(TWO_AXIS_TEXT)), np.arange(10) / 1000
    command = np.zeros((5, 2))
    acceleration = np.ones((5, 2))
    _, state = plant.advance(
        plant.find_rest_state(0.0, command[0]),
        time_s[:5],
        command,
        perturbation=Perturbation(acceleration, A, B),
    )
    with pytest.raises(PlantError, match="none is given, but Q of the previous row still acts"):
        plant.advance(state, time_s[5:], command)
    acceleration[-1] = 0.0
    _, state = plant.advance(
        plant.find_rest_state(0.0, command[0]),
        time_s[:5],
        command,
        perturbation=Perturbation(acceleration, A, B),
    )
    plant.advance(state, time_s[5:], command)


def test_a_perturbation_cannot_be_changed():
    acceleration = np.ones((5, 2))
    perturbation = Perturbation(acceleration, A, B)
    acceleration[0] = 2.0
    assert perturbation.acceleration[0].tolist() == [1.0, 1.0]
    with pytest.raises(ValueError, match="read-only"):
        perturbation.b[0, 0] = 1.0
