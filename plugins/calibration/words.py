"""Texts, tables and curves of the calibration panel, without widgets."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rotemina.app.calibration import (
    CalibrationPlaybackPhase,
    CalibrationPlaybackState,
    StoredCalibration,
    make_figure_rows,
    make_iso_rows,
)
from rotemina.app.language import format_duration, get_axis_label, translate_message
from rotemina.plugins.calibration import mark, tr
from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration import SensorCalibration
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot, StepperAxis
from rotemina.sim.units import choose_scale, format_quantity

STORED_HEADINGS = (mark("axis"), mark("date"), mark("error before"), mark("after"), mark("state"))
FIGURE_HEADINGS = (mark("figure"), mark("value"), "± 95 %")
ISO_HEADINGS = ("ISO 230-2", mark("reading before"), mark("after"), mark("position reached"))
NO_PLAN_TEXT = mark("Plan and run the motion, or fit records with the sensor and the laser.")


class CalibrationCurves(NamedTuple):
    """Curves over a common horizontal axis.

    The titles of the axes contain the units. ``x`` is (n,). Each curve is a name, a colour role and
    values (n,).
    """

    left_title: str
    bottom_title: str
    x: FloatArray
    curves: tuple[tuple[str, str, FloatArray], ...]


def describe_motion(motion: Record, axis: str, robot: Robot) -> str:
    """Return axis, runs, range and duration of a motion as text."""
    if has_iso_cycles(robot, axis):
        text = tr("{axis}: {runs} runs, ISO 230-2 cycles of {targets} targets, {ends}, {time} min")
    else:
        text = tr("{axis}: {runs} runs, triangles and moves, {ends}, {time} min")
    low, high = (float(end(motion.signal(axis, Tap.CMD))) for end in (np.min, np.max))
    unit = robot.unit(axis) or "m"
    limits = tr("{low} to {high}").format(
        low=format_quantity(low, unit, size=high), high=format_quantity(high, unit, size=high)
    )
    return text.format(
        axis=get_axis_label(axis),
        runs=motion.metadata["calibration_runs"],
        targets=motion.metadata.get("calibration_targets", ""),
        ends=limits,
        time=format_duration(motion.duration_s),
    )


def make_motion_curves(motion: Record, axis: str) -> CalibrationCurves:
    """Return the set-point of the motion as a function of time."""
    command = motion.signal(axis, Tap.CMD)
    scale = choose_scale(motion.units[axis], float(np.abs(command).max()))
    return CalibrationCurves(
        tr("set-point [{unit}]").format(unit=scale.symbol),
        tr("time [s]"),
        motion.time_s,
        (("", "command", scale(command)),),
    )


def make_error_curves(calibration: SensorCalibration) -> CalibrationCurves:
    """Return the reading error against position, before and after the calibration.

    The errors are cross-validated: each run is corrected by a fit to the other runs.
    """
    order = np.argsort(calibration.position, kind="stable")
    # The 99.5th percentile is used, so that a few outliers do not decide the unit.
    largest = float(np.percentile(np.abs(calibration.before), 99.5)) or 1e-12
    scale = choose_scale(calibration.unit, largest)
    position_scale = choose_scale(calibration.unit, float(np.abs(calibration.position).max()))
    curves = tuple(
        (name, role, scale(error[order]))
        for name, role, error in (
            (mark("before"), "real", calibration.before),
            (mark("after"), "good", calibration.after),
        )
    )
    return CalibrationCurves(
        tr("error of the reading [{unit}]").format(unit=scale.symbol),
        tr("position [{unit}]").format(unit=position_scale.symbol),
        position_scale(calibration.position[order]),
        curves,
    )


def describe_progress(state: CalibrationPlaybackState, duration_s: float) -> str:
    """Return the progress of a run as text."""
    if state.phase is CalibrationPlaybackPhase.MOVING:
        remaining_s = (1.0 - state.progress) * duration_s
        text = tr("Running: {share:.0f} %, {time} left")
        return text.format(share=100.0 * state.progress, time=format_duration(remaining_s))
    if state.phase is CalibrationPlaybackPhase.FAILED:
        return tr("The run has failed: {message}.").format(message=translate_message(state.message))
    return tr("The run is complete.") if state.phase is CalibrationPlaybackPhase.DONE else ""


def describe_verdict(calibration: SensorCalibration) -> str:
    """Return the error before and after a calibration, with its notes, or why it is refused."""
    unit = calibration.unit
    if calibration.refusal is not None:
        text = tr("Refused: {reason}.").format(reason=translate_message(calibration.refusal))
    else:
        before, after = (
            format_quantity(rms, unit) for rms in (calibration.before_rms, calibration.after_rms)
        )
        text = tr("Error in the validation runs: {before} rms before, {after} after.")
        text = text.format(before=before, after=after)
    return "\n".join(
        [
            text,
            *(
                f"{note[:1].upper()}{note[1:]}."
                for note in map(translate_message, calibration.notes)
            ),
        ]
    )


def make_rows_of_figures(calibration: SensorCalibration) -> tuple[tuple[str, ...], ...]:
    """Return the rows of the figures: name, value and interval."""
    return _translate_names(make_figure_rows(calibration.figures))


def make_rows_of_iso(calibration: SensorCalibration) -> tuple[tuple[str, ...], ...]:
    """Return the rows of the ISO 230-2 table; none if the axis made no such cycles."""
    return _translate_names(
        make_iso_rows(
            calibration.reading_before,
            calibration.reading_after,
            calibration.reached,
            calibration.unit,
        )
    )


def translate_headings(headings: tuple[str, ...]) -> tuple[str, ...]:
    """Return headings in the language of the window."""
    return tuple(tr(text) for text in headings)


def make_stored_row(stored: StoredCalibration) -> tuple[str, ...]:
    """Return the row of a stored calibration in the order of :data:`STORED_HEADINGS`."""
    calibration = stored.calibration
    return (
        get_axis_label(calibration.axis),
        calibration.date.replace("T", " ")[:16],
        format_quantity(calibration.before_rms, calibration.unit),
        format_quantity(calibration.after_rms, calibration.unit),
        tr("on") if stored.on else tr("off"),
    )


def has_iso_cycles(robot: Robot, axis: str) -> bool:
    """Return whether the axis is calibrated by cycles of ISO 230-2."""
    return isinstance(robot.axes[axis], StepperAxis)


def _translate_names(rows: Iterable[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Return rows with their first column in the language of the window."""
    return tuple((translate_message(name), *values) for name, *values in rows)
