"""What the calibration panel says and draws, free of Qt."""

from typing import NamedTuple

import numpy as np

from rotemina.app.calibration.run import Phase, RunState
from rotemina.app.calibration.store import Stored
from rotemina.app.calibration.words import amount, figure_rows, iso_rows
from rotemina.app.display import duration_text, label
from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.calibrating import Calibration
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot, StepperAxis
from rotemina.sim.units import drawing_unit, symbol, to_unit

STORED_HEAD = ("axis", "date", "error before", "after", "state")
NOTHING = "Plan the motion and run it, or fit records that hold the sensor and the laser."


class Drawing(NamedTuple):
    """Curves over the same axis: titles with units, x (n,), and name, role and y (n,) of each."""

    left: str
    bottom: str
    x: FloatArray
    curves: tuple[tuple[str, str, FloatArray], ...]


def planned(motion: Record, axis: str, robot: Robot) -> str:
    """Return what a motion is."""
    what = motion.metadata["calibration"].partition(": ")[2]
    low, high = (float(end(motion.signal(axis, Tap.CMD))) for end in (np.min, np.max))
    unit = robot.unit(axis) or "m"
    ends = (amount(each, unit, scale=high) for each in (low, high))
    return f"{label(axis)}: {what}, {' to '.join(ends)}, {duration_text(motion.duration_s)} min"


def motion_drawing(motion: Record, axis: str) -> Drawing:
    """Return the motion's set-point over time."""
    command = motion.signal(axis, Tap.CMD)
    unit = drawing_unit(motion.units[axis], float(np.abs(command).max()))
    values = np.asarray(to_unit(command, unit))
    return Drawing(
        f"set-point [{symbol(unit)}]", "time [s]", motion.time_s, (("", "command", values),)
    )


def error_drawing(calibration: Calibration) -> Drawing:
    """Return the reading's errors at held-out runs, before and after, over the position."""
    order = np.argsort(calibration.position, kind="stable")
    largest = float(np.percentile(np.abs(calibration.before), 99.5)) or 1e-12
    unit = drawing_unit(calibration.unit, largest)
    across = drawing_unit(calibration.unit, float(np.abs(calibration.position).max()))
    curves = tuple(
        (name, role, np.asarray(to_unit(error[order], unit)))
        for name, role, error in (
            ("before", "real", calibration.before),
            ("after", "good", calibration.after),
        )
    )
    position = np.asarray(to_unit(calibration.position[order], across))
    return Drawing(
        f"error of the reading [{symbol(unit)}]", f"position [{symbol(across)}]", position, curves
    )


def progress(state: RunState, duration_s: float) -> str:
    """Return how far a run is."""
    if state.phase is Phase.MOVING:
        left_s = (1.0 - state.progress) * duration_s
        return f"Running: {100.0 * state.progress:.0f} %, {duration_text(left_s)} left"
    if state.phase is Phase.FAILED:
        return f"The run has failed: {state.message}."
    return "The run is done." if state.phase is Phase.DONE else ""


def verdict(calibration: Calibration) -> str:
    """Return what a calibration is worth, and what was noted."""
    unit = calibration.unit
    if calibration.refusal is not None:
        text = f"Refused: {calibration.refusal}."
    else:
        before, after = (
            amount(each, unit) for each in (calibration.before_rms, calibration.after_rms)
        )
        text = f"Error at held-out runs: {before} rms before, {after} after."
    return "\n".join([text, *(f"{note[:1].upper()}{note[1:]}." for note in calibration.notes)])


def figures(calibration: Calibration) -> tuple[tuple[str, ...], ...]:
    """Return the rows of figures: name, value and interval."""
    return figure_rows(calibration.figures)


def iso(calibration: Calibration) -> tuple[tuple[str, ...], ...]:
    """Return the rows of the table of ISO 230-2; none of an axis that made no cycle of it."""
    return iso_rows(
        calibration.reading_before,
        calibration.reading_after,
        calibration.reached,
        calibration.unit,
    )


def stored_row(one: Stored) -> tuple[str, ...]:
    """Return the row of a stored calibration under :data:`STORED_HEAD`."""
    kept = one.calibration
    return (
        label(kept.axis),
        kept.date.replace("T", " ")[:16],
        amount(kept.before_rms, kept.unit),
        amount(kept.after_rms, kept.unit),
        "on" if one.on else "off",
    )


def cycles(robot: Robot, axis: str) -> bool:
    """Tell whether the axis makes the cycles of ISO 230-2."""
    return isinstance(robot.axes[axis], StepperAxis)
