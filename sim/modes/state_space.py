"""A machine in state space: the matrices A, B, C, D of its equation of motion.

Eq. (1) of the source paper, ``M q̈ + D q̇ + C q = E u + F``, with the state ``s = [q, q̇]`` of
the axes that have dynamics::

    ṡ = A s + B u,   A = [[0, 1], [−M⁻¹C, −M⁻¹D]],   B = [[0], [M⁻¹E]]
    y = C s + D u

The constant force F moves the point of rest and is left out.

The perturbation of the same equation, ``A Q̇ + B Q`` (with capitals that are no state matrices:
here P and R), comes in by matrices of its own. So that its input is Q and not Q̇ as well, the
state is ``s' = s − [0, M⁻¹P Q]``::

    ṡ' = A s' + (A [0, M⁻¹P] + [0, M⁻¹R]) Q,   y = C (s' + [0, M⁻¹P] Q)
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.plant.coupled_groups import input_gain
from rotemina.sim.robot.matrices import inertia_matrices
from rotemina.sim.robot.model import Robot


class StateSpaceError(InputError):
    """Matrices that cannot be made."""


class Output(StrEnum):
    """What ``y`` holds of every axis: m or rad, per s, per s²."""

    POSITION = "position"
    VELOCITY = "velocity"
    ACCELERATION = "acceleration"


@dataclass(frozen=True, slots=True, eq=False)
class StateSpace:
    """Matrices of a robot with n axes, m of which have dynamics.

    Attributes
    ----------
    inputs : tuple of str, length n
        The axes, in the robot's order, whose ``u`` is the input: V, or the commanded position of
        a stepper; or their Q. The outputs have the same order.
    states : tuple of str, length m
        The axes with dynamics; the state is their positions, then their velocities.
    a : (2m, 2m)
    b : (2m, n)
    c : (n, 2m)
    d : (n, n)
        Static axes are all here: ``q = gain·u``, or the command.
    """

    inputs: tuple[str, ...]
    states: tuple[str, ...]
    a: FloatArray
    b: FloatArray
    c: FloatArray
    d: FloatArray

    def response(self, frequency_hz: FloatArray) -> np.ndarray:
        """Return the frequency response ``C (iω − A)⁻¹ B + D``: complex (..., n, n)."""
        rate = 2j * np.pi * np.asarray(frequency_hz)[..., None, None]
        inner = np.linalg.solve(rate * np.eye(len(self.a)) - self.a, self.b.astype(complex))
        return np.asarray(self.c @ inner + self.d)


def state_space(robot: Robot, output: Output = Output.POSITION) -> StateSpace:
    """Return the matrices of ``robot``, driven open loop.

    A static axis follows at once, so its velocity and acceleration are no function of the inputs
    alone: they stay zero.
    """
    names, mass, damping, stiffness = inertia_matrices(robot)
    inputs = tuple(robot.axes)
    place = [inputs.index(name) for name in names]
    m, inverse = len(names), np.linalg.inv(mass)
    a = np.zeros((2 * m, 2 * m))
    a[:m, m:] = np.eye(m)
    a[m:] = np.hstack([-inverse @ stiffness, -inverse @ damping])
    b = np.zeros((2 * m, len(inputs)))
    b[m:, place] = inverse * [input_gain(robot.axes[name]) for name in names]
    c, d = np.zeros((len(inputs), 2 * m)), np.zeros((len(inputs), len(inputs)))
    if output is Output.ACCELERATION:
        c[place], d[place] = a[m:], b[m:]
    else:
        first = 0 if output is Output.POSITION else m
        c[place, first + np.arange(m)] = 1.0
    if output is Output.POSITION:
        d += np.diag([axis.gain if axis.static else 0.0 for axis in robot.axes.values()])
    return StateSpace(inputs, names, *(read_only(matrix) for matrix in (a, b, c, d)))


def perturbed_state_space(
    robot: Robot, rate: FloatArray, level: FloatArray, output: Output = Output.POSITION
) -> StateSpace:
    """Return the matrices of ``robot`` from the perturbation Q of its axes, inputs held.

    Parameters
    ----------
    robot : Robot
    rate, level : (n, n)
        A and B of Eq. (1), kg s and kg (or kg m² s and kg m²), as of
        :class:`rotemina.sim.plant.perturbation.Perturbation`. Rows are the axes that are pushed.
    output : Output
        Where Q̇ pushes, accelerations do not follow from Q, and are refused.

    Returns
    -------
    StateSpace
        Its inputs are Q, m/s² or rad/s², in the robot's order; the state is s'.

    Raises
    ------
    StateSpaceError
        If a matrix does not fit, or accelerations are asked for where Q̇ pushes.
    """
    driven = state_space(robot, output)
    n, m = len(driven.inputs), len(driven.states)
    for name, matrix in (("rate", rate), ("level", level)):
        if np.shape(matrix) != (n, n) or not np.isfinite(matrix).all():
            raise StateSpaceError(
                message(
                    "engine",
                    "{name} has shape {shape}; give it ({n}, {n}) finite numbers, a row and a "
                    "column for each of {names}",
                ).fill(name=name, shape=str(np.shape(matrix)), n=n, names=" ".join(driven.inputs))
            )
    if output is Output.ACCELERATION and np.any(rate):
        raise StateSpaceError(
            message(
                "engine",
                "accelerations under a perturbation by its rate have no finite response; use "
                "velocities",
            )
        )
    names, mass, _, _ = inertia_matrices(robot)
    place = [driven.inputs.index(name) for name in names]
    by_rate, by_level = np.zeros((2, 2 * m, n))
    by_rate[m:] = np.linalg.solve(mass, np.asarray(rate)[place])
    by_level[m:] = np.linalg.solve(mass, np.asarray(level)[place])
    through = driven.c @ by_rate
    if output is Output.ACCELERATION:
        through[place] = by_level[m:]
    matrices = (driven.a, driven.a @ by_rate + by_level, driven.c, through)
    return StateSpace(driven.inputs, driven.states, *(read_only(matrix) for matrix in matrices))
