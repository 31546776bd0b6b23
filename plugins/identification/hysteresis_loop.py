"""Hysteresis loop of output against input, with its width and area."""

from collections.abc import Callable

import numpy as np

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.findings import (
    AnalysisCurve,
    AnalysisFindings,
    AnalysisPicture,
    ExportColumn,
    FilledTemplate,
)
from rotemina.plugins.identification.nominal_response import (
    NO_NOMINAL_MODEL,
    simulate_nominal_signals,
)
from rotemina.plugins.identification.record_query import AnalysisQuestion
from rotemina.plugins.identification.step_statistics import (
    STATISTIC_HEADINGS,
    FigureStatistics,
    find_largest,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError, InsufficientExcitationError
from rotemina.sim.identification import (
    ExperimentSignals,
    HysteresisLoop,
    fit_amplitude_exponent,
    measure_loops,
)
from rotemina.sim.messages import format_rounded
from rotemina.sim.units import DisplayScale, choose_scale

# At most this many rows of a loop are drawn. More rows would fill the plot, and draw slowly.
_MAX_DRAWN_ROWS = 20_000

_MAX_CYCLES = 1000

# Reversals smaller than this fraction of the peak-to-peak value are noise.
_MIN_SWING_RATIO = 0.02

# If a cycle has fewer rows, lag and resonance widen the loop.
_MIN_ROWS_PER_CYCLE = 50
_PERCENT = DisplayScale("%", 1.0)


def analyse_loop(question: AnalysisQuestion) -> AnalysisFindings:
    """Measure every whole cycle of the input, and draw the loop even without such a cycle."""
    signals = question.signals()
    driven, answer = signals.require_single_pair()
    lag = question.lag_samples
    x, y = driven[: len(driven) - lag], answer[lag:]
    notices: list[str] = []
    cycles: tuple[HysteresisLoop, ...] = ()
    measured_rows = _count_measured_rows(driven)
    if measured_rows < len(driven):
        notices.append(
            FilledTemplate(
                mark(
                    "The figures use the first {n} of {rows} rows, with {turns} reversals: the "
                    "input is noise, or very long."
                ),
                n=measured_rows,
                rows=len(driven),
                turns=_MAX_CYCLES,
            )
        )
    try:
        cycles = measure_loops(
            driven[:measured_rows],
            answer[:measured_rows],
            lag_samples=lag,
            min_swing=_MIN_SWING_RATIO,
        )
    except InputError as error:
        notices.append(str(error))
    nominal: ExperimentSignals | None = None
    try:
        nominal = simulate_nominal_signals(question)
    except (InputError, KeyError) as error:
        notices.append(FilledTemplate(NO_NOMINAL_MODEL, reason=error))
    if len(x) > _MAX_DRAWN_ROWS:
        notices.append(
            FilledTemplate(
                mark("The plot shows the first {n} of {rows} rows; the figures use all rows."),
                n=_MAX_DRAWN_ROWS,
                rows=len(x),
            )
        )
    model_cycles = (
        _measure_model_cycles(nominal, measured_rows, lag) if nominal is not None and cycles else ()
    )
    figures, columns = _make_sheet(question, cycles, model_cycles) if cycles else ((), ())
    notices += _find_loop_notices(question, cycles)
    return AnalysisFindings(
        question,
        _make_pictures(question, x, y, nominal),
        STATISTIC_HEADINGS if cycles else (),
        figures,
        columns,
        tuple(notices),
    )


def _count_measured_rows(driven: FloatArray) -> int:
    """Return how many of the first rows to measure, so that this takes less than a second."""
    # The package is imported only here, because that is slow.
    from scipy.signal import find_peaks

    peak_rows, _ = find_peaks(driven, prominence=_MIN_SWING_RATIO * float(np.ptp(driven)))
    return int(peak_rows[_MAX_CYCLES]) if len(peak_rows) > _MAX_CYCLES else len(driven)


def _measure_model_cycles(
    nominal: ExperimentSignals, rows: int, lag: int
) -> tuple[HysteresisLoop, ...]:
    """Return the cycles of the model, which are none if its input has no whole cycle."""
    driven, answer = nominal.require_single_pair()
    try:
        return measure_loops(
            driven[:rows], answer[:rows], lag_samples=lag, min_swing=_MIN_SWING_RATIO
        )
    except InputError:
        return ()


def _make_pictures(
    question: AnalysisQuestion, x: FloatArray, y: FloatArray, nominal: ExperimentSignals | None
) -> tuple[AnalysisPicture, ...]:
    """Return pictures of the loop, and of its deviation from a straight line.

    The deviation makes a narrow loop visible. The lines for measurement and model are fitted
    separately, so that the picture compares their loops, and not their gains.
    """
    loops = [AnalysisCurve(mark("measured"), "real", x, y)]
    if nominal is not None:
        driven, answer = nominal.require_single_pair()
        model_x, model_y = driven[: len(x)], answer[len(answer) - len(x) :]
        loops.insert(0, AnalysisCurve(mark("model"), "model", model_x, model_y, width=3))
    loops = [
        curve._replace(x=curve.x[:_MAX_DRAWN_ROWS], y=curve.y[:_MAX_DRAWN_ROWS]) for curve in loops
    ]
    deviations = [curve._replace(y=_subtract_line(curve.x, curve.y)) for curve in loops]
    x_scale = choose_scale(question.unit(question.input_tap), float(np.abs(x).max(initial=0.0)))
    pictures = []
    for title, curves in (
        (str(question.output_tap), loops),
        (mark("deviation from a straight line"), deviations),
    ):
        largest = max(float(np.abs(curve.y).max(initial=0.0)) for curve in curves)
        y_scale = choose_scale(question.unit(question.output_tap), largest)
        pictures.append(
            AnalysisPicture(
                FilledTemplate(mark("{title} [{unit}]"), title=title, unit=y_scale.symbol),
                f"{question.input_tap} [{x_scale.symbol}]",
                tuple(
                    curve._replace(x=x_scale.per_si * curve.x, y=y_scale.per_si * curve.y)
                    for curve in curves
                ),
                in_time=False,
            )
        )
    return tuple(pictures)


def _subtract_line(x: FloatArray, y: FloatArray) -> FloatArray:
    columns = np.column_stack([x, np.ones_like(x)])
    line, *_ = np.linalg.lstsq(columns, y, rcond=None)
    return np.asarray(y - columns @ line)


def _make_sheet(
    question: AnalysisQuestion,
    cycles: tuple[HysteresisLoop, ...],
    model_cycles: tuple[HysteresisLoop, ...],
) -> tuple[tuple[tuple[str, ...], ...], tuple[ExportColumn, ...]]:
    output_unit, input_unit = question.unit(question.output_tap), question.unit(question.input_tap)

    def make_statistics(
        name: str, unit: str, read: Callable[[HysteresisLoop], float]
    ) -> FigureStatistics:
        values = [read(cycle) for cycle in cycles]
        return FigureStatistics(
            name,
            choose_scale(unit, find_largest(values)),
            values,
            [read(cycle) for cycle in model_cycles],
        )

    span = make_statistics(
        mark("input span"), input_unit, lambda cycle: cycle.input_high - cycle.input_low
    )
    stroke = make_statistics(mark("stroke"), output_unit, lambda cycle: cycle.stroke)
    width = make_statistics(mark("largest width"), output_unit, lambda cycle: cycle.width_max)
    mid_width = make_statistics(
        mark("width at mid-range"), output_unit, lambda cycle: cycle.width_mid
    )
    x_scale, y_scale = span.scale, stroke.scale
    area_symbol = (
        f"{y_scale.symbol}²" if x_scale == y_scale else f"{x_scale.symbol}·{y_scale.symbol}"
    )
    area_scale = DisplayScale(area_symbol, x_scale.per_si * y_scale.per_si)
    figures = (
        span,
        stroke,
        width,
        FigureStatistics(
            mark("width over stroke"),
            _PERCENT,
            [cycle.width_percent for cycle in cycles],
            [cycle.width_percent for cycle in model_cycles],
        ),
        mid_width._replace(scale=width.scale),
        make_statistics(mark("backlash width"), input_unit, lambda cycle: cycle.input_width_mid),
        FigureStatistics(
            mark("area"),
            area_scale,
            [cycle.area for cycle in cycles],
            [cycle.area for cycle in model_cycles],
        ),
    )
    exponent_row = (mark("width ∝ amplitude^p"), _format_exponent(cycles), "", "", "")
    rows = (
        (mark("cycles"), str(len(cycles)), "", "", ""),
        *(figure.make_row() for figure in figures),
        exponent_row,
    )
    return rows, tuple(figure.make_column() for figure in figures)


def _format_exponent(cycles: tuple[HysteresisLoop, ...]) -> str:
    """Return the exponent p as text, or a note if the cycles are too similar to determine it."""
    try:
        return f"p = {format_rounded(fit_amplitude_exponent(cycles), 3)}"
    except InsufficientExcitationError:
        return mark("too similar")


def _find_loop_notices(question: AnalysisQuestion, cycles: tuple[HysteresisLoop, ...]) -> list[str]:
    if not cycles:
        return []
    notices = []
    rows_per_cycle = float(np.median([cycle.rows[1] - cycle.rows[0] for cycle in cycles]))
    if rows_per_cycle < _MIN_ROWS_PER_CYCLE:
        notices.append(
            FilledTemplate(
                mark(
                    "A cycle has {rows:.0f} rows, fewer than {least}: lag and resonance cause "
                    "the loop. Drive slower cycles."
                ),
                rows=rows_per_cycle,
                least=_MIN_ROWS_PER_CYCLE,
            )
        )
    if np.median([cycle.width_max for cycle in cycles]) < 0.0:
        lag = question.lag_samples
        notices.append(
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
    return notices
