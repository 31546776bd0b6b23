"""Step responses of a record: rise time, overshoot, settling time and static gain."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.findings import (
    AnalysisCurve,
    AnalysisFindings,
    AnalysisPicture,
    FilledTemplate,
    make_ratio_scale,
)
from rotemina.plugins.identification.nominal_response import (
    NO_NOMINAL_MODEL,
    simulate_nominal_record,
)
from rotemina.plugins.identification.record_query import AnalysisQuestion
from rotemina.plugins.identification.step_statistics import (
    STATISTIC_HEADINGS,
    FigureStatistics,
    find_largest,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.identification import StepMetrics, measure_steps
from rotemina.sim.records import (
    Record,
    RecordChannel,
    Tap,
)
from rotemina.sim.units import DisplayScale, choose_scale

MetricReader = Callable[[StepMetrics], float | None]

_MILLISECONDS = DisplayScale("ms", 1e3)
_PERCENT = DisplayScale("%", 1.0)

# The measurement of a step needs holds of at least this many rows.
_MIN_HOLD_ROWS = 50


def replace_ramps_by_jumps(record: Record, axis: str, input_tap: Tap) -> tuple[Record, float]:
    """Return a record in which each ramp of the input between two holds is replaced by a jump.

    If speed and acceleration are limited, the command of an axis cannot jump. It changes from level
    to level in a ramp over several rows. The jump is placed at the start of the ramp, so rise time
    and delay include the ramp.

    Returns
    -------
    Record
        The same record if the input has no such ramp, or is noisy.
    float
        Duration of the longest ramp, s, or 0 without ramps.
    """
    command = record.signal(axis, input_tap)
    # The rows after which the command changes.
    change_rows = np.flatnonzero(np.diff(command))
    if len(change_rows) == 0:
        return record, 0.0
    # Indices into `change_rows` of the last change before each hold.
    last_changes = np.flatnonzero(np.diff(change_rows) >= _MIN_HOLD_ROWS)
    ramp_starts = change_rows[np.concatenate([[0], last_changes + 1])]
    ramp_ends = change_rows[np.concatenate([last_changes, [len(change_rows) - 1]])] + 1
    jump_command, longest_ramp_s = command.copy(), 0.0
    for start, end in zip(ramp_starts.tolist(), ramp_ends.tolist(), strict=True):
        if end - start < 2 or not _is_monotonic(command[start : end + 1]):
            continue
        jump_command[start + 1 : end] = command[end]
        longest_ramp_s = max(longest_ramp_s, float(record.time_s[end] - record.time_s[start]))
    if longest_ramp_s == 0.0:
        return record, 0.0
    column = record.columns.index(RecordChannel(axis, input_tap))
    values = record.values.copy()
    values[:, column] = jump_command
    return replace(record, values=values), longest_ramp_s


def _is_monotonic(values: FloatArray) -> bool:
    differences = np.diff(values)
    return bool((differences >= 0.0).all() or (differences <= 0.0).all())


def analyse_steps(question: AnalysisQuestion) -> AnalysisFindings:
    """Measure every step between two holds, in the record and in the response of the model.

    The samples need not be equally spaced.
    """
    question.check_pair()
    record, axis = question.record, question.axis
    input_signal, output_signal = (
        record.signal(axis, tap) for tap in (question.input_tap, question.output_tap)
    )
    time_s = record.time_s - record.time_s[0]
    try:
        jump_record, ramp_s = replace_ramps_by_jumps(record, axis, question.input_tap)
        steps = measure_steps(jump_record, axis, question.output_tap, drive=question.input_tap)
    except InputError as error:
        picture = _make_response_picture(question, time_s, input_signal, output_signal)
        return AnalysisFindings(question, (picture,), notices=(str(error),))
    nominal, nominal_notices = _simulate_nominal(question)
    model_steps = () if nominal is None else _measure_model_steps(question, nominal)
    statistics = _make_metric_statistics(question, steps, model_steps)
    return AnalysisFindings(
        question,
        (
            _make_response_picture(question, time_s, input_signal, output_signal, nominal),
            _make_largest_step_picture(question, steps, output_signal, nominal),
        ),
        STATISTIC_HEADINGS,
        (
            (mark("steps"), str(len(steps)), "", "", ""),
            *(metric.make_row() for metric in statistics),
        ),
        tuple(metric.make_column() for metric in statistics),
        (*nominal_notices, *_find_notices(steps, ramp_s)),
    )


def _simulate_nominal(question: AnalysisQuestion) -> tuple[Record | None, tuple[str, ...]]:
    try:
        return simulate_nominal_record(question), ()
    except (InputError, KeyError) as error:
        return None, (FilledTemplate(NO_NOMINAL_MODEL, reason=error),)


def _measure_model_steps(question: AnalysisQuestion, nominal: Record) -> tuple[StepMetrics, ...]:
    """Return the steps of the model; there are none if its input has no steps."""
    try:
        jump_record, _ = replace_ramps_by_jumps(nominal, question.axis, question.input_tap)
        return measure_steps(
            jump_record, question.axis, question.output_tap, drive=question.input_tap
        )
    except InputError:
        return ()


def _make_metric_statistics(
    question: AnalysisQuestion, steps: tuple[StepMetrics, ...], model_steps: tuple[StepMetrics, ...]
) -> tuple[FigureStatistics, ...]:
    unit = question.unit(question.output_tap)

    def make_statistics(
        name: str, make_scale: Callable[[float], DisplayScale], read: MetricReader
    ) -> FigureStatistics:
        values = [read(step) for step in steps]
        return FigureStatistics(
            name, make_scale(find_largest(values)), values, [read(step) for step in model_steps]
        )

    def make_output_scale(largest: float) -> DisplayScale:
        return choose_scale(unit, largest)

    statistics = [
        make_statistics(
            mark("time of the step"), lambda _: DisplayScale("s", 1.0), lambda step: step.start_s
        ),
        make_statistics(
            mark("size of the step"),
            make_output_scale,
            lambda step: abs(step.output_to - step.output_from),
        ),
        make_statistics(
            mark("static gain"),
            lambda largest: make_ratio_scale(question, largest),
            lambda step: step.gain,
        ),
        make_statistics(mark("rise 10–90 %"), lambda _: _MILLISECONDS, lambda step: step.rise_s),
        make_statistics(mark("delay to 50 %"), lambda _: _MILLISECONDS, lambda step: step.delay_s),
        make_statistics(mark("overshoot"), lambda _: _PERCENT, lambda step: step.overshoot_percent),
        make_statistics(
            mark("settling to 5 %"), lambda _: _MILLISECONDS, lambda step: step.settling_5_s
        ),
        make_statistics(
            mark("settling to 2 %"), lambda _: _MILLISECONDS, lambda step: step.settling_2_s
        ),
    ]
    if unit == question.unit(question.input_tap):
        statistics.append(
            make_statistics(mark("final error"), make_output_scale, lambda step: step.error)
        )
    statistics.append(
        make_statistics(mark("noise rms"), make_output_scale, lambda step: step.noise_rms)
    )
    return tuple(statistics)


def _make_response_picture(
    question: AnalysisQuestion,
    time_s: FloatArray,
    input_signal: FloatArray,
    output_signal: FloatArray,
    nominal: Record | None = None,
) -> AnalysisPicture:
    """Return a picture of the whole record, with the input if it has the unit of the output."""
    scale = choose_scale(question.unit(question.output_tap), float(np.abs(output_signal).max()))
    curves = [AnalysisCurve(mark("measured"), "real", time_s, scale.per_si * output_signal)]
    if nominal is not None:
        model = nominal.signal(question.axis, question.output_tap)
        curves.insert(
            0, AnalysisCurve(mark("model"), "model", time_s, scale.per_si * model, width=3)
        )
    if question.unit(question.input_tap) == question.unit(question.output_tap):
        curves.insert(
            0, AnalysisCurve(mark("input"), "command", time_s, scale.per_si * input_signal, width=3)
        )
    return AnalysisPicture(
        f"{question.output_tap} [{scale.symbol}]", mark("time [s]"), tuple(curves)
    )


def _make_largest_step_picture(
    question: AnalysisQuestion,
    steps: tuple[StepMetrics, ...],
    output_signal: FloatArray,
    nominal: Record | None,
) -> AnalysisPicture:
    """Return a picture of the largest step until it has settled, scaled from 0 to 1."""
    time_s = question.record.time_s
    step = max(steps, key=lambda other: abs(other.output_to - other.output_from))
    size = step.output_to - step.output_from
    start = int(np.searchsorted(time_s, step.start_s))
    later_starts_s = [other.start_s for other in steps if other.start_s > step.start_s]
    end_s = min(later_starts_s, default=float(time_s[-1]))
    # Twice the settling time shows that the ringing has ended.
    shown_end_s = end_s
    if step.settling_2_s:
        shown_end_s = min(end_s, step.start_s + 2.0 * step.settling_2_s)
    rows = slice(start, max(int(np.searchsorted(time_s, shown_end_s)), start + 2))
    elapsed_ms = 1e3 * (time_s[rows] - step.start_s)
    response = (output_signal[rows] - step.output_from) / (size or 1.0)
    curves = [AnalysisCurve(mark("measured"), "real", elapsed_ms, response)]
    # The model starts from a different level than the measurement, so its own level is subtracted.
    if nominal is not None:
        model = nominal.signal(question.axis, question.output_tap)[rows]
        curves.insert(
            0,
            AnalysisCurve(
                mark("model"), "model", elapsed_ms, (model - model[0]) / (size or 1.0), 3
            ),
        )
    return AnalysisPicture(
        FilledTemplate(mark("largest step, at {time:.4g} s [normalised]"), time=step.start_s),
        mark("time since the step [ms]"),
        tuple(curves),
    )


def _find_notices(steps: tuple[StepMetrics, ...], ramp_s: float) -> list[str]:
    notices = []
    if ramp_s > 0.0:
        notices.append(
            FilledTemplate(
                mark(
                    "The input takes up to {ramp:.3g} ms from level to level, as fast as its "
                    "limits allow. All times count from the start of that ramp, for the model "
                    "too."
                ),
                ramp=1e3 * ramp_s,
            )
        )
    for name, values in (
        (mark("settling to 2 %"), [step.settling_2_s for step in steps]),
        (mark("rise"), [step.rise_s for step in steps]),
    ):
        missing_count = sum(value is None for value in values)
        if missing_count:
            notices.append(
                FilledTemplate(
                    mark(
                        "{name}: {n} of {steps} steps give no value; at the end of the hold the "
                        "axis still moves, or noise exceeds the band."
                    ),
                    name=name,
                    n=missing_count,
                    steps=len(steps),
                )
            )
    small_count = sum(
        abs(step.output_to - step.output_from) < 10.0 * step.noise_rms for step in steps
    )
    if small_count:
        notices.append(
            FilledTemplate(
                mark(
                    "{n} of {steps} steps are smaller than 10 times the noise, so noise dominates"
                    " overshoot and times. Record larger steps."
                ),
                n=small_count,
                steps=len(steps),
            )
        )
    return notices
