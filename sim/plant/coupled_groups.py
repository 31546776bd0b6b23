"""Groups of coupled axes in state space.

The equation of motion, Eq. (1) of the paper, over the axes of one group::

    q̈ = M⁻¹ ( −D q̇ − C q + E U + F + f )

with the constant force ``F = −force_offset`` of force axes, and further forces f that are zero
unless an effect or a perturbation sets them. Axes without a coupling between them move
independently, so a robot consists of groups that are stepped separately. Effects may add their
own linear states z to a group (:class:`rotemina.sim.effects.LinearPart`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects import LinearPart
from rotemina.sim.robot import (
    Axis,
    ForceAxis,
    Robot,
    assemble_inertia_matrices,
)


class PlacedPart(NamedTuple):
    """Linear part of an effect, driven by ``axis``.

    Its output adds to the position of this axis. With a ``port``, the output goes to the step
    function of an effect on another axis instead.
    """

    axis: str
    part: LinearPart
    port: int | None = None


class OutputEquation(NamedTuple):
    """Output equation ``weights · state + through · u`` of ``axis``.

    It gives the position of the axis or, with a ``port``, the output to that port.
    """

    axis: str
    port: int | None
    weights: FloatArray
    through: float


@dataclass(frozen=True, slots=True, eq=False)
class AxisGroup:
    """Set of coupled axes with state ``[q, q̇, z]`` of length n and inputs U of length m.

    A static axis is a group without q and q̇; its states are only the z of its parts.

    Attributes
    ----------
    axes : tuple of str, length m
    generator : (n + 2m + 1, n + 2m + 1)
        The augmented matrix ``[[A, B, f, G], [0, 0, 0, 0]]``. Its exponential steps the state
        exactly while the m inputs, the constant 1 and the m forces are held.
    stiffness : (m, m)
        C of the equation.
    input_gain : (m,)
        E of the equation: N/V for volts, N/m for a commanded position.
    force : (m,)
        F of the equation, N.
    moved_by_force : (m,) bool
        Which axes are of kind ``force``.
    outputs : tuple of OutputEquation
        The positions of the axes, in their order, then the outputs to ports.
    static : bool
    """

    axes: tuple[str, ...]
    generator: FloatArray
    stiffness: FloatArray
    input_gain: FloatArray
    force: FloatArray
    moved_by_force: BoolArray
    outputs: tuple[OutputEquation, ...]
    static: bool = False

    @property
    def size(self) -> int:
        """Number of axes m."""
        return len(self.axes)

    @property
    def states(self) -> int:
        """Number of states n."""
        return len(self.generator) - 2 * self.size - 1

    def compute_rest_state(self, position: FloatArray, inputs: FloatArray) -> FloatArray:
        """Return the state (n,) at rest at ``position`` (m,) under ``inputs`` (m,)."""
        motion_states = 0 if self.static else 2 * self.size
        state = np.zeros(self.states)
        if not self.static:
            state[: self.size] = position
        rows = slice(motion_states, self.states)
        if self.states > motion_states:
            load = self.generator[rows, :motion_states] @ state[:motion_states]
            load = load + self.generator[rows, self.states : self.states + self.size] @ inputs
            state[rows] = -np.linalg.solve(self.generator[rows, rows], load)
        return state


def compute_input_gain(axis: Axis) -> float:
    """Return E of one axis: piezo ``stiffness·gain``, stepper ``stiffness``, force ``gain``."""
    if isinstance(axis, ForceAxis):
        return axis.gain
    inertia = axis.inertia
    stiffness = inertia.stiffness if inertia is not None else 0.0
    return stiffness * axis.gain


def compute_position_gain(axis: Axis) -> float:
    """Return the position that one unit of input requests.

    It is the gain of a piezo, and 1 for a stepper or a force axis.
    """
    return 1.0 if isinstance(axis, ForceAxis) else axis.gain


def make_groups(robot: Robot, parts: Sequence[PlacedPart] = ()) -> tuple[AxisGroup, ...]:
    """Split the axes with dynamics into coupled groups, each in the robot's order."""
    names, mass, damping, stiffness = assemble_inertia_matrices(robot)
    return tuple(
        _make_group(robot, [names[i] for i in members], mass, damping, stiffness, members, parts)
        for members in _find_connected_axes(mass, damping, stiffness)
    )


def find_coupled_axes(robot: Robot) -> list[set[str]]:
    """Return the sets of axes with dynamics that are coupled."""
    names, mass, damping, stiffness = assemble_inertia_matrices(robot)
    return [
        {names[i] for i in members} for members in _find_connected_axes(mass, damping, stiffness)
    ]


def make_static_groups(robot: Robot, parts: Sequence[PlacedPart] = ()) -> tuple[AxisGroup, ...]:
    """Return a group for each static axis, in the robot's order."""
    return tuple(_make_static_group(name, a, parts) for name, a in robot.axes.items() if a.static)


def _find_connected_axes(*matrices: FloatArray) -> list[list[int]]:
    # The m-th power of the adjacency matrix is non-zero where a path of couplings exists.
    coupled = np.any([matrix != 0.0 for matrix in matrices], axis=0)
    reachable = np.linalg.matrix_power(coupled | np.eye(len(coupled), dtype=np.bool_), len(coupled))
    return [np.flatnonzero(row).tolist() for i, row in enumerate(reachable) if not row[:i].any()]


def _make_group(
    robot: Robot,
    axes: list[str],
    mass: FloatArray,
    damping: FloatArray,
    stiffness: FloatArray,
    members: list[int],
    parts: Sequence[PlacedPart],
) -> AxisGroup:
    block = np.ix_(members, members)
    gains = np.array([compute_input_gain(robot.axes[name]) for name in axes])
    force_axes = [axis if isinstance(axis := robot.axes[n], ForceAxis) else None for n in axes]
    force = np.array([-axis.force_offset if axis else 0.0 for axis in force_axes])
    placed_parts = [placed for placed in parts if placed.axis in axes]
    m = len(axes)
    n = 2 * m + sum(len(placed.part.a) for placed in placed_parts)
    inverse_mass = np.linalg.inv(mass[block])
    generator = np.zeros((n + 2 * m + 1, n + 2 * m + 1))
    speed = slice(m, 2 * m)
    generator[:m, speed] = np.eye(m)
    generator[speed, :m] = -inverse_mass @ stiffness[block]
    generator[speed, speed] = -inverse_mass @ damping[block]
    generator[speed, n : n + m] = inverse_mass * gains
    generator[speed, n + m] = inverse_mass @ force
    generator[speed, n + m + 1 :] = inverse_mass
    outputs = [OutputEquation(name, None, np.eye(1, n, i)[0], 0.0) for i, name in enumerate(axes)]
    first_state = 2 * m
    for placed in placed_parts:
        i = axes.index(placed.axis)
        _add_part(
            generator,
            outputs,
            placed,
            i,
            m,
            first_state,
            compute_position_gain(robot.axes[placed.axis]),
        )
        first_state += len(placed.part.a)
    moved_by_force = np.array([axis is not None for axis in force_axes])
    return AxisGroup(
        tuple(axes), generator, stiffness[block], gains, force, moved_by_force, tuple(outputs)
    )


def _add_part(
    generator: FloatArray,
    outputs: list[OutputEquation],
    placed: PlacedPart,
    i: int,
    m: int,
    first_state: int,
    position_gain: float,
) -> None:
    part = placed.part
    n = len(generator) - 2 * m - 1
    z = slice(first_state, first_state + len(part.a))
    generator[z, z] = part.a
    generator[z, i], generator[z, m + i] = part.b[:, 0], part.b[:, 1]
    generator[z, n + i] = part.b[:, 2] * position_gain
    if part.force is not None:
        per_force = generator[m : 2 * m, n + m + 1 + i]
        generator[m : 2 * m, z] += np.outer(per_force, part.force)
        generator[m : 2 * m, i] += per_force * part.reaction[0]
        generator[m : 2 * m, m + i] += per_force * part.reaction[1]
    weights = np.zeros(n)
    weights[z] = part.output
    if placed.port is None:
        nominal = outputs[i]
        outputs[i] = nominal._replace(weights=(1.0 - part.share) * nominal.weights + weights)
    else:
        weights[i] = part.share
        outputs.append(OutputEquation(placed.axis, placed.port, weights, 0.0))


def _make_static_group(name: str, axis: Axis, parts: Sequence[PlacedPart]) -> AxisGroup:
    """Return the group of a static axis, whose position is ``gain·u`` plus the outputs of parts."""
    placed_parts = [placed for placed in parts if placed.axis == name]
    n = sum(len(placed.part.a) for placed in placed_parts)
    gain = axis.gain
    generator = np.zeros((n + 3, n + 3))
    position, outputs, first_state = OutputEquation(name, None, np.zeros(n), gain), [], 0
    for placed in placed_parts:
        part, z = placed.part, slice(first_state, first_state + len(placed.part.a))
        generator[z, z] = part.a
        generator[z, n] = (part.b[:, 0] + part.b[:, 2]) * gain
        weights = np.zeros(n)
        weights[z] = part.output
        if placed.port is None:
            axis_share = 1.0 - part.share
            position = position._replace(
                weights=axis_share * position.weights + weights,
                through=axis_share * position.through,
            )
        else:
            outputs.append(OutputEquation(name, placed.port, weights, part.share * gain))
        first_state = z.stop
    zero = np.zeros(1)
    no_force_axis = np.zeros(1, dtype=np.bool_)
    return AxisGroup(
        (name,),
        generator,
        np.zeros((1, 1)),
        zero,
        zero,
        no_force_axis,
        (position, *outputs),
        static=True,
    )
