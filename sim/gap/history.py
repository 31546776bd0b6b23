"""How a record begins: at rest, in a steady state, or as nobody knows.

What an axis remembers from before an unknown history is the record's own. It is taken to lie
somewhere between two extremes, with the axis long at the low or at the high end of its range before
the first row: how the answers to these differ from the answer to a rest at the first command are
nuisances of the record, in amounts of about one.
"""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.plant.history import measured_start, steady_start
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.run import Run
from rotemina.sim.plant.state import PlantState
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import ForceAxis


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
        return measured_start(plant, record, run)
    return plant.at_rest(run.time_s[0], run.command[0])


def other_starts(plant: Plant, record: Record, run: Run, axis: str) -> Iterator[PlantState]:
    """Give the extreme states a row before the first one, where the history is unknown.

    An axis that a force moves has no place that it rests at: what was measured tells its start.
    """
    described = plant.robot.axes[axis]
    remembers = bool(plant.effects) or not described.static
    if record.history != "unknown" or isinstance(described, ForceAxis) or not remembers:
        return
    before_s = run.time_s[0] - (run.time_s[1] - run.time_s[0])
    for end in described.range:
        command = np.array(run.command[0])
        command[plant.axes.index(axis)] = end
        yield plant.at_rest(before_s, command)
