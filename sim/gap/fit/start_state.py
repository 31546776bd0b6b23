"""The state of a record at its start: at rest, in a steady state, or unknown.

What an axis remembers from before an unknown history is the record's own. It is taken to lie
somewhere between extremes: the axis was long at the low or at the high end of its range until a row
before the first one, or has come slowly from the high end; or it has made the motion of the record
once before, as an experiment that is repeated does. How the answers to these differ from the answer
to a rest at the first command are nuisances of the record, in amounts of about one.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant import Plant, PlantState, RunCommands, estimate_start, find_steady_start
from rotemina.sim.records import Record
from rotemina.sim.robot import ForceAxis

_WAY_S, _WAY_ROWS = 2.0, 200  # to the first command, the last half of it there


def start(plant: Plant, record: Record, run: RunCommands) -> PlantState:
    """Return the state at the first row of a record.

    Raises
    ------
    PlantError
        If the record is periodic and there is no steady state.
    """
    if record.history == "periodic":
        return find_steady_start(plant, run, record.period_samples)
    if record.history == "unknown":
        return estimate_start(plant, record, run, settled=True)
    return plant.find_rest_state(run.time_s[0], run.command[0])


def other_starts(plant: Plant, record: Record, run: RunCommands, axis: str) -> Iterator[PlantState]:
    """Give the extreme states one row before the first one, where the history is unknown.

    A force-driven axis has no position of rest: the measurement gives its start.
    """
    described = plant.robot.axes[axis]
    forgets = isinstance(described, ForceAxis) or not plant.assembly.has_memory
    if record.history != "unknown" or forgets:
        return
    before_s = run.time_s[0] - (run.time_s[1] - run.time_s[0])
    for end in described.range:
        command = np.array(run.command[0])
        command[plant.axes.index(axis)] = end
        yield plant.find_rest_state(before_s, command)
    column = plant.axes.index(axis)
    own, half = run.command[:, column], _WAY_ROWS // 2
    fall = np.linspace(described.range[1], own[0], half)
    before = own[np.linspace(0, len(own) - 1, half).astype(int)]
    for way in (fall, before):
        yield _come(plant, run, column, np.append(way, np.full(half, own[0])))


def _come(plant: Plant, run: RunCommands, column: int, way: FloatArray) -> PlantState:
    """Return the state of an axis that has come slowly along a way (n,) to the first command.

    It remembers that, and rings no more.
    """
    time_s = run.time_s[0] + np.linspace(-_WAY_S, 0.0, len(way) + 1)[:-1]
    command = np.tile(run.command[0], (len(way), 1))
    command[:, column] = way
    _, after = plant.advance(plant.find_rest_state(time_s[0], command[0]), time_s, command)
    elapsed_s = float(time_s[-1] - run.time_s[0])
    return replace(
        after, elapsed_s=elapsed_s, called_s=after.called_s + (elapsed_s - after.elapsed_s)
    )
