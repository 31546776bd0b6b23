"""Groups of coupled axes in state space.

The equation of motion, Eq. (1) of the paper, over the axes of one group::

    q̈ = M⁻¹ ( −D q̇ − C q + E U + F )

with the constant force ``F = −force_offset`` of force axes. Axes that no coupling joins move
independently, so a robot falls into groups that are simulated each by itself.
"""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.robot.matrices import inertia_matrices
from rotemina.sim.robot.model import Axis, ForceAxis, PiezoAxis, Robot


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """One set of coupled axes; state ``[q, q̇]`` of length 2m, inputs U of length m.

    Attributes
    ----------
    axes : tuple of str, length m
    generator : (2m + m + 1, 2m + m + 1)
        The augmented matrix ``[[A, B, f], [0, 0, 0]]`` whose exponential steps the state exactly
        while the inputs are held.
    stiffness : (m, m)
        C of the equation.
    input_gain : (m,)
        E of the equation: N/V for volts, N/m for a commanded position.
    force : (m,)
        F of the equation, N.
    moved_by_force : (m,) bool
        Which axes are of kind ``force``.
    """

    axes: tuple[str, ...]
    generator: FloatArray
    stiffness: FloatArray
    input_gain: FloatArray
    force: FloatArray
    moved_by_force: BoolArray

    @property
    def size(self) -> int:
        """Number of axes m."""
        return len(self.axes)


def input_gain(axis: Axis) -> float:
    """E of one axis: piezo ``stiffness·gain``, stepper ``stiffness``, force ``gain``."""
    if isinstance(axis, ForceAxis):
        return axis.gain
    inertia = axis.inertia
    stiffness = inertia.stiffness if inertia is not None else 0.0
    return stiffness * axis.gain if isinstance(axis, PiezoAxis) else stiffness


def groups_of(robot: Robot) -> tuple[Group, ...]:
    """Split a robot into groups of coupled axes, each in the robot's order."""
    names, mass, damping, stiffness = inertia_matrices(robot)
    coupled = (mass != 0) | (damping != 0) | (stiffness != 0)
    return tuple(
        _group(robot, [names[i] for i in members], mass, damping, stiffness, members)
        for members in _connected(coupled)
    )


def _connected(coupled: np.ndarray) -> list[list[int]]:
    """Return the connected components of a symmetric (m, m) relation, each sorted."""
    remaining = list(range(len(coupled)))
    components = []
    while remaining:
        reached = {remaining[0]}
        frontier = [remaining[0]]
        while frontier:
            near = set(np.flatnonzero(coupled[frontier.pop()]).tolist()) - reached
            reached |= near
            frontier.extend(near)
        components.append(sorted(reached))
        remaining = [index for index in remaining if index not in reached]
    return components


def _group(
    robot: Robot,
    axes: list[str],
    mass: FloatArray,
    damping: FloatArray,
    stiffness: FloatArray,
    members: list[int],
) -> Group:
    block = np.ix_(members, members)
    gains = np.array([input_gain(robot.axes[name]) for name in axes])
    forced = [axis if isinstance(axis := robot.axes[n], ForceAxis) else None for n in axes]
    force = np.array([-axis.force_offset if axis else 0.0 for axis in forced])
    m = len(axes)
    inverse = np.linalg.inv(mass[block])
    generator = np.zeros((3 * m + 1, 3 * m + 1))
    generator[:m, m : 2 * m] = np.eye(m)
    generator[m : 2 * m, :m] = -inverse @ stiffness[block]
    generator[m : 2 * m, m : 2 * m] = -inverse @ damping[block]
    generator[m : 2 * m, 2 * m : 3 * m] = inverse * gains
    generator[m : 2 * m, 3 * m] = inverse @ force
    by_force = np.array([axis is not None for axis in forced])
    return Group(tuple(axes), generator, stiffness[block], gains, force, by_force)
