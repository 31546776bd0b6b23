"""Where a group of axes rests under held inputs or under its controllers."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.plant.coupled_groups import Group
from rotemina.sim.robot.model import CascadeController


class Rest(NamedTuple):
    """Positions (m,), m or rad, and the inputs (m,) that hold them."""

    position: FloatArray
    inputs: FloatArray


def rest(
    group: Group,
    inputs: FloatArray,
    command: FloatArray,
    loops: tuple[CascadeController | None, ...],
    gained: FloatArray,
) -> Rest:
    """Return the rest of one group; all arrays (m,).

    A free axis, and any that a force moves, is at its command. For the others
    ``C q = E u + F`` with the given input, or ``C q = E (u + gained) + F`` with a controller's
    ``u = clip(kv kp (cmd − q))``: axes whose controller saturates are found one after the other.
    """
    at_command = group.moved_by_force | (np.diag(group.stiffness) == 0.0)
    if not any(loops) and not at_command.any():
        load = group.input_gain * inputs + group.force
        position = np.asarray(np.linalg.solve(group.stiffness, load), dtype=np.float64)
        return Rest(position, inputs)
    slope = np.array([loop.kp * loop.kv if loop else 0.0 for loop in loops])
    limit = np.array([loop.limit if loop else np.inf for loop in loops])
    looped = slope > 0.0
    held = np.where(looped, 0.0, inputs)
    following = looped.copy()
    for _ in range(group.size + 1):
        reached = held + np.where(looped, gained, 0.0)
        position = _solve(group, at_command, reached, np.where(following, slope, 0.0), command)
        effort = slope * (command - position)
        beyond = following & ~at_command & (np.abs(effort) > limit)
        if not beyond.any():
            break
        held = np.where(beyond, np.clip(effort, -limit, limit), held)
        following &= ~beyond
    return Rest(position, np.where(looped, np.clip(effort, -limit, limit), inputs))


def _solve(
    group: Group, at_command: BoolArray, held: FloatArray, slope: FloatArray, command: FloatArray
) -> FloatArray:
    """Solve ``(C + E slope) q = E (held + slope cmd) + F`` for the axes not at their command."""
    position = np.where(at_command, command, 0.0)
    rows = ~at_command
    if rows.any():
        stiffness = group.stiffness + np.diag(group.input_gain * slope)
        load = group.input_gain * (held + slope * command) + group.force
        load = load - stiffness[:, at_command] @ position[at_command]
        position[rows] = np.linalg.solve(stiffness[np.ix_(rows, rows)], load[rows])
    return position
