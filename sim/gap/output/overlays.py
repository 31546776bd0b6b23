"""Drawings of signals: the gap over time and over the command, and the frequency response."""

from collections.abc import Callable, Sequence

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rotemina.sim.arrays import (
    BoolArray,
    ComplexArray,
    FloatArray,
    IntArray,
    decimate_to_envelope,
)
from rotemina.sim.errors import TimeGridError
from rotemina.sim.gap.output.charts import set_log_scale
from rotemina.sim.gap.output.report_words import localize_text
from rotemina.sim.gap.output.svg_pictures import ColourRole, add_legend, draw_picture
from rotemina.sim.gap.output.traces import GapTrace
from rotemina.sim.identification import (
    ExperimentSignals,
    FrequencyResponse,
    estimate_welch_response,
    find_uniform_rate,
)
from rotemina.sim.messages import format_rounded, marked
from rotemina.sim.units import DisplayScale, choose_scale

_WIDTH_IN = 12.0
_ROW_HEIGHT_IN = 2.1
# A path is thinned to about one point in each cell of a grid with this many cells per side.
_CELLS_PER_SIDE = 300
# A path in a plane has this many points for each bucket of a curve over time.
PATH_POINTS_PER_BUCKET = 4
# The drawing of a record has this many points for each bucket: two curves and five paths.
POINTS_PER_BUCKET = 2 * 2 + 5 * PATH_POINTS_PER_BUCKET
# A record is split into this many segments for its frequency response.
_SEGMENTS_PER_RECORD = 6
_MAX_SEGMENT_ROWS = 8192
# A frequency line is used if its input amplitude is at least this fraction of the largest one.
_MIN_EXCITATION_RATIO = 1e-3
# A frequency line is drawn if it has at least this coherence.
_MIN_COHERENCE = 0.5
_GAP_LABEL = marked("gap", "gap [{unit}]")
_SIGNAL_STYLES = (
    (marked("gap", "real"), ColourRole.REAL, 2.6),
    (marked("gap", "model"), ColourRole.RAW, 1.0),
    (marked("gap", "corrected"), ColourRole.CORRECTED, 1.0),
)


def draw_signals(traces: Sequence[GapTrace], buckets: int) -> Markup:
    """Draw records of one axis at one tap: gap over time, signals over command, gap over command.

    Each curve over time has this many ``buckets``. For each bucket, the drawing of a record has
    ``POINTS_PER_BUCKET`` points.
    """
    first_trace = traces[0]
    reading_scale = choose_scale(
        first_trace.unit, max(float(np.abs(trace.real).max()) for trace in traces)
    )
    gap_scale = choose_scale(
        first_trace.unit, max(float(np.abs(trace.gap_before).max()) for trace in traces)
    )
    command_scale = _find_command_scale(traces)

    def draw(figure: Figure) -> None:
        grid = figure.subplots(len(traces), 3, squeeze=False, width_ratios=(2.0, 1.0, 1.0))
        for (time_axes, loop_axes, gap_axes), trace in zip(grid, traces, strict=True):
            _draw_gap(time_axes, trace, gap_scale, buckets)
            _draw_loop(
                loop_axes, trace, command_scale, reading_scale, PATH_POINTS_PER_BUCKET * buckets
            )
            _draw_gap_over_command(
                gap_axes, trace, command_scale, gap_scale, PATH_POINTS_PER_BUCKET * buckets
            )
            time_axes.set_ylabel(localize_text(_GAP_LABEL, unit=gap_scale.symbol))
            time_axes.set_title(
                localize_text(marked("gap", "record {number}"), number=trace.number + 1)
            )
            loop_axes.set_ylabel(f"{trace.tap} [{reading_scale.symbol}]")
            gap_axes.set_ylabel(localize_text(_GAP_LABEL, unit=gap_scale.symbol))
        grid[-1][0].set_xlabel(localize_text(marked("gap", "time [s]")))
        for axes in grid[-1][1:]:
            axes.set_xlabel(
                localize_text(marked("gap", "command [{unit}]"), unit=command_scale.symbol)
            )
        add_legend(figure, grid[0][1])

    numbers = ", ".join(str(trace.number + 1) for trace in traces)
    about = localize_text(
        marked(
            "gap",
            "Gap before and after over time, reading over command and gap over command, of the "
            "records {numbers} at {tap}",
        ),
        numbers=numbers,
        tap=first_trace.tap,
    )
    return draw_picture(_WIDTH_IN, 0.7 + _ROW_HEIGHT_IN * len(traces), draw, about)


def draw_frequency_response(traces: Sequence[GapTrace]) -> Markup:
    """Draw the response from command to a tap: real, model and corrected model.

    The records are averaged. If they differ in rate, only the rate with most data is used.

    Raises
    ------
    IdentificationError
        If no record is sampled evenly and moves enough.
    """
    traces_of_one_rate = _select_main_rate(traces)
    shortest = min(len(trace.real) for trace in traces_of_one_rate)
    segment = min(2 * shortest // (_SEGMENTS_PER_RECORD + 1), _MAX_SEGMENT_ROWS)
    estimate = estimate_welch_response(
        *map(_make_signals, traces_of_one_rate),
        segment=segment,
        excited_above=_MIN_EXCITATION_RATIO,
    )
    is_coherent = estimate.coherence[:, 0] >= _MIN_COHERENCE
    unit_text = (
        ""
        if traces_of_one_rate[0].unit != "V"
        else f" [V/{traces_of_one_rate[0].record.units[traces_of_one_rate[0].axis]}]"
    )

    def draw(figure: Figure) -> None:
        magnitude, phase = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 2.0))
        _draw_response(magnitude, estimate, is_coherent, np.abs)
        _draw_response(phase, estimate, is_coherent, _compute_phase_degrees)
        _draw_uncertainty(magnitude, estimate, is_coherent)
        set_log_scale(magnitude, "x")
        set_log_scale(magnitude, "y")
        magnitude.set_ylabel(
            f"|{traces_of_one_rate[0].tap}/{localize_text(marked('gap', 'command'))}|{unit_text}"
        )
        phase.set_ylabel(localize_text(marked("gap", "phase [°]")))
        phase.set_xlabel(localize_text(marked("gap", "frequency [Hz]")))
        add_legend(figure, magnitude)

    about = localize_text(
        marked("gap", "Frequency response from command to {tap}: real, model, corrected model"),
        tap=traces_of_one_rate[0].tap,
    )
    return draw_picture(_WIDTH_IN, 4.4, draw, about)


def _list_signals(trace: GapTrace) -> list[tuple[FloatArray, tuple[str, ColourRole, float]]]:
    """Return the measurement and the responses of the models, each with its style.

    The corrected model is omitted if it does not differ from the original one.
    """
    signals = (trace.real, trace.raw, *((trace.corrected,) if trace.is_corrected else ()))
    return list(zip(signals, _SIGNAL_STYLES, strict=False))


def _list_gaps(trace: GapTrace) -> list[tuple[FloatArray, ColourRole]]:
    gap_after = [(trace.gap_after, ColourRole.CORRECTED)] if trace.is_corrected else []
    return [(trace.gap_before, ColourRole.RAW), *gap_after]


def _draw_gap(axes: Axes, trace: GapTrace, gap_scale: DisplayScale, buckets: int) -> None:
    floor = trace.floor * gap_scale.per_si
    axes.axhspan(-floor, floor, color=ColourRole.FLOOR, alpha=0.25, linewidth=0.0)
    for values, role in _list_gaps(trace):
        axes.plot(
            *decimate_to_envelope(trace.time_s, gap_scale(values), buckets),
            color=role,
            linewidth=0.8,
        )
    axes.margins(x=0.0)


def _draw_loop(
    axes: Axes,
    trace: GapTrace,
    command_scale: DisplayScale,
    reading_scale: DisplayScale,
    max_points: int,
) -> None:
    for values, (name, role, width) in _list_signals(trace):
        x, y = thin_path(command_scale(trace.command), reading_scale(values), max_points)
        axes.plot(x, y, color=role, linewidth=width, label=localize_text(name))


def _draw_gap_over_command(
    axes: Axes,
    trace: GapTrace,
    command_scale: DisplayScale,
    gap_scale: DisplayScale,
    max_points: int,
) -> None:
    for values, role in _list_gaps(trace):
        axes.plot(
            *thin_path(command_scale(trace.command), gap_scale(values), max_points),
            color=role,
            linewidth=0.7,
        )


def _draw_response(
    axes: Axes,
    estimate: FrequencyResponse,
    is_coherent: BoolArray,
    quantity: Callable[[ComplexArray], FloatArray],
) -> None:
    for column, (name, role, width) in enumerate(_SIGNAL_STYLES[: estimate.response.shape[1]]):
        values = quantity(estimate.response[is_coherent, column, 0])
        line = _break_at_missing_lines(estimate.frequency_hz[is_coherent], values)
        axes.plot(
            *line, ".-", color=role, linewidth=width, markersize=3.0, label=localize_text(name)
        )


def _draw_uncertainty(axes: Axes, estimate: FrequencyResponse, is_coherent: BoolArray) -> None:
    """Draw the 95 % confidence band of the real response."""
    middle = estimate.magnitude[is_coherent, 0, 0]
    radius = estimate.confidence_radius()[is_coherent, 0, 0]
    frequency_hz, low = _break_at_missing_lines(
        estimate.frequency_hz[is_coherent], np.maximum(middle - radius, 0.1 * middle)
    )
    _, high = _break_at_missing_lines(estimate.frequency_hz[is_coherent], middle + radius)
    axes.fill_between(frequency_hz, low, high, color=ColourRole.REAL, alpha=0.2, linewidth=0.0)


def _break_at_missing_lines(
    frequency_hz: FloatArray, values: FloatArray
) -> tuple[FloatArray, FloatArray]:
    steps = np.diff(frequency_hz)
    if not len(steps):
        return frequency_hz, values
    breaks = np.flatnonzero(steps > 1.5 * float(steps.min())) + 1
    return np.insert(frequency_hz, breaks, np.nan), np.insert(values, breaks, np.nan)


def thin_path(x: FloatArray, y: FloatArray, max_points: int) -> tuple[FloatArray, FloatArray]:
    """Thin a path in a plane to the points at which it enters a new small cell.

    At most ``max_points`` of these points and the last point remain.
    """
    cells = [_number_cells(x), _number_cells(y)]
    is_kept = np.zeros(len(x), dtype=np.bool_)
    is_kept[[0, -1]] = True
    for cell in cells:
        is_kept[1:] |= np.diff(cell) != 0
    rows = np.flatnonzero(is_kept)
    rows = np.append(rows[:-1][:: max(-(-len(rows) // max_points), 1)], rows[-1])
    return x[rows], y[rows]


def _number_cells(values: FloatArray) -> IntArray:
    low, span = float(values.min()), float(np.ptp(values))
    return np.asarray((values - low) / (span or 1.0) * _CELLS_PER_SIDE, dtype=np.int64)


def _find_command_scale(traces: Sequence[GapTrace]) -> DisplayScale:
    unit = traces[0].record.units[traces[0].axis]
    return choose_scale(unit, max(float(np.abs(trace.command).max()) for trace in traces))


def _compute_phase_degrees(response: ComplexArray) -> FloatArray:
    return np.degrees(np.unwrap(np.angle(response)))


def _select_main_rate(traces: Sequence[GapTrace]) -> list[GapTrace]:
    traces_by_rate: dict[str, list[GapTrace]] = {}
    for trace in traces:
        try:
            rate_hz = find_uniform_rate(trace.record.time_s)
        except TimeGridError as error:
            grid_error = error
            continue
        traces_by_rate.setdefault(format_rounded(rate_hz), []).append(trace)
    if not traces_by_rate:
        raise grid_error
    return max(
        traces_by_rate.values(),
        key=lambda traces_of_one_rate: sum(len(trace.real) for trace in traces_of_one_rate),
    )


def _make_signals(trace: GapTrace) -> ExperimentSignals:
    signals = _list_signals(trace)
    return ExperimentSignals(
        find_uniform_rate(trace.record.time_s),
        trace.command[:, None],
        np.column_stack([values for values, _ in signals]),
        ("command",),
        tuple(name for _, (name, _, _) in signals),
        (trace.record.units[trace.axis],),
        (trace.unit,) * len(signals),
    )
