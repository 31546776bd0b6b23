"""Text of a calibration, for the command line and the panel."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from rotemina.sim.calibration.iso230 import Positioning
from rotemina.sim.calibration.sensor_calibration import Calibration, Figure
from rotemina.sim.messages import Wording, marked, message
from rotemina.sim.quantities import NOTHING, Number, amount, exact, rounded

ISO = {
    "accuracy": marked("engine", "A, accuracy"),
    "repeatability": marked("engine", "R, repeatability"),
    "repeatability_up": "R↑",
    "repeatability_down": "R↓",
    "reversal": marked("engine", "B, reversal value"),
    "mean_reversal": marked("engine", "B̄, mean reversal"),
    "systematic": marked("engine", "E, systematic deviation"),
    "mean_bidirectional": marked("engine", "M, mean bidirectional deviation"),
}
_LEAST_SHARE = 1e-3  # in %; below, in ppm
ISO_HEAD = (
    "ISO 230-2",
    marked("engine", "reading before"),
    marked("engine", "after"),
    marked("engine", "position reached"),
)


def figure_text(value: float, unit: str, *, size: float | None = None, digits: int = 4) -> str:
    """Return a figure with the unit that suits it; a relative one in % or ppm."""
    if unit != "1":
        return amount(value, unit, size=size, digits=digits)
    if abs(size or value) < _LEAST_SHARE:
        return Number(f"{rounded(1e6 * value, digits)} ppm")
    return Number(f"{rounded(100.0 * value, digits)} %")


def _like(value: float, figure: Figure, digits: int = 4) -> str:
    """Return a value in the unit that suits the figure or its interval, whichever is larger."""
    sizes = [abs(each) for each in (figure.value, figure.half_width) if np.isfinite(each)]
    return figure_text(value, figure.unit, size=max(sizes), digits=digits)


def figure_rows(figures: Iterable[Figure]) -> tuple[tuple[str, str, str], ...]:
    """Return name, value and interval of each figure."""
    return tuple(
        (
            each.name,
            _like(each.value, each),
            Number(f"± {_like(each.half_width, each, 2)}")
            if np.isfinite(each.half_width)
            else NOTHING,
        )
        for each in figures
    )


def iso_rows(
    before: Positioning | None, after: Positioning | None, reached: Positioning | None, unit: str
) -> tuple[tuple[str, ...], ...]:
    """Return the rows of the ISO table under :data:`ISO_HEAD`; none where there are no figures."""
    columns = (before, after, reached)
    if all(each is None for each in columns):
        return ()
    return tuple(
        (
            title,
            *(NOTHING if each is None else amount(getattr(each, name), unit) for each in columns),
        )
        for name, title in ISO.items()
    )


def summary(calibration: Calibration, wording: Wording | None = None) -> str:
    """Return a calibration as lines of text, by default in English."""
    wording = wording or Wording()
    unit = calibration.unit
    low, high = (exact(each, unit, size=calibration.travel[1]) for each in calibration.travel)
    before, after = (amount(rms, unit) for rms in (calibration.before_rms, calibration.after_rms))
    title = message("engine", "axis {axis}: {runs} runs from {low} to {high}").fill(
        axis=calibration.axis, runs=calibration.runs, low=low, high=high
    )
    errors = message(
        "engine", "error in the validation runs, rms: {before} before, {after} after"
    ).fill(before=before, after=after)
    iso = iso_rows(calibration.reading_before, calibration.reading_after, calibration.reached, unit)
    return "\n".join(
        [
            wording.of(title),
            *figure_lines(calibration.figures, wording),
            f"  {wording.of(errors)}",
            *iso_lines(iso, wording),
            *remark_lines(calibration.notes, calibration.refusal, wording),
        ]
    )


def figure_lines(figures: Iterable[Figure], wording: Wording) -> list[str]:
    """Return a line for each figure."""
    rows = [[wording.shown(cell) for cell in row] for row in figure_rows(figures)]
    return [f"  {name:24}{value:>16} {half}" for name, value, half in rows]


def iso_lines(rows: tuple[tuple[str, ...], ...], wording: Wording) -> list[str]:
    """Return the lines of the ISO table with its head; none without rows."""
    shown = [[wording.shown(cell) for cell in row] for row in ((ISO_HEAD, *rows) if rows else ())]
    return [f"  {a:26}{b:>18}{c:>18}{d:>18}" for a, b, c, d in shown]


def remark_lines(notes: Iterable[str], refusal: str | None, wording: Wording) -> list[str]:
    """Return a line for each note, and one for the refusal."""
    said = [message("engine", "note: {note}").fill(note=note) for note in notes]
    if refusal is not None:
        said.append(message("engine", "refused: {reason}").fill(reason=refusal))
    return [f"  {wording.of(one)}" for one in said]


def as_json(calibration: Calibration) -> dict[str, Any]:
    """Return a calibration as JSON can hold it, SI."""
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
        "figures": {each.name: _figure(each) for each in calibration.figures},
        "before_rms": calibration.before_rms,
        "after_rms": calibration.after_rms,
        "iso_230_2": {name: each._asdict() for name, each in iso.items() if each is not None},
        "notes": list(calibration.notes),
        "refused": calibration.refusal,
    }


def _figure(figure: Figure) -> Mapping[str, float | str | None]:
    half = figure.half_width if np.isfinite(figure.half_width) else None
    return {"value": figure.value, "half_width": half, "unit": figure.unit}
