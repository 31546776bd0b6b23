"""The matrices of the equation of motion over all axes of a plant."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray, IntArray
from rotemina.sim.effects.formulation import Change, Motion, Part, Reading, Skew
from rotemina.sim.plant.coupled_groups import input_gain
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.matrices import inertia_matrices
from rotemina.sim.robot.model import ForceAxis


@dataclass(frozen=True, slots=True, eq=False)
class EquationMatrices:
    """Matrices (axes, axes) and vectors (axes,) of the equation, zero for static axes.

    ``inverse`` is M⁻¹, ``moving`` tells which axes are not static, ``disturbed`` which belong to a
    group that effects or late inputs disturb, ``hidden`` to one of which not the axis itself is
    seen.
    """

    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    inverse: FloatArray
    input_gain: FloatArray
    constant: FloatArray
    moving: BoolArray
    disturbed: BoolArray
    hidden: BoolArray

    @classmethod
    def of(cls, plant: Plant) -> Self:
        """Assemble them over the axes of a plant, in its order."""
        robot, axes = plant.robot, plant.axes
        names, mass, damping, stiffness = inertia_matrices(robot)
        place = np.array([axes.index(name) for name in names], dtype=np.int64)
        moving = np.zeros(len(axes), dtype=np.bool_)
        moving[place] = True
        gains, offsets = np.zeros(len(axes)), np.zeros(len(axes))
        for number, axis in enumerate(robot.axes.values()):
            if moving[number]:
                gains[number] = input_gain(axis)
                offsets[number] = -axis.force_offset if isinstance(axis, ForceAxis) else 0.0
        inverse = np.asarray(np.linalg.inv(mass), dtype=np.float64)
        return cls(
            _spread(mass, place, len(axes)),
            _spread(damping, place, len(axes)),
            _spread(stiffness, place, len(axes)),
            _spread(inverse, place, len(axes)),
            gains,
            offsets,
            moving,
            _with_groups(plant, _disturbed(plant)),
            _with_groups(plant, _hidden(plant)),
        )


def _spread(matrix: FloatArray, place: IntArray, axes: int) -> FloatArray:
    """Return a matrix over some axes as one over all."""
    whole = np.zeros((axes, axes))
    whole[np.ix_(place, place)] = matrix
    return whole


def _disturbed(plant: Plant) -> set[str]:
    """Return axes that do not follow from their inputs alone."""
    late = {
        name for name, loop in zip(plant.axes, plant.loops, strict=True) if loop and loop.delay_s
    }
    # A changed axis is the one whose figures the plant has; the others act on readings alone.
    return late | {
        one.asked.axis
        for one in plant.effects
        if not isinstance(one.formulation.acts, Change | Reading | Skew)
    }


def _hidden(plant: Plant) -> set[str]:
    """Return axes that are seen elsewhere than where they are."""
    return {
        one.asked.axis for one in plant.effects if isinstance(one.formulation.acts, Motion | Part)
    }


def _with_groups(plant: Plant, names: set[str]) -> BoolArray:
    """Tell which axes (axes,) move, and belong to a group with one of ``names``."""
    groups = [set(group.axes) for group in plant.groups]
    reached = set().union(*(group for group in groups if group & names))
    return np.array([name in reached for name in plant.axes], dtype=np.bool_)
