"""Groups of coupled axes in state space.

The equation of motion, Eq. (1) of the paper, over the axes of one group::

    q̈ = M⁻¹ ( −D q̇ − C q + E U + F + f )

with the constant force ``F = −force_offset`` of force axes, and further forces f that are zero
unless an effect or a perturbation sets them. Axes that no coupling joins move independently, so a
robot falls into groups that are stepped each by itself. Effects may add linear states z of their
own to a group (:class:`rotemina.sim.effects.formulation.LinearPart`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects.formulation import LinearPart
from rotemina.sim.robot.matrices import inertia_matrices
from rotemina.sim.robot.model import Axis, ForceAxis, Robot


class PlacedPart(NamedTuple):
    """A linear part at an axis; with a ``port`` its output goes there, not to the position."""

    axis: str
    part: LinearPart
    port: int | None = None


class Output(NamedTuple):
    """A position: ``weights · state + through · u`` of ``axis``, or what goes to a ``port``."""

    axis: str
    port: int | None
    weights: FloatArray
    through: float


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """One set of coupled axes; state ``[q, q̇, z]`` of length n, inputs U of length m.

    A static axis is a group of its own without q and q̇, with the states z of its parts alone.

    Attributes
    ----------
    axes : tuple of str, length m
    generator : (n + 2m + 1, n + 2m + 1)
        The augmented matrix ``[[A, B, f, G], [0, 0, 0, 0]]`` whose exponential steps the state
        exactly while the m inputs, the constant 1 and the m forces are held.
    stiffness : (m, m)
        C of the equation.
    input_gain : (m,)
        E of the equation: N/V for volts, N/m for a commanded position.
    force : (m,)
        F of the equation, N.
    moved_by_force : (m,) bool
        Which axes are of kind ``force``.
    outputs : tuple of Output
        The positions of the axes, in their order, then what goes to ports.
    static : bool
    """

    axes: tuple[str, ...]
    generator: FloatArray
    stiffness: FloatArray
    input_gain: FloatArray
    force: FloatArray
    moved_by_force: BoolArray
    outputs: tuple[Output, ...]
    static: bool = False

    @property
    def size(self) -> int:
        """Number of axes m."""
        return len(self.axes)

    @property
    def states(self) -> int:
        """Number of states n."""
        return len(self.generator) - 2 * self.size - 1

    def settled(self, position: FloatArray, inputs: FloatArray) -> FloatArray:
        """Return the state (n,) at rest at ``position`` (m,) under ``inputs`` (m,)."""
        own = 0 if self.static else 2 * self.size
        state = np.zeros(self.states)
        if not self.static:
            state[: self.size] = position
        rows = slice(own, self.states)
        if self.states > own:
            load = self.generator[rows, :own] @ state[:own]
            load = load + self.generator[rows, self.states : self.states + self.size] @ inputs
            state[rows] = -np.linalg.solve(self.generator[rows, rows], load)
        return state


def input_gain(axis: Axis) -> float:
    """E of one axis: piezo ``stiffness·gain``, stepper ``stiffness``, force ``gain``."""
    if isinstance(axis, ForceAxis):
        return axis.gain
    inertia = axis.inertia
    stiffness = inertia.stiffness if inertia is not None else 0.0
    return stiffness * axis.gain


def asked_position(axis: Axis) -> float:
    """Position that one unit of input asks for: gain of a piezo, 1 of a stepper or a force."""
    return 1.0 if isinstance(axis, ForceAxis) else axis.gain


def groups_of(robot: Robot, parts: Sequence[PlacedPart] = ()) -> tuple[Group, ...]:
    """Split the axes with dynamics into groups of coupled ones, each in the robot's order."""
    names, mass, damping, stiffness = inertia_matrices(robot)
    return tuple(
        _group(robot, [names[i] for i in members], mass, damping, stiffness, members, parts)
        for members in _connected(mass, damping, stiffness)
    )


def coupled_axes(robot: Robot) -> list[set[str]]:
    """Return the sets of axes with dynamics that are coupled."""
    names, mass, damping, stiffness = inertia_matrices(robot)
    return [{names[i] for i in members} for members in _connected(mass, damping, stiffness)]


def static_groups_of(robot: Robot, parts: Sequence[PlacedPart] = ()) -> tuple[Group, ...]:
    """Return a group for each static axis, in the robot's order."""
    return tuple(_static(name, a, parts) for name, a in robot.axes.items() if a.static)


def _connected(*matrices: FloatArray) -> list[list[int]]:
    """Return which of m axes matrices (m, m) join, each set sorted."""
    coupled = np.any([matrix != 0.0 for matrix in matrices], axis=0)
    reached = np.linalg.matrix_power(coupled | np.eye(len(coupled), dtype=np.bool_), len(coupled))
    return [np.flatnonzero(row).tolist() for i, row in enumerate(reached) if not row[:i].any()]


def _group(
    robot: Robot,
    axes: list[str],
    mass: FloatArray,
    damping: FloatArray,
    stiffness: FloatArray,
    members: list[int],
    parts: Sequence[PlacedPart],
) -> Group:
    block = np.ix_(members, members)
    gains = np.array([input_gain(robot.axes[name]) for name in axes])
    forced = [axis if isinstance(axis := robot.axes[n], ForceAxis) else None for n in axes]
    force = np.array([-axis.force_offset if axis else 0.0 for axis in forced])
    own = [placed for placed in parts if placed.axis in axes]
    m = len(axes)
    n = 2 * m + sum(len(placed.part.a) for placed in own)
    inverse = np.linalg.inv(mass[block])
    generator = np.zeros((n + 2 * m + 1, n + 2 * m + 1))
    speed = slice(m, 2 * m)
    generator[:m, speed] = np.eye(m)
    generator[speed, :m] = -inverse @ stiffness[block]
    generator[speed, speed] = -inverse @ damping[block]
    generator[speed, n : n + m] = inverse * gains
    generator[speed, n + m] = inverse @ force
    generator[speed, n + m + 1 :] = inverse
    outputs = [Output(name, None, np.eye(1, n, i)[0], 0.0) for i, name in enumerate(axes)]
    first = 2 * m
    for placed in own:
        i = axes.index(placed.axis)
        _join(generator, outputs, placed, i, m, first, asked_position(robot.axes[placed.axis]))
        first += len(placed.part.a)
    by_force = np.array([axis is not None for axis in forced])
    return Group(tuple(axes), generator, stiffness[block], gains, force, by_force, tuple(outputs))


def _join(
    generator: FloatArray,
    outputs: list[Output],
    placed: PlacedPart,
    i: int,
    m: int,
    first: int,
    asked: float,
) -> None:
    """Add a part's states, from ``first`` on, to those of the i-th axis of a group."""
    part = placed.part
    n = len(generator) - 2 * m - 1
    z = slice(first, first + len(part.a))
    generator[z, z] = part.a
    generator[z, i], generator[z, m + i] = part.b[:, 0], part.b[:, 1]
    generator[z, n + i] = part.b[:, 2] * asked
    if part.force is not None:
        per_force = generator[m : 2 * m, n + m + 1 + i]
        generator[m : 2 * m, z] += np.outer(per_force, part.force)
        generator[m : 2 * m, i] += per_force * part.reaction[0]
        generator[m : 2 * m, m + i] += per_force * part.reaction[1]
    leak = np.zeros(n)
    leak[z] = part.output
    if placed.port is None:
        whole = outputs[i]
        outputs[i] = whole._replace(weights=(1.0 - part.share) * whole.weights + leak)
    else:
        leak[i] = part.share
        outputs.append(Output(placed.axis, placed.port, leak, 0.0))


def _static(name: str, axis: Axis, parts: Sequence[PlacedPart]) -> Group:
    """Return the group of a static axis: its position is ``gain·u``, and what its parts add."""
    own = [placed for placed in parts if placed.axis == name]
    n = sum(len(placed.part.a) for placed in own)
    gain = axis.gain
    generator = np.zeros((n + 3, n + 3))
    whole, outputs, first = Output(name, None, np.zeros(n), gain), [], 0
    for placed in own:
        part, z = placed.part, slice(first, first + len(placed.part.a))
        generator[z, z] = part.a
        generator[z, n] = (part.b[:, 0] + part.b[:, 2]) * gain
        leak = np.zeros(n)
        leak[z] = part.output
        if placed.port is None:
            left = 1.0 - part.share
            whole = whole._replace(
                weights=left * whole.weights + leak, through=left * whole.through
            )
        else:
            outputs.append(Output(name, placed.port, leak, part.share * gain))
        first = z.stop
    none = np.zeros(1)
    by_force = np.zeros(1, dtype=np.bool_)
    return Group(
        (name,), generator, np.zeros((1, 1)), none, none, by_force, (whole, *outputs), static=True
    )
