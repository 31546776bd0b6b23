"""A machine in state space: the matrices A, B, C, D of its equation of motion.

Eq. (1) of the source paper, ``M q̈ + D q̇ + C q = E u + F``, with the state ``s = [q, q̇]`` of
the axes that have dynamics::

    ṡ = A s + B u,   A = [[0, 1], [−M⁻¹C, −M⁻¹D]],   B = [[0], [M⁻¹E]]
    y = C s + D u

The constant force F only shifts the equilibrium and is left out.

The paper also has a perturbation ``A Q̇ + B Q`` of this equation. Its matrices A and B are not the
state matrices; they are called P and R here. The following state has Q as its only input, without
Q̇: ``s' = s − [0, M⁻¹P Q]``::

    ṡ' = A s' + (A [0, M⁻¹P] + [0, M⁻¹R]) Q,   y = C (s' + [0, M⁻¹P] Q)
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.errors import StateSpaceError
from rotemina.sim.plant import compute_input_gain
from rotemina.sim.robot import Robot, assemble_inertia_matrices


class OutputQuantity(StrEnum):
    """Quantity of every axis in the output ``y``: m or rad, per s, per s²."""

    POSITION = "position"
    VELOCITY = "velocity"
    ACCELERATION = "acceleration"


@dataclass(frozen=True, slots=True, eq=False)
class StateSpace:
    """Matrices of a robot with n axes, m of which have dynamics.

    Attributes
    ----------
    inputs : tuple of str, length n
        The axes in the robot's order. The input of each is its ``u``, V, or the commanded position
        of a stepper; or its perturbation Q. The outputs have the same order.
    states : tuple of str, length m
        The axes with dynamics. The state consists of their positions, then their velocities.
    a : (2m, 2m)
    b : (2m, n)
    c : (n, 2m)
    d : (n, n)
        For the static axes: ``q = gain·u``, or the command.
    """

    inputs: tuple[str, ...]
    states: tuple[str, ...]
    a: FloatArray
    b: FloatArray
    c: FloatArray
    d: FloatArray

    def response(self, frequency_hz: FloatArray) -> np.ndarray:
        """Return the frequency response ``C (iω − A)⁻¹ B + D``, complex (..., n, n)."""
        j_omega = 2j * np.pi * np.asarray(frequency_hz)[..., None, None]
        state_response = np.linalg.solve(
            j_omega * np.eye(len(self.a)) - self.a, self.b.astype(complex)
        )
        return np.asarray(self.c @ state_response + self.d)


def make_state_space(robot: Robot, output: OutputQuantity = OutputQuantity.POSITION) -> StateSpace:
    """Return the matrices of ``robot`` in open loop.

    A static axis follows its input immediately. Its velocity and acceleration cannot be computed
    from input and state, so their outputs stay zero.
    """
    names, mass, damping, stiffness = assemble_inertia_matrices(robot)
    inputs = tuple(robot.axes)
    rows = [inputs.index(name) for name in names]
    m = len(names)
    inverse_mass = np.linalg.inv(mass)
    a = np.zeros((2 * m, 2 * m))
    a[:m, m:] = np.eye(m)
    a[m:] = np.hstack([-inverse_mass @ stiffness, -inverse_mass @ damping])
    b = np.zeros((2 * m, len(inputs)))
    b[m:, rows] = inverse_mass * [compute_input_gain(robot.axes[name]) for name in names]
    c, d = np.zeros((len(inputs), 2 * m)), np.zeros((len(inputs), len(inputs)))
    if output is OutputQuantity.ACCELERATION:
        c[rows], d[rows] = a[m:], b[m:]
    else:
        first_state = 0 if output is OutputQuantity.POSITION else m
        c[rows, first_state + np.arange(m)] = 1.0
    if output is OutputQuantity.POSITION:
        d += np.diag([axis.gain if axis.static else 0.0 for axis in robot.axes.values()])
    return StateSpace(inputs, names, *(make_read_only(matrix) for matrix in (a, b, c, d)))


def make_perturbation_state_space(
    robot: Robot,
    rate: FloatArray,
    level: FloatArray,
    output: OutputQuantity = OutputQuantity.POSITION,
) -> StateSpace:
    """Return the matrices of ``robot`` with the perturbation Q of its axes as input.

    Parameters
    ----------
    robot : Robot
    rate, level : (n, n)
        A and B of Eq. (1), kg s and kg (or kg m² s and kg m²), as in
        :class:`rotemina.sim.plant.Perturbation`. Each row is a perturbed axis.
    output : OutputQuantity
        Accelerations are not available if ``rate`` is not zero, because they would depend on Q̇.

    Returns
    -------
    StateSpace
        The inputs are Q, m/s² or rad/s², in the robot's order; the state is s'.

    Raises
    ------
    StateSpaceError
        If a matrix has the wrong shape, or accelerations are requested with a non-zero ``rate``.
    """
    nominal = make_state_space(robot, output)
    n, m = len(nominal.inputs), len(nominal.states)
    for name, matrix in (("rate", rate), ("level", level)):
        if np.shape(matrix) != (n, n) or not np.isfinite(matrix).all():
            raise StateSpaceError(
                "{name} has shape {shape}; it must have ({n}, {n}) finite numbers, with a "
                "row and a column for each of {names}",
                name=name,
                shape=str(np.shape(matrix)),
                n=n,
                names=" ".join(nominal.inputs),
            )
    if output is OutputQuantity.ACCELERATION and np.any(rate):
        raise StateSpaceError(
            "accelerations under a perturbation by its rate have no finite response; use velocities"
        )
    names, mass, _, _ = assemble_inertia_matrices(robot)
    rows = [nominal.inputs.index(name) for name in names]
    by_rate, by_level = np.zeros((2, 2 * m, n))
    by_rate[m:] = np.linalg.solve(mass, np.asarray(rate)[rows])
    by_level[m:] = np.linalg.solve(mass, np.asarray(level)[rows])
    feedthrough = nominal.c @ by_rate
    if output is OutputQuantity.ACCELERATION:
        feedthrough[rows] = by_level[m:]
    matrices = (nominal.a, nominal.a @ by_rate + by_level, nominal.c, feedthrough)
    return StateSpace(
        nominal.inputs, nominal.states, *(make_read_only(matrix) for matrix in matrices)
    )
