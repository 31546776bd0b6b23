"""Texts of a calibration, for the command line and the panel."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from rotemina.sim.calibration import PositioningFigures, SensorCalibration, SensorFigureEstimate
from rotemina.sim.messages import (
    NO_VALUE,
    MessageWording,
    NumberText,
    format_rounded,
    marked,
    message,
)
from rotemina.sim.units import format_exact, format_quantity

ISO_TITLES = {
    "accuracy": marked("engine", "A, accuracy"),
    "repeatability": marked("engine", "R, repeatability"),
    "repeatability_up": "R↑",
    "repeatability_down": "R↓",
    "reversal": marked("engine", "B, reversal value"),
    "mean_reversal": marked("engine", "B̄, mean reversal"),
    "systematic": marked("engine", "E, systematic deviation"),
    "mean_bidirectional": marked("engine", "M, mean bidirectional deviation"),
}
# Smaller ratios are shown in ppm instead of %.
_MIN_RATIO_IN_PERCENT = 1e-3
ISO_TABLE_HEADER = (
    "ISO 230-2",
    marked("engine", "reading before"),
    marked("engine", "after"),
    marked("engine", "position reached"),
)


def format_figure(value: float, unit: str, *, size: float | None = None, digits: int = 4) -> str:
    """Return a figure with a suitable unit; a ratio (unit ``1``) is shown in % or ppm."""
    if unit != "1":
        return format_quantity(value, unit, size=size, digits=digits)
    if abs(size or value) < _MIN_RATIO_IN_PERCENT:
        return NumberText(f"{format_rounded(1e6 * value, digits)} ppm")
    return NumberText(f"{format_rounded(100.0 * value, digits)} %")


def _format_like(value: float, figure: SensorFigureEstimate, digits: int = 4) -> str:
    """Return a value in the unit that suits the figure or its interval, whichever is larger."""
    sizes = [abs(number) for number in (figure.value, figure.half_width) if np.isfinite(number)]
    return format_figure(value, figure.unit, size=max(sizes), digits=digits)


def make_figure_rows(figures: Iterable[SensorFigureEstimate]) -> tuple[tuple[str, str, str], ...]:
    """Return name, value and interval of each figure."""
    return tuple(
        (
            figure.name,
            _format_like(figure.value, figure),
            NumberText(f"± {_format_like(figure.half_width, figure, 2)}")
            if np.isfinite(figure.half_width)
            else NO_VALUE,
        )
        for figure in figures
    )


def make_iso_rows(
    before: PositioningFigures | None,
    after: PositioningFigures | None,
    reached: PositioningFigures | None,
    unit: str,
) -> tuple[tuple[str, ...], ...]:
    """Return the rows of the ISO table below :data:`ISO_TABLE_HEADER`; none without figures."""
    columns = (before, after, reached)
    if all(figures is None for figures in columns):
        return ()
    return tuple(
        (
            title,
            *(
                NO_VALUE if figures is None else format_quantity(getattr(figures, name), unit)
                for figures in columns
            ),
        )
        for name, title in ISO_TITLES.items()
    )


def format_summary(calibration: SensorCalibration, wording: MessageWording | None = None) -> str:
    """Return a calibration as lines of text, by default in English."""
    wording = wording or MessageWording()
    unit = calibration.unit
    low, high = (format_exact(end, unit, size=calibration.travel[1]) for end in calibration.travel)
    rms_before, rms_after = (
        format_quantity(rms, unit) for rms in (calibration.before_rms, calibration.after_rms)
    )
    title = message("engine", "axis {axis}: {runs} runs from {low} to {high}").fill(
        axis=calibration.axis, runs=calibration.runs, low=low, high=high
    )
    errors = message(
        "engine", "error in the validation runs, rms: {before} before, {after} after"
    ).fill(before=rms_before, after=rms_after)
    iso = make_iso_rows(
        calibration.reading_before, calibration.reading_after, calibration.reached, unit
    )
    return "\n".join(
        [
            wording.format_message(title),
            *format_figure_lines(calibration.figures, wording),
            f"  {wording.format_message(errors)}",
            *format_iso_lines(iso, wording),
            *format_remark_lines(calibration.notes, calibration.refusal, wording),
        ]
    )


def format_figure_lines(
    figures: Iterable[SensorFigureEstimate], wording: MessageWording
) -> list[str]:
    """Return a line for each figure."""
    rows = [[wording.format_field(cell) for cell in row] for row in make_figure_rows(figures)]
    return [f"  {name:24}{value:>16} {interval}" for name, value, interval in rows]


def format_iso_lines(rows: tuple[tuple[str, ...], ...], wording: MessageWording) -> list[str]:
    """Return the lines of the ISO table with its header; none without rows."""
    cells = [
        [wording.format_field(cell) for cell in row]
        for row in ((ISO_TABLE_HEADER, *rows) if rows else ())
    ]
    return [
        f"  {title:26}{before:>18}{after:>18}{reached:>18}"
        for title, before, after, reached in cells
    ]


def format_remark_lines(
    notes: Iterable[str], refusal: str | None, wording: MessageWording
) -> list[str]:
    """Return a line for each note, and one for the refusal."""
    remarks = [message("engine", "note: {note}").fill(note=note) for note in notes]
    if refusal is not None:
        remarks.append(message("engine", "refused: {reason}").fill(reason=refusal))
    return [f"  {wording.format_message(remark)}" for remark in remarks]


def to_json(calibration: SensorCalibration) -> dict[str, Any]:
    """Return a calibration in a form that JSON can represent, in SI units."""
    iso = {
        "reading_before": calibration.reading_before,
        "reading_after": calibration.reading_after,
        "reached": calibration.reached,
    }
    return {
        "axis": calibration.axis,
        "unit": calibration.unit,
        "runs": calibration.runs,
        "travel": list(calibration.travel),
        "figures": {figure.name: _figure_to_json(figure) for figure in calibration.figures},
        "before_rms": calibration.before_rms,
        "after_rms": calibration.after_rms,
        "iso_230_2": {
            name: positioning._asdict()
            for name, positioning in iso.items()
            if positioning is not None
        },
        "notes": list(calibration.notes),
        "refused": calibration.refusal,
    }


def _figure_to_json(figure: SensorFigureEstimate) -> Mapping[str, float | str | None]:
    half_width = figure.half_width if np.isfinite(figure.half_width) else None
    return {"value": figure.value, "half_width": half_width, "unit": figure.unit}
