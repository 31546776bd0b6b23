"""Output over input: the loop, its width and area."""

from collections.abc import Callable

import numpy as np

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.filled_template import FilledTemplate
from rotemina.plugins.identification.findings import Column, Curve, Findings, Picture
from rotemina.plugins.identification.nominal_response import ABSENT, nominal_signals
from rotemina.plugins.identification.record_query import Question
from rotemina.plugins.identification.step_statistics import HEAD, Figure, largest
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.identification.errors import ExcitationError
from rotemina.sim.identification.experiment_signals import Signals
from rotemina.sim.identification.loop_figures import Loop, amplitude_exponent, loops
from rotemina.sim.quantities import Scale, rounded, scale_of

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
            FilledTemplate(
                mark(
                    "The figures use the first {n} of {rows} rows, with {turns} reversals: the "
                    "input is noise, or very long."
                ),
                n=rows,
                rows=len(driven),
                turns=_MOST_CYCLES,
            )
        )
    try:
        found = loops(driven[:rows], answer[:rows], lag_samples=lag, least_swing=_LEAST_SWING)
    except InputError as error:
        notices.append(str(error))
    nominal: Signals | None = None
    try:
        nominal = nominal_signals(question)
    except (InputError, KeyError) as error:
        notices.append(FilledTemplate(ABSENT, reason=error))
    if len(x) > _MOST_DRAWN:
        notices.append(
            FilledTemplate(
                mark("The plot shows the first {n} of {rows} rows; the figures use all rows."),
                n=_MOST_DRAWN,
                rows=len(x),
            )
        )
    beside = _modelled(nominal, rows, lag) if nominal is not None and found else ()
    figures, columns = _sheet(question, found, beside) if found else ((), ())
    notices += _doubts(question, found)
    return Findings(
        question,
        _pictures(question, x, y, nominal),
        HEAD if found else (),
        figures,
        columns,
        tuple(notices),
    )


def _rows_measured(driven: FloatArray) -> int:
    """Return how many rows hold no more cycles than can be measured within a second."""
    from scipy.signal import find_peaks  # takes its time to import

    highs, _ = find_peaks(driven, prominence=_LEAST_SWING * float(np.ptp(driven)))
    return int(highs[_MOST_CYCLES]) if len(highs) > _MOST_CYCLES else len(driven)


def _modelled(nominal: Signals, rows: int, lag: int) -> tuple[Loop, ...]:
    """Return the model's cycles; none where it makes none of a measured input."""
    driven, answer = nominal.single()
    try:
        return loops(driven[:rows], answer[:rows], lag_samples=lag, least_swing=_LEAST_SWING)
    except InputError:
        return ()


def _pictures(
    question: Question, x: FloatArray, y: FloatArray, nominal: Signals | None
) -> tuple[Picture, ...]:
    """Return the loop, and how far it is off a straight line: there a narrow one can be seen.

    Each is off its own line, so that loops are compared and not gains.
    """
    drawn = [(mark("measured"), "real", x, y, 1)]
    if nominal is not None:
        driven, answer = nominal.single()
        drawn.insert(
            0, (mark("model"), mark("model"), driven[: len(x)], answer[len(answer) - len(x) :], 3)
        )
    drawn = [(name, role, u[:_MOST_DRAWN], v[:_MOST_DRAWN], w) for name, role, u, v, w in drawn]
    off = [(name, role, u, _off_line(u, v), w) for name, role, u, v, w in drawn]
    across = scale_of(question.unit(question.drive), float(np.abs(x).max(initial=0.0)))
    pictures = []
    for title, curves in (
        (str(question.answer), drawn),
        (mark("deviation from a straight line"), off),
    ):
        size = max(float(np.abs(v).max(initial=0.0)) for _, _, _, v, _ in curves)
        up = scale_of(question.unit(question.answer), size)
        pictures.append(
            Picture(
                FilledTemplate(mark("{title} [{unit}]"), title=title, unit=up.symbol),
                f"{question.drive} [{across.symbol}]",
                tuple(
                    Curve(name, role, across.per_si * u, up.per_si * v, width)
                    for name, role, u, v, width in curves
                ),
                in_time=False,
            )
        )
    return tuple(pictures)


def _off_line(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return y (n,) without its least-squares line over x (n,)."""
    columns = np.column_stack([x, np.ones_like(x)])
    line, *_ = np.linalg.lstsq(columns, y, rcond=None)
    return np.asarray(y - columns @ line)


def _sheet(
    question: Question, found: tuple[Loop, ...], beside: tuple[Loop, ...]
) -> tuple[tuple[tuple[str, ...], ...], tuple[Column, ...]]:
    over, under = question.unit(question.answer), question.unit(question.drive)

    def figure(name: str, unit: str, read: Callable[[Loop], float]) -> Figure:
        values = [read(each) for each in found]
        return Figure(name, scale_of(unit, largest(values)), values, [read(e) for e in beside])

    span = figure(mark("input span"), under, lambda each: each.input_high - each.input_low)
    stroke = figure(mark("stroke"), over, lambda each: each.stroke)
    width = figure(mark("largest width"), over, lambda each: each.width_max)
    middle = figure(mark("width at mid-range"), over, lambda each: each.width_mid)
    across, up = span.scale, stroke.scale
    both = f"{up.symbol}²" if across == up else f"{across.symbol}·{up.symbol}"
    area = Scale(both, across.per_si * up.per_si)
    figures = (
        span,
        stroke,
        width,
        Figure(
            mark("width over stroke"),
            _PERCENT,
            [each.width_percent for each in found],
            [each.width_percent for each in beside],
        ),
        middle._replace(scale=width.scale),
        figure(mark("backlash width"), under, lambda each: each.input_width_mid),
        Figure(mark("area"), area, [each.area for each in found], [each.area for each in beside]),
    )
    exponent = (mark("width ∝ amplitude^p"), _exponent(found), "", "", "")
    rows = (
        (mark("cycles"), str(len(found)), "", "", ""),
        *(each.row() for each in figures),
        exponent,
    )
    return rows, tuple(each.column() for each in figures)


def _exponent(found: tuple[Loop, ...]) -> str:
    """Return p, or nothing where the cycles are too alike to tell it."""
    try:
        return f"p = {rounded(amplitude_exponent(found), 3)}"
    except ExcitationError:
        return mark("too similar")


def _doubts(question: Question, found: tuple[Loop, ...]) -> list[str]:
    if not found:
        return []
    doubts = []
    rows = float(np.median([each.rows[1] - each.rows[0] for each in found]))
    if rows < _SLOW:
        doubts.append(
            FilledTemplate(
                mark(
                    "A cycle has {rows:.0f} rows, fewer than {least}: lag and resonance cause "
                    "the loop. Drive slower cycles."
                ),
                rows=rows,
                least=_SLOW,
            )
        )
    if np.median([each.width_max for each in found]) < 0.0:
        lag = question.lag_samples
        doubts.append(
            FilledTemplate(
                mark(
                    "The width is negative: the output leads, or the axis lags less than the "
                    "{lag} sample subtracted for a stepwise command. Drive slower cycles."
                ),
                lag=lag,
            )
            if lag
            else mark("The width is negative: the output leads the input.")
        )
    return doubts
