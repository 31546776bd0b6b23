"""Drawings of signals: the gap over time and over the command, and in frequency."""

from collections.abc import Callable, Sequence

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rotemina.sim.arrays import BoolArray, ComplexArray, FloatArray, IntArray
from rotemina.sim.decimation import envelope
from rotemina.sim.gap.output.report.charts import plain_logarithm
from rotemina.sim.gap.output.report.pictures import Role, legend, picture
from rotemina.sim.gap.output.report.traces import Trace
from rotemina.sim.gap.output.report.words import said
from rotemina.sim.identification.errors import TimeGridError
from rotemina.sim.identification.experiment_signals import Signals, uniform_rate
from rotemina.sim.identification.frequency_response import FrequencyResponse
from rotemina.sim.identification.welch import welch_response
from rotemina.sim.messages import marked
from rotemina.sim.quantities import Scale, rounded, scale_of

_WIDTH = 12.0
_ROW = 2.1
_CELLS = 300  # in each direction, in which a path is drawn
PATH_POINTS = 4  # of a path in a plane, for each bucket of a curve over time
POINTS = 2 * 2 + 5 * PATH_POINTS  # of one record, for each bucket: two curves and five paths
_SEGMENTS = 6  # of a record, for its frequency response
_LONGEST = 8192
_EXCITED = 1e-3  # of the largest input amplitude, from which a line is drawn
_COHERENT = 0.5  # share of the output that must answer the command, for a line to be drawn
_GAP = marked("gap", "gap [{unit}]")
_ANSWERS = (
    (marked("gap", "real"), Role.REAL, 2.6),
    (marked("gap", "model"), Role.RAW, 1.0),
    (marked("gap", "corrected"), Role.CORRECTED, 1.0),
)


def signals(traces: Sequence[Trace], buckets: int) -> Markup:
    """Draw records of one axis at one tap: gap over time, loop, and gap over command.

    Each curve over time has ``buckets``, and each record ``POINTS`` points for each of them.
    """
    first = traces[0]
    answer = scale_of(first.unit, max(float(np.abs(trace.real).max()) for trace in traces))
    gap = scale_of(first.unit, max(float(np.abs(trace.before).max()) for trace in traces))
    command = _command_scale(traces)

    def draw(figure: Figure) -> None:
        grid = figure.subplots(len(traces), 3, squeeze=False, width_ratios=(2.0, 1.0, 1.0))
        for (time, loop, left), trace in zip(grid, traces, strict=True):
            _draw_gap(time, trace, gap, buckets)
            _draw_loop(loop, trace, command, answer, PATH_POINTS * buckets)
            _draw_left(left, trace, command, gap, PATH_POINTS * buckets)
            time.set_ylabel(said(_GAP, unit=gap.symbol))
            time.set_title(said(marked("gap", "record {number}"), number=trace.number + 1))
            loop.set_ylabel(f"{trace.tap} [{answer.symbol}]")
            left.set_ylabel(said(_GAP, unit=gap.symbol))
        grid[-1][0].set_xlabel(said(marked("gap", "time [s]")))
        for axes in grid[-1][1:]:
            axes.set_xlabel(said(marked("gap", "command [{unit}]"), unit=command.symbol))
        legend(figure, grid[0][1])

    numbers = ", ".join(str(trace.number + 1) for trace in traces)
    about = said(
        marked(
            "gap",
            "Gap before and after over time, reading over command and gap over command, of the "
            "records {numbers} at {tap}",
        ),
        numbers=numbers,
        tap=first.tap,
    )
    return picture(_WIDTH, 0.7 + _ROW * len(traces), draw, about)


def frequency_response(traces: Sequence[Trace]) -> Markup:
    """Draw the response from command to a tap: real, model and corrected model.

    Records of the rate that has most data are averaged together.

    Raises
    ------
    IdentificationError
        If no record is sampled evenly and moves enough.
    """
    together = _of_one_rate(traces)
    shortest = min(len(trace.real) for trace in together)
    segment = min(2 * shortest // (_SEGMENTS + 1), _LONGEST)
    found = welch_response(*map(_signals, together), segment=segment, excited_above=_EXCITED)
    sure = found.coherence[:, 0] >= _COHERENT
    ratio = "" if together[0].unit != "V" else f" [V/{together[0].record.units[together[0].axis]}]"

    def draw(figure: Figure) -> None:
        size, phase = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 2.0))
        _draw_response(size, found, sure, np.abs)
        _draw_response(phase, found, sure, _degrees)
        _draw_uncertainty(size, found, sure)
        plain_logarithm(size, "x")
        plain_logarithm(size, "y")
        size.set_ylabel(f"|{together[0].tap}/{said(marked('gap', 'command'))}|{ratio}")
        phase.set_ylabel(said(marked("gap", "phase [°]")))
        phase.set_xlabel(said(marked("gap", "frequency [Hz]")))
        legend(figure, size)

    about = said(
        marked("gap", "Frequency response from command to {tap}: real, model, corrected model"),
        tap=together[0].tap,
    )
    return picture(_WIDTH, 4.4, draw, about)


def _answers(trace: Trace) -> list[tuple[FloatArray, tuple[str, Role, float]]]:
    """Return the measurement and the answers of the models, without an empty correction."""
    signals = (trace.real, trace.raw, *((trace.corrected,) if trace.changed else ()))
    return list(zip(signals, _ANSWERS, strict=False))


def _gaps(trace: Trace) -> list[tuple[FloatArray, Role]]:
    after = [(trace.after, Role.CORRECTED)] if trace.changed else []
    return [(trace.before, Role.RAW), *after]


def _draw_gap(axes: Axes, trace: Trace, gap: Scale, buckets: int) -> None:
    floor = trace.floor * gap.per_si
    axes.axhspan(-floor, floor, color=Role.FLOOR, alpha=0.25, linewidth=0.0)
    for values, role in _gaps(trace):
        axes.plot(*envelope(trace.time_s, gap(values), buckets), color=role, linewidth=0.8)
    axes.margins(x=0.0)


def _draw_loop(axes: Axes, trace: Trace, command: Scale, answer: Scale, most: int) -> None:
    for values, (name, role, width) in _answers(trace):
        across, up = path(command(trace.command), answer(values), most)
        axes.plot(across, up, color=role, linewidth=width, label=said(name))


def _draw_left(axes: Axes, trace: Trace, command: Scale, gap: Scale, most: int) -> None:
    for values, role in _gaps(trace):
        axes.plot(*path(command(trace.command), gap(values), most), color=role, linewidth=0.7)


def _draw_response(
    axes: Axes,
    found: FrequencyResponse,
    sure: BoolArray,
    of: Callable[[ComplexArray], FloatArray],
) -> None:
    for column, (name, role, width) in enumerate(_ANSWERS[: found.response.shape[1]]):
        values = of(found.response[sure, column, 0])
        line = _torn(found.frequency_hz[sure], values)
        axes.plot(*line, ".-", color=role, linewidth=width, markersize=3.0, label=said(name))


def _draw_uncertainty(axes: Axes, found: FrequencyResponse, sure: BoolArray) -> None:
    """Draw the band that holds the real response with 95 %."""
    middle = found.magnitude[sure, 0, 0]
    radius = found.confidence_radius()[sure, 0, 0]
    frequency_hz, low = _torn(found.frequency_hz[sure], np.maximum(middle - radius, 0.1 * middle))
    _, high = _torn(found.frequency_hz[sure], middle + radius)
    axes.fill_between(frequency_hz, low, high, color=Role.REAL, alpha=0.2, linewidth=0.0)


def _torn(frequency_hz: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return a curve (n,) that is interrupted where lines are missing."""
    steps = np.diff(frequency_hz)
    if not len(steps):
        return frequency_hz, values
    torn = np.flatnonzero(steps > 1.5 * float(steps.min())) + 1
    return np.insert(frequency_hz, torn, np.nan), np.insert(values, torn, np.nan)


def path(across: FloatArray, up: FloatArray, most: int) -> tuple[FloatArray, FloatArray]:
    """Thin a path in a plane, both (n,), to where it comes from one small cell into another.

    Of these, ``most`` points at most are left, and the last.
    """
    cells = [_cells(across), _cells(up)]
    kept = np.zeros(len(across), dtype=np.bool_)
    kept[[0, -1]] = True
    for cell in cells:
        kept[1:] |= np.diff(cell) != 0
    rows = np.flatnonzero(kept)
    rows = np.append(rows[:-1][:: max(-(-len(rows) // most), 1)], rows[-1])
    return across[rows], up[rows]


def _cells(values: FloatArray) -> IntArray:
    low, span = float(values.min()), float(np.ptp(values))
    return np.asarray((values - low) / (span or 1.0) * _CELLS, dtype=np.int64)


def _command_scale(traces: Sequence[Trace]) -> Scale:
    unit = traces[0].record.units[traces[0].axis]
    return scale_of(unit, max(float(np.abs(trace.command).max()) for trace in traces))


def _degrees(response: ComplexArray) -> FloatArray:
    return np.degrees(np.unwrap(np.angle(response)))


def _of_one_rate(traces: Sequence[Trace]) -> list[Trace]:
    by_rate: dict[str, list[Trace]] = {}
    for trace in traces:
        try:
            rate_hz = uniform_rate(trace.record.time_s)
        except TimeGridError as error:
            uneven = error
            continue
        by_rate.setdefault(rounded(rate_hz), []).append(trace)
    if not by_rate:
        raise uneven
    return max(by_rate.values(), key=lambda group: sum(len(trace.real) for trace in group))


def _signals(trace: Trace) -> Signals:
    answers = _answers(trace)
    return Signals(
        uniform_rate(trace.record.time_s),
        trace.command[:, None],
        np.column_stack([values for values, _ in answers]),
        ("command",),
        tuple(name for _, (name, _, _) in answers),
        (trace.record.units[trace.axis],),
        (trace.unit,) * len(answers),
    )
