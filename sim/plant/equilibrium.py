"""Equilibrium of a group of axes under held inputs or under its controllers."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.plant.coupled_groups import AxisGroup
from rotemina.sim.robot import CascadeController


class GroupEquilibrium(NamedTuple):
    """Positions (m,), m or rad, and the inputs (m,) that hold them."""

    position: FloatArray
    inputs: FloatArray


def find_equilibrium(
    group: AxisGroup,
    inputs: FloatArray,
    command: FloatArray,
    loops: tuple[CascadeController | None, ...],
    effect_inputs: FloatArray,
) -> GroupEquilibrium:
    """Find the equilibrium of one group; all arrays (m,).

    An axis without stiffness is at its command, and so is any axis that a force moves. The others
    satisfy ``C q = E u + F`` with the given input, or ``C q = E (u + effect_inputs) + F`` with a
    controller's ``u = clip(kv kp (cmd − q))``. Saturated controllers are found one after the
    other.
    """
    at_command = group.moved_by_force | (np.diag(group.stiffness) == 0.0)
    if not any(loops) and not at_command.any():
        load = group.input_gain * inputs + group.force
        position = np.asarray(np.linalg.solve(group.stiffness, load), dtype=np.float64)
        return GroupEquilibrium(position, inputs)
    slope = np.array([loop.kp * loop.kv if loop else 0.0 for loop in loops])
    limit = np.array([loop.limit if loop else np.inf for loop in loops])
    has_loop = slope > 0.0
    fixed_inputs = np.where(has_loop, 0.0, inputs)
    is_controlled = has_loop.copy()
    # Each pass fixes the inputs of the controllers that saturate, so this ends after m passes.
    for _ in range(group.size + 1):
        acting_inputs = fixed_inputs + np.where(has_loop, effect_inputs, 0.0)
        position = _solve_position(
            group, at_command, acting_inputs, np.where(is_controlled, slope, 0.0), command
        )
        effort = slope * (command - position)
        saturated = is_controlled & ~at_command & (np.abs(effort) > limit)
        if not saturated.any():
            break
        fixed_inputs = np.where(saturated, np.clip(effort, -limit, limit), fixed_inputs)
        is_controlled &= ~saturated
    return GroupEquilibrium(position, np.where(has_loop, np.clip(effort, -limit, limit), inputs))


def _solve_position(
    group: AxisGroup,
    at_command: BoolArray,
    inputs: FloatArray,
    slope: FloatArray,
    command: FloatArray,
) -> FloatArray:
    """Solve ``(C + E slope) q = E (inputs + slope cmd) + F`` for the axes not at their command."""
    position = np.where(at_command, command, 0.0)
    rows = ~at_command
    if rows.any():
        stiffness = group.stiffness + np.diag(group.input_gain * slope)
        load = group.input_gain * (inputs + slope * command) + group.force
        load = load - stiffness[:, at_command] @ position[at_command]
        position[rows] = np.linalg.solve(stiffness[np.ix_(rows, rows)], load[rows])
    return position
