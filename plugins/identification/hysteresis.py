"""Output over input: the loop that it draws, its width and area."""

import numpy as np

from rotemina.plugins.identification.findings import (
    Column,
    Curve,
    Findings,
    Picture,
    Scale,
    scale_of,
)
from rotemina.plugins.identification.question import Question
from rotemina.plugins.identification.statistics import HEAD, Figure, largest
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.identification.errors import ExcitationError
from rotemina.sim.identification.loop import Loop, amplitude_exponent, loops

_MOST_DRAWN = 20_000  # rows; more of a loop is a blot, and slow
_MOST_CYCLES = 1000
_LEAST_SWING = 0.02  # of the peak-to-peak: smaller reversals are noise
_SLOW = 50  # rows a cycle
_PERCENT = Scale("%", 1.0)


def loop_findings(question: Question) -> Findings:
    """Measure every whole cycle of the input; the drawing is there even without one."""
    signals = question.signals()
    driven, answer = signals.single()
    lag = question.lag_samples
    x, y = driven[: len(driven) - lag], answer[lag:]
    notices: list[str] = []
    found: tuple[Loop, ...] = ()
    rows = _rows_measured(driven)
    if rows < len(driven):
        notices.append(
            f"Measured are the cycles of the first {rows} of {len(driven)} rows, which turn "
            f"{_MOST_CYCLES} times: the input is noise or very long."
        )
    try:
        found = loops(driven[:rows], answer[:rows], lag_samples=lag, least_swing=_LEAST_SWING)
    except InputError as error:
        notices.append(str(error))
    if len(x) > _MOST_DRAWN:
        notices.append(
            f"Drawn are the first {_MOST_DRAWN} of {len(x)} rows; the figures are not cut there."
        )
    rows, columns = _sheet(question, found) if found else ((), ())
    notices += _doubts(question, found)
    return Findings(
        question,
        _pictures(question, x, y),
        HEAD if found else (),
        rows,
        columns,
        tuple(notices),
    )


def _rows_measured(driven: FloatArray) -> int:
    """Return how many rows hold no more cycles than can be measured within a second."""
    from scipy.signal import find_peaks  # takes its time to import

    highs, _ = find_peaks(driven, prominence=_LEAST_SWING * float(np.ptp(driven)))
    return int(highs[_MOST_CYCLES]) if len(highs) > _MOST_CYCLES else len(driven)


def _pictures(question: Question, x: FloatArray, y: FloatArray) -> tuple[Picture, ...]:
    """Return the loop, and how far it is off a straight line: there a narrow one can be seen."""
    x, y = x[:_MOST_DRAWN], y[:_MOST_DRAWN]
    columns = np.column_stack([x, np.ones_like(x)])
    line, *_ = np.linalg.lstsq(columns, y, rcond=None)
    off = y - columns @ line
    across = scale_of(question.unit(question.drive), float(np.abs(x).max(initial=0.0)))
    pictures = []
    for name, values in ((str(question.answer), y), ("off a straight line", off)):
        up = scale_of(question.unit(question.answer), float(np.abs(values).max(initial=0.0)))
        curve = Curve("measured", "real", across.per_si * x, up.per_si * values)
        title, bottom = f"{name} [{up.symbol}]", f"{question.drive} [{across.symbol}]"
        pictures.append(Picture(title, bottom, (curve,), in_time=False))
    return tuple(pictures)


def _sheet(
    question: Question, found: tuple[Loop, ...]
) -> tuple[tuple[tuple[str, ...], ...], tuple[Column, ...]]:
    spans = [each.input_high - each.input_low for each in found]
    across = scale_of(question.unit(question.drive), max(spans))
    up = scale_of(question.unit(question.answer), largest([each.stroke for each in found]))
    fine = scale_of(question.unit(question.answer), largest([each.width_max for each in found]))
    play = scale_of(
        question.unit(question.drive), largest([each.input_width_mid for each in found])
    )
    area = Scale(f"{across.symbol}·{up.symbol}", across.per_si * up.per_si)
    figures = (
        Figure("input span", across, spans),
        Figure("stroke", up, [each.stroke for each in found]),
        Figure("largest width", fine, [each.width_max for each in found]),
        Figure("width over stroke", _PERCENT, [each.width_percent for each in found]),
        Figure("width at the middle", fine, [each.width_mid for each in found]),
        Figure("play across", play, [each.input_width_mid for each in found]),
        Figure("area", area, [each.area for each in found]),
    )
    words = ("cycles", str(len(found)), "", ""), ("width ∝ amplitude^p", _exponent(found), "", "")
    rows = (words[0], *(figure.row() for figure in figures), words[1])
    return rows, tuple(figure.column() for figure in figures)


def _exponent(found: tuple[Loop, ...]) -> str:
    """Return p, or nothing where the cycles are too alike to tell it."""
    try:
        return f"p = {amplitude_exponent(found):.3g}"
    except ExcitationError:
        return "cycles too alike"


def _doubts(question: Question, found: tuple[Loop, ...]) -> list[str]:
    if not found:
        return []
    doubts = []
    rows = float(np.median([each.rows[1] - each.rows[0] for each in found]))
    if rows < _SLOW:
        doubts.append(
            f"A cycle has {rows:.0f} rows, fewer than {_SLOW}: the loop is that of lag and "
            "resonance; drive slower cycles."
        )
    if np.median([each.width_max for each in found]) < 0.0:
        lag = question.lag_samples
        doubts.append(
            f"Width below 0: the output leads, or the {lag} sample of lag that is taken out for a "
            "held command is more than the axis has; drive slower cycles."
            if lag
            else "Width below 0: the output leads the input."
        )
    return doubts
