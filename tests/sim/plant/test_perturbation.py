"""The perturbation of Eq. (1) against solutions found by other means."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.signal import lsim

from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.perturbation import Perturbation
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.file import parse_robot

MASS, DAMPING, STIFFNESS = 2.0, 30.0, 8.0e4  # 31.8 Hz, damping ratio 0.0375

ONE = f"""
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

TWO = (
    ONE.replace('["x"]', '["x", "tip"]')
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


def respond(plant, time_s, perturbation, command=None):
    command = np.zeros((len(time_s), len(plant.axes))) if command is None else command
    state = plant.at_rest(time_s[0], command[0])
    return plant.advance(state, time_s, command, perturbation=perturbation)[0]


def test_a_base_shaken_under_one_axis_is_what_lsim_finds():
    plant, time_s = Plant.of(parse_robot(ONE)), np.arange(2000) / 1000
    shaken = np.sin(2.0 * np.pi * 20.0 * time_s) + 0.3
    motion = respond(plant, time_s, Perturbation(shaken[:, None], np.zeros((1, 1)), [[-MASS]]))
    system = (
        np.array([[0.0, 1.0], [-STIFFNESS / MASS, -DAMPING / MASS]]),
        np.array([[0.0], [-1.0]]),
        np.eye(2),
        np.zeros((2, 1)),
    )
    _, exact, _ = lsim(system, shaken, time_s, interp=False)
    assert np.abs(motion.position[:, 0] - exact[:, 0]).max() < 1e-10 * np.abs(exact[:, 0]).max()
    assert np.abs(motion.velocity[:, 0] - exact[:, 1]).max() < 1e-10 * np.abs(exact[:, 1]).max()


def test_a_held_acceleration_settles_as_the_closed_form_says():
    plant, time_s = Plant.of(parse_robot(ONE)), np.arange(500) / 700
    motion = respond(plant, time_s, Perturbation(np.ones((500, 1)), np.zeros((1, 1)), [[3.0]]))
    rate = np.sqrt(STIFFNESS / MASS)
    decay = DAMPING / (2.0 * MASS)
    damped = np.sqrt(rate**2 - decay**2)
    swing = np.cos(damped * time_s) + decay / damped * np.sin(damped * time_s)
    exact = 3.0 / STIFFNESS * (1.0 - np.exp(-decay * time_s) * swing)
    assert motion.position[:, 0] == pytest.approx(exact, abs=1e-10 * exact.max())


def test_a_change_of_q_is_an_impulse():
    """After q̇ jumps by A/M the axis swings freely; the sample itself is taken before."""
    plant, time_s = Plant.of(parse_robot(ONE)), np.arange(500) / 700
    motion = respond(plant, time_s, Perturbation(np.ones((500, 1)), [[0.5]], np.zeros((1, 1))))
    decay = DAMPING / (2.0 * MASS)
    damped = np.sqrt(STIFFNESS / MASS - decay**2)
    exact = 0.5 / MASS / damped * np.exp(-decay * time_s) * np.sin(damped * time_s)
    assert motion.position[:, 0] == pytest.approx(exact, abs=1e-10 * exact.max())
    assert motion.velocity[0, 0] == 0.0
    swing = np.cos(damped * time_s) - decay / damped * np.sin(damped * time_s)
    speed = 0.5 / MASS * np.exp(-decay * time_s) * swing
    assert motion.velocity[1:, 0] == pytest.approx(speed[1:], abs=1e-10 * speed[0])


def by_expm(time_s, shaken, command):
    """Step both axes by the matrix exponential, kicked at each sample; [q, q̇] before each."""
    zero, one = np.zeros((2, 2)), np.eye(2)
    drift = np.block([[zero, one], [-np.linalg.solve(M, C), -np.linalg.solve(M, D)]])
    drive = command * [STIFFNESS, 3e4]  # E U: stiffness·cmd of a stepper and of a piezo
    rest = np.concatenate([np.linalg.solve(C, drive[0]), np.zeros(2)])
    rows, state, before = [], rest, np.zeros(2)
    for row, push in enumerate(shaken):
        rows.append(state)
        state = state + np.concatenate([np.zeros(2), np.linalg.solve(M, A @ (push - before))])
        before = push
        if row + 1 < len(time_s):
            into = np.concatenate([np.zeros(2), np.linalg.solve(M, B @ push + drive[row])])
            step = np.block([[drift, into[:, None]], [np.zeros((1, 5))]])
            state = (expm(step * (time_s[row + 1] - time_s[row])) @ np.append(state, 1.0))[:4]
    return np.array(rows)


def uneven():
    rng = np.random.default_rng(4)
    time_s = np.cumsum(rng.uniform(5e-4, 3e-3, 300))
    return time_s, rng.normal(size=(300, 2)), rng.uniform(0.0, 1e-3, (300, 2))


def test_coupled_axes_are_what_the_matrix_exponential_finds():
    time_s, shaken, command = uneven()
    motion = respond(Plant.of(parse_robot(TWO)), time_s, Perturbation(shaken, A, B), command)
    exact = by_expm(time_s, shaken, command)
    assert np.abs(motion.position - exact[:, :2]).max() < 1e-9 * np.abs(exact[:, :2]).max()
    assert np.abs(motion.velocity - exact[:, 2:]).max() < 1e-9 * np.abs(exact[:, 2:]).max()


@pytest.mark.parametrize("rows", [1, 2, 77])
def test_in_pieces_it_is_the_same(rows):
    time_s, shaken, command = uneven()
    plant, whole = Plant.of(parse_robot(TWO)), Perturbation(shaken, A, B)
    at_once = respond(plant, time_s, whole, command)
    state, position = plant.at_rest(time_s[0], command[0]), []
    for first in range(0, 300, rows):
        own = slice(first, first + rows)
        motion, state = plant.advance(
            state, time_s[own], command[own], perturbation=whole.part(own)
        )
        position.append(motion.position)
    gap = np.concatenate(position) - at_once.position
    assert np.abs(gap).max() < 1e-10 * np.abs(at_once.position).max()


def test_impulses_of_a_ramp_become_the_force_of_its_slope():
    """Q = r t pushes with A r; held from sample to sample, it does so with an error of order 1."""
    plant, errors = Plant.of(parse_robot(ONE)), []
    for rate_hz in (500, 1000, 2000):
        time_s = np.arange(rate_hz // 10 + 1) / rate_hz
        ramp = 7.0 * time_s[:, None]
        motion = respond(plant, time_s, Perturbation(ramp, [[0.5]], np.zeros((1, 1))))
        decay = DAMPING / (2.0 * MASS)
        damped = np.sqrt(STIFFNESS / MASS - decay**2)
        swing = np.cos(damped * time_s) + decay / damped * np.sin(damped * time_s)
        exact = 3.5 / STIFFNESS * (1.0 - np.exp(-decay * time_s) * swing)
        errors.append(np.abs(motion.position[:, 0] - exact).max() / exact.max())
    assert errors[0] < 0.2
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(2.0, rel=0.1)


def test_static_axes_are_not_moved():
    static = ONE[: ONE.index("mass")] + "static = true"
    motion = respond(
        Plant.of(parse_robot(static)),
        np.arange(5) / 1000,
        Perturbation(np.ones((5, 1)), [[1.0]], [[1.0]]),
        np.full((5, 1), 0.002),
    )
    assert motion.position[:, 0].tolist() == [0.002] * 5


ROW = np.ones((5, 2))


@pytest.mark.parametrize(
    ("acceleration", "a", "b", "message"),
    [
        (np.ones(5), A, B, r"acceleration has shape \(5,\); give it a row for each sample"),
        (ROW, np.ones((2, 3)), B, r"a has shape \(2, 3\); .* 2 axes, so it must be \(2, 2\)"),
        (ROW, A, np.ones(2), r"b has shape \(2,\)"),
        (np.where(np.eye(5, 2), np.nan, ROW), A, B, r"acceleration\[0, 0\] is not finite"),
        (ROW, A, [[1.0, 0.0], [np.inf, 0.0]], r"b\[1, 0\] is not finite"),
    ],
)
def test_what_is_no_perturbation_is_refused(acceleration, a, b, message):
    with pytest.raises(PlantError, match=message):
        Perturbation(acceleration, a, b)


@pytest.mark.parametrize(
    ("shape", "message"),
    [((4, 2), r"it has 4 rows; the commands have 5"), ((5, 1), r"it has 1 axes; the plant has 2")],
)
def test_one_that_does_not_fit_the_run_is_refused(shape, message):
    perturbation = Perturbation(np.ones(shape), *np.zeros((2, shape[1], shape[1])))
    with pytest.raises(PlantError, match=message):
        respond(Plant.of(parse_robot(TWO)), np.arange(5) / 1000, perturbation)


def test_a_run_that_is_shaken_does_not_silently_end_to_be():
    plant, time_s = Plant.of(parse_robot(TWO)), np.arange(10) / 1000
    command = np.zeros((5, 2))
    shaken = np.ones((5, 2))
    _, state = plant.advance(
        plant.at_rest(0.0, command[0]), time_s[:5], command, perturbation=Perturbation(shaken, A, B)
    )
    with pytest.raises(PlantError, match="none is given, but Q of the previous row still acts"):
        plant.advance(state, time_s[5:], command)
    shaken[-1] = 0.0
    _, state = plant.advance(
        plant.at_rest(0.0, command[0]), time_s[:5], command, perturbation=Perturbation(shaken, A, B)
    )
    plant.advance(state, time_s[5:], command)


def test_it_cannot_be_changed_afterwards():
    given = np.ones((5, 2))
    perturbation = Perturbation(given, A, B)
    given[0] = 2.0
    assert perturbation.acceleration[0].tolist() == [1.0, 1.0]
    with pytest.raises(ValueError, match="read-only"):
        perturbation.b[0, 0] = 1.0
