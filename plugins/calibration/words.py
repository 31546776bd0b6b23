"""Text and figures of the calibration panel, free of widgets."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rotemina.app.calibration.calibration_playback import Phase, RunState
from rotemina.app.calibration.store import Stored
from rotemina.app.calibration.words import figure_rows, iso_rows
from rotemina.app.display_units import duration_text, label
from rotemina.app.shell.engine_words import spoken
from rotemina.plugins.calibration import mark, tr
from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.sensor_calibration import Calibration
from rotemina.sim.quantities import amount, scale_of
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot, StepperAxis

STORED_HEAD = (mark("axis"), mark("date"), mark("error before"), mark("after"), mark("state"))
FIGURES_HEAD = (mark("figure"), mark("value"), "± 95 %")
ISO_HEAD = ("ISO 230-2", mark("reading before"), mark("after"), mark("position reached"))
NOTHING = mark("Plan and run the motion, or fit records with the sensor and the laser.")


class Drawing(NamedTuple):
    """Curves over the same axis: titles with units, x (n,), and name, role and y (n,) of each."""

    left: str
    bottom: str
    x: FloatArray
    curves: tuple[tuple[str, str, FloatArray], ...]


def planned(motion: Record, axis: str, robot: Robot) -> str:
    """Return what a motion is."""
    if cycles(robot, axis):
        text = tr("{axis}: {runs} runs, ISO 230-2 cycles of {targets} targets, {ends}, {time} min")
    else:
        text = tr("{axis}: {runs} runs, triangles and moves, {ends}, {time} min")
    low, high = (float(end(motion.signal(axis, Tap.CMD))) for end in (np.min, np.max))
    unit = robot.unit(axis) or "m"
    ends = tr("{low} to {high}").format(
        low=amount(low, unit, size=high), high=amount(high, unit, size=high)
    )
    return text.format(
        axis=label(axis),
        runs=motion.metadata["calibration_runs"],
        targets=motion.metadata.get("calibration_targets", ""),
        ends=ends,
        time=duration_text(motion.duration_s),
    )


def motion_drawing(motion: Record, axis: str) -> Drawing:
    """Return the motion's set-point over time."""
    command = motion.signal(axis, Tap.CMD)
    scale = scale_of(motion.units[axis], float(np.abs(command).max()))
    return Drawing(
        tr("set-point [{unit}]").format(unit=scale.symbol),
        tr("time [s]"),
        motion.time_s,
        (("", "command", scale(command)),),
    )


def error_drawing(calibration: Calibration) -> Drawing:
    """Return the reading's errors at held-out runs, before and after, over the position."""
    order = np.argsort(calibration.position, kind="stable")
    largest = float(np.percentile(np.abs(calibration.before), 99.5)) or 1e-12
    scale = scale_of(calibration.unit, largest)
    across = scale_of(calibration.unit, float(np.abs(calibration.position).max()))
    curves = tuple(
        (name, role, scale(error[order]))
        for name, role, error in (
            (mark("before"), "real", calibration.before),
            (mark("after"), "good", calibration.after),
        )
    )
    return Drawing(
        tr("error of the reading [{unit}]").format(unit=scale.symbol),
        tr("position [{unit}]").format(unit=across.symbol),
        across(calibration.position[order]),
        curves,
    )


def progress(state: RunState, duration_s: float) -> str:
    """Return how far a run is."""
    if state.phase is Phase.MOVING:
        left_s = (1.0 - state.progress) * duration_s
        text = tr("Running: {share:.0f} %, {time} left")
        return text.format(share=100.0 * state.progress, time=duration_text(left_s))
    if state.phase is Phase.FAILED:
        return tr("The run has failed: {message}.").format(message=spoken(state.message))
    return tr("The run is complete.") if state.phase is Phase.DONE else ""


def verdict(calibration: Calibration) -> str:
    """Return the benefit of a calibration, and its notes."""
    unit = calibration.unit
    if calibration.refusal is not None:
        text = tr("Refused: {reason}.").format(reason=spoken(calibration.refusal))
    else:
        before, after = (
            amount(each, unit) for each in (calibration.before_rms, calibration.after_rms)
        )
        text = tr("Error in the validation runs: {before} rms before, {after} after.")
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
    return tuple(tr(text) for text in head)


def stored_row(one: Stored) -> tuple[str, ...]:
    """Return the row of a stored calibration under :data:`STORED_HEAD`."""
    kept = one.calibration
    return (
        label(kept.axis),
        kept.date.replace("T", " ")[:16],
        amount(kept.before_rms, kept.unit),
        amount(kept.after_rms, kept.unit),
        tr("on") if one.on else tr("off"),
    )


def cycles(robot: Robot, axis: str) -> bool:
    """Return whether the axis makes the cycles of ISO 230-2."""
    return isinstance(robot.axes[axis], StepperAxis)


def _named(rows: Iterable[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Return rows with their figures' names in the language of the window."""
    return tuple((spoken(name), *values) for name, *values in rows)
