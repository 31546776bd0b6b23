"""Simulation in finer rows than those of a record, for sensor clocks that read between the rows.

If the clock of a sensor is off, a reading lies between two rows. A vibration with few rows per
period cannot be interpolated there, so the motion in between is simulated.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import AxisProperties
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.state import ChainPoint, PlantMotion, PlantState, RunCommands

# This many rows allow a motion to be interpolated with an error of about 1 %.
_ROWS_PER_PERIOD = 8.0
# Largest number of parts of a row. In a row that would need more, the vibration soon decays.
_MAX_ROW_PARTS = 64


def compute_motion(
    plant: Plant, state: PlantState, run: RunCommands, behind: ChainPoint = ChainPoint.COMMAND
) -> PlantMotion:
    """Compute the response to a run, row by row, from a state at its first row or before.

    Raises
    ------
    PlantError
        If the response overflows a float.
    """
    parts = _count_divisions(plant, run.time_s)
    fine_run = _divide_rows(run, parts) if parts > 1 else run
    motion, _ = plant.advance(
        state,
        fine_run.time_s,
        fine_run.command,
        add=fine_run.add,
        inputs=fine_run.inputs,
        entry_point=behind,
    )
    return PlantMotion(*(signal[::parts] for signal in motion)) if parts > 1 else motion


def _count_divisions(plant: Plant, time_s: FloatArray) -> int:
    """Return the number of parts into which each row is divided.

    With a controller this is 1, because the controller acts once per row.
    """
    if not plant.assembly.skews or any(plant.loops) or len(time_s) < 2:
        return 1
    step_s = float(np.median(np.diff(time_s)))
    moving_axes = [axis for axis in plant.robot.axes.values() if not axis.static]
    fastest_hz = max((AxisProperties.of(axis).pace_hz for axis in moving_axes), default=0.0)
    return min(max(int(np.ceil(_ROWS_PER_PERIOD * fastest_hz * step_s)), 1), _MAX_ROW_PARTS)


def _divide_rows(run: RunCommands, parts: int) -> RunCommands:
    """Return a run with each row but the last divided into ``parts``.

    The inputs of a row are held for all its parts.
    """
    rows = len(run.time_s)
    fine_row_count = parts * (rows - 1) + 1
    time_s = np.interp(np.arange(fine_row_count) / parts, np.arange(rows), run.time_s)
    time_s[::parts] = run.time_s
    fine_signals = (np.repeat(signal, parts, axis=0)[:fine_row_count] for signal in run[1:])
    return RunCommands(time_s, *fine_signals)
