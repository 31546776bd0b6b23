"""Matrices of the equation of motion over all axes of a plant."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.effects import (
    AddedStates,
    AxisChange,
    ClockSkew,
    PositionFunction,
    ReadingFunction,
)
from rotemina.sim.plant.coupled_groups import compute_input_gain
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot import ForceAxis, assemble_inertia_matrices


@dataclass(frozen=True, slots=True, eq=False)
class EquationMatrices:
    """Matrices (axes, axes) and vectors (axes,) of the equation, zero for static axes.

    ``inverse`` is M⁻¹. ``moving``: axes that are not static. ``disturbed``: axes in a group that
    effects or delayed inputs disturb. ``hidden``: axes in a group with an axis whose observed
    position is not its true one, because of an effect.
    """

    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    inverse: FloatArray
    input_gain: FloatArray
    constant: FloatArray
    moving: BoolArray
    disturbed: BoolArray
    has_observation_effect: BoolArray

    @classmethod
    def of(cls, plant: Plant) -> Self:
        """Assemble the matrices over the axes of a plant, in its order."""
        robot, axes = plant.robot, plant.axes
        names, mass, damping, stiffness = assemble_inertia_matrices(robot)
        indices = np.array([axes.index(name) for name in names], dtype=np.int64)
        is_moving = np.zeros(len(axes), dtype=np.bool_)
        is_moving[indices] = True
        gains, offsets = np.zeros(len(axes)), np.zeros(len(axes))
        for index, axis in enumerate(robot.axes.values()):
            if is_moving[index]:
                gains[index] = compute_input_gain(axis)
                offsets[index] = -axis.force_offset if isinstance(axis, ForceAxis) else 0.0
        inverse = np.asarray(np.linalg.inv(mass), dtype=np.float64)
        return cls(
            _expand_matrix(mass, indices, len(axes)),
            _expand_matrix(damping, indices, len(axes)),
            _expand_matrix(stiffness, indices, len(axes)),
            _expand_matrix(inverse, indices, len(axes)),
            gains,
            offsets,
            is_moving,
            _mark_groups(plant, _find_disturbed_axes(plant)),
            _mark_groups(plant, _find_hidden_axes(plant)),
        )


def _expand_matrix(matrix: FloatArray, indices: IntArray, axis_count: int) -> FloatArray:
    expanded = np.zeros((axis_count, axis_count))
    expanded[np.ix_(indices, indices)] = matrix
    return expanded


def _find_disturbed_axes(plant: Plant) -> set[str]:
    """Return the axes whose motion does not follow from their inputs alone."""
    delayed = {
        name for name, loop in zip(plant.axes, plant.loops, strict=True) if loop and loop.delay_s
    }
    # A changed axis disturbs nothing, because the plant already has its new properties. Effects on
    # readings and clocks do not change the motion.
    return delayed | {
        effect.entry.axis
        for effect in plant.effects
        if not isinstance(effect.formulation.acts, AxisChange | ReadingFunction | ClockSkew)
    }


def _find_hidden_axes(plant: Plant) -> set[str]:
    """Return the axes whose observed position an effect changes."""
    return {
        effect.entry.axis
        for effect in plant.effects
        if isinstance(effect.formulation.acts, PositionFunction | AddedStates)
    }


def _mark_groups(plant: Plant, names: set[str]) -> BoolArray:
    """Return which axes (axes,) move and belong to a group with one of ``names``."""
    groups = [set(group.axes) for group in plant.groups]
    marked = set().union(*(group for group in groups if group & names))
    return np.array([name in marked for name in plant.axes], dtype=np.bool_)
