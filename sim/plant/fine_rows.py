"""Runs in finer rows than a record has, for clocks that read between its samples.

Where the clock of a sensor is off, a reading lies between two rows. A vibration that a row's width
hardly samples cannot be interpolated there: the motion in between must be simulated.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.facts import Facts
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.run import Run
from rotemina.sim.plant.state import Behind, Motion, PlantState

_ROWS_A_PERIOD = 8.0  # through which a motion can be read to about a hundredth
_MOST = 64  # parts of a row: where it outlasts the vibration, that is soon over


def respond(plant: Plant, state: PlantState, run: Run, behind: Behind = Behind.COMMAND) -> Motion:
    """Return the response to a run, from a state at its first row or before, row by row.

    Raises
    ------
    PlantError
        If it leaves what a float can hold.
    """
    many = _divisions(plant, run.time_s)
    finer = _divided(run, many) if many > 1 else run
    motion, _ = plant.advance(
        state,
        finer.time_s,
        finer.command,
        add=finer.add,
        inputs=finer.inputs,
        behind=behind,
    )
    return Motion(*(signal[::many] for signal in motion)) if many > 1 else motion


def _divisions(plant: Plant, time_s: FloatArray) -> int:
    """Return into how many a row is divided; a controller counts rows, which then stay."""
    if not plant.assembly.skews or any(plant.loops) or len(time_s) < 2:
        return 1
    step_s = float(np.median(np.diff(time_s)))
    moving = [axis for axis in plant.robot.axes.values() if not axis.static]
    fastest_hz = max((Facts.of(axis).pace_hz for axis in moving), default=0.0)
    return min(max(int(np.ceil(_ROWS_A_PERIOD * fastest_hz * step_s)), 1), _MOST)


def _divided(run: Run, many: int) -> Run:
    """Return a run with each row but the last in ``many``; what drives it holds for all of them."""
    rows = len(run.time_s)
    count = many * (rows - 1) + 1
    time_s = np.interp(np.arange(count) / many, np.arange(rows), run.time_s)
    time_s[::many] = run.time_s
    held = (np.repeat(drive, many, axis=0)[:count] for drive in run[1:])
    return Run(time_s, *held)
