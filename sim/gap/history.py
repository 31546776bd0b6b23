"""The state of a record at its start: at rest, in a steady state, or unknown.

The memory of an axis before an unknown history is a nuisance of the record. It lies between extreme
states: the axis was long at the low or at the high end of its range until a row before the first
one, or has come slowly from the high end. The differences between the answers to these and to a
rest at the first command are nuisance signals in amounts of about one.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rotemina.sim.plant.history import measured_start, steady_start
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.run import Run
from rotemina.sim.plant.state import PlantState
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import ForceAxis

_FALL_S, _FALL_ROWS = 2.0, 200  # from the high end, the last half of it at the first command


def start(plant: Plant, record: Record, run: Run) -> PlantState:
    """Return the state at the first row of a record.

    Raises
    ------
    PlantError
        If the record is periodic and there is no steady state.
    """
    if record.history == "periodic":
        return steady_start(plant, run, record.period_samples)
    if record.history == "unknown":
        return measured_start(plant, record, run, settled=True)
    return plant.at_rest(run.time_s[0], run.command[0])


def other_starts(plant: Plant, record: Record, run: Run, axis: str) -> Iterator[PlantState]:
    """Give the extreme states one row before the first one, where the history is unknown.

    A force-driven axis has no position of rest: the measurement gives its start.
    """
    described = plant.robot.axes[axis]
    forgets = isinstance(described, ForceAxis) or not plant.assembly.remembers
    if record.history != "unknown" or forgets:
        return
    before_s = run.time_s[0] - (run.time_s[1] - run.time_s[0])
    for end in described.range:
        command = np.array(run.command[0])
        command[plant.axes.index(axis)] = end
        yield plant.at_rest(before_s, command)
    yield _fallen(plant, run, axis)


def _fallen(plant: Plant, run: Run, axis: str) -> PlantState:
    """Return the state of an axis that has come slowly from the high end of its range.

    It remembers that, and rings no more.
    """
    time_s = run.time_s[0] + np.linspace(-_FALL_S, 0.0, _FALL_ROWS + 1)[:-1]
    command = np.tile(run.command[0], (_FALL_ROWS, 1))
    column = plant.axes.index(axis)
    high = plant.robot.axes[axis].range[1]
    way = np.minimum(np.linspace(0.0, 2.0, _FALL_ROWS), 1.0)
    command[:, column] = high + way * (run.command[0, column] - high)
    _, after = plant.advance(plant.at_rest(time_s[0], command[0]), time_s, command)
    elapsed_s = float(time_s[-1] - run.time_s[0])
    return replace(after, elapsed_s=elapsed_s, seen=after.seen + (elapsed_s - after.elapsed_s))
