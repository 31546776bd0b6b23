"""What the calibration panel says and draws, free of widgets."""

import re
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rotemina.app.calibration.run import Phase, RunState
from rotemina.app.calibration.store import Stored
from rotemina.app.calibration.words import amount, figure_rows, iso_rows
from rotemina.app.display import duration_text, label
from rotemina.app.shell.language import marked, translate
from rotemina.plugins.calibration.engine_words import spoken
from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.calibrating import Calibration
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot, StepperAxis
from rotemina.sim.units import drawing_unit, symbol, to_unit

STORED_HEAD = (
    marked("calibration", "axis"),
    marked("calibration", "date"),
    marked("calibration", "error before"),
    marked("calibration", "after"),
    marked("calibration", "state"),
)
FIGURES_HEAD = (marked("calibration", "figure"), marked("calibration", "value"), "± 95 %")
ISO_HEAD = (
    "ISO 230-2",
    marked("calibration", "reading before"),
    marked("calibration", "after"),
    marked("calibration", "where it went"),
)
# Figures as the model and ISO 230-2 call them.
FIGURES = (
    marked("calibration", "offset"),
    marked("calibration", "gain error"),
    marked("calibration", "nonlinearity"),
    marked("calibration", "hysteresis"),
    marked("calibration", "interpolation error"),
    marked("calibration", "its period"),
    marked("calibration", "lag, time constant"),
    marked("calibration", "lag, delay"),
    marked("calibration", "A, accuracy"),
    marked("calibration", "R, repeatability"),
    marked("calibration", "B, reversal value"),
    marked("calibration", "B̄, mean reversal"),
    marked("calibration", "E, systematic deviation"),
    marked("calibration", "M, mean bidirectional"),
)
NOTHING = marked(
    "calibration", "Plan the motion and run it, or fit records that hold the sensor and the laser."
)


class Drawing(NamedTuple):
    """Curves over the same axis: titles with units, x (n,), and name, role and y (n,) of each."""

    left: str
    bottom: str
    x: FloatArray
    curves: tuple[tuple[str, str, FloatArray], ...]


def planned(motion: Record, axis: str, robot: Robot) -> str:
    """Return what a motion is."""
    runs, what = motion.metadata["calibration"].partition(": ")[2].split(" runs, ", 1)
    targets = re.search(r"of (\d+) targets", what)
    text = translate("calibration", "{axis}: {runs} runs, triangles and moves, {ends}, {time} min")
    if targets is not None:
        text = translate(
            "calibration",
            "{axis}: {runs} runs, ISO 230-2 cycles of {targets} targets, {ends}, {time} min",
        )
    low, high = (float(end(motion.signal(axis, Tap.CMD))) for end in (np.min, np.max))
    unit = robot.unit(axis) or "m"
    ends = translate("calibration", "{low} to {high}").format(
        low=amount(low, unit, scale=high), high=amount(high, unit, scale=high)
    )
    return text.format(
        axis=label(axis),
        runs=runs,
        targets=targets[1] if targets is not None else "",
        ends=ends,
        time=duration_text(motion.duration_s),
    )


def motion_drawing(motion: Record, axis: str) -> Drawing:
    """Return the motion's set-point over time."""
    command = motion.signal(axis, Tap.CMD)
    unit = drawing_unit(motion.units[axis], float(np.abs(command).max()))
    values = np.asarray(to_unit(command, unit))
    return Drawing(
        translate("calibration", "set-point [{unit}]").format(unit=symbol(unit)),
        translate("calibration", "time [s]"),
        motion.time_s,
        (("", "command", values),),
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
            (marked("calibration", "before"), "real", calibration.before),
            (marked("calibration", "after"), "good", calibration.after),
        )
    )
    position = np.asarray(to_unit(calibration.position[order], across))
    return Drawing(
        translate("calibration", "error of the reading [{unit}]").format(unit=symbol(unit)),
        translate("calibration", "position [{unit}]").format(unit=symbol(across)),
        position,
        curves,
    )


def progress(state: RunState, duration_s: float) -> str:
    """Return how far a run is."""
    if state.phase is Phase.MOVING:
        left_s = (1.0 - state.progress) * duration_s
        text = translate("calibration", "Running: {share:.0f} %, {time} left")
        return text.format(share=100.0 * state.progress, time=duration_text(left_s))
    if state.phase is Phase.FAILED:
        return translate("calibration", "The run has failed: {message}.").format(
            message=spoken(state.message)
        )
    return translate("calibration", "The run is done.") if state.phase is Phase.DONE else ""


def verdict(calibration: Calibration) -> str:
    """Return what a calibration is worth, and what was noted."""
    unit = calibration.unit
    if calibration.refusal is not None:
        text = translate("calibration", "Refused: {reason}.").format(
            reason=spoken(calibration.refusal)
        )
    else:
        before, after = (
            amount(each, unit) for each in (calibration.before_rms, calibration.after_rms)
        )
        text = translate(
            "calibration", "Error at held-out runs: {before} rms before, {after} after."
        )
        text = text.format(before=before, after=after)
    return "\n".join(
        [text, *(f"{note[:1].upper()}{note[1:]}." for note in map(spoken, calibration.notes))]
    )


def figures(calibration: Calibration) -> tuple[tuple[str, ...], ...]:
    """Return the rows of figures: name, value and interval."""
    return _named(figure_rows(calibration.figures))


def iso(calibration: Calibration) -> tuple[tuple[str, ...], ...]:
    """Return the rows of the table of ISO 230-2; none of an axis that made no cycle of it."""
    return _named(
        iso_rows(
            calibration.reading_before,
            calibration.reading_after,
            calibration.reached,
            calibration.unit,
        )
    )


def shown(head: tuple[str, ...]) -> tuple[str, ...]:
    """Return a head in the language of the window."""
    return tuple(translate("calibration", text) for text in head)


def stored_row(one: Stored) -> tuple[str, ...]:
    """Return the row of a stored calibration under :data:`STORED_HEAD`."""
    kept = one.calibration
    return (
        label(kept.axis),
        kept.date.replace("T", " ")[:16],
        amount(kept.before_rms, kept.unit),
        amount(kept.after_rms, kept.unit),
        translate("calibration", "on") if one.on else translate("calibration", "off"),
    )


def cycles(robot: Robot, axis: str) -> bool:
    """Tell whether the axis makes the cycles of ISO 230-2."""
    return isinstance(robot.axes[axis], StepperAxis)


def _named(rows: Iterable[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Return rows with their figures' names in the language of the window."""
    return tuple((translate("calibration", name), *values) for name, *values in rows)
