"""Step figures of a record: rise, overshoot, settling, static gain."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.filled_template import FilledTemplate
from rotemina.plugins.identification.findings import Curve, Findings, Picture, ratio_scale
from rotemina.plugins.identification.nominal_response import ABSENT, nominal_record
from rotemina.plugins.identification.record_query import Question
from rotemina.plugins.identification.step_statistics import HEAD, Figure, largest
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.identification.step_figures import StepMetrics, step_metrics
from rotemina.sim.quantities import Scale, scale_of
from rotemina.sim.records.record import Channel, Record, Tap

Reader = Callable[[StepMetrics], float | None]

_MS = Scale("ms", 1e3)
_PERCENT = Scale("%", 1.0)


_HOLD_ROWS = 50  # at least, as the measuring of steps wants them


def jumped(record: Record, axis: str, drive: Tap) -> tuple[Record, float]:
    """Return a record whose input jumps where it moved one way between two holds.

    An axis that declares speed and acceleration is never told to jump: its levels are ramps of
    some rows. The jump is put where the ramp begins, so rise and delay count the ramp in.

    Returns
    -------
    Record
        The same one where the input has no such ramp, or is noisy.
    float
        The longest ramp, s; 0 without any.
    """
    command = record.signal(axis, drive)
    moving = np.flatnonzero(np.diff(command))  # from this row to the next
    if len(moving) == 0:
        return record, 0.0
    breaks = np.flatnonzero(np.diff(moving) >= _HOLD_ROWS)
    begins = moving[np.concatenate([[0], breaks + 1])]
    ends = moving[np.concatenate([breaks, [len(moving) - 1]])] + 1
    levels, longest_s = command.copy(), 0.0
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        if end - begin < 2 or not _one_way(command[begin : end + 1]):
            continue
        levels[begin + 1 : end] = command[end]
        longest_s = max(longest_s, float(record.time_s[end] - record.time_s[begin]))
    if longest_s == 0.0:
        return record, 0.0
    column = record.columns.index(Channel(axis, drive))
    values = record.values.copy()
    values[:, column] = levels
    return replace(record, values=values), longest_s


def _one_way(values: FloatArray) -> bool:
    steps = np.diff(values)
    return bool((steps >= 0.0).all() or (steps <= 0.0).all())


def step_findings(question: Question) -> Findings:
    """Measure every step between two holds, and the model's; rows need not be equally spaced."""
    question.check()
    record, axis = question.record, question.axis
    driven, answer = (record.signal(axis, tap) for tap in (question.drive, question.answer))
    time_s = record.time_s - record.time_s[0]
    try:
        levels, ramp_s = jumped(record, axis, question.drive)
        found = step_metrics(levels, axis, question.answer, drive=question.drive)
    except InputError as error:
        course = _response_picture(question, time_s, driven, answer)
        return Findings(question, (course,), notices=(str(error),))
    nominal, absent = _modelled(question)
    beside = () if nominal is None else _measured(question, nominal)
    figures = _figures(question, found, beside)
    return Findings(
        question,
        (
            _response_picture(question, time_s, driven, answer, nominal),
            _closest(question, found, answer, nominal),
        ),
        HEAD,
        ((mark("steps"), str(len(found)), "", "", ""), *(figure.row() for figure in figures)),
        tuple(figure.column() for figure in figures),
        (*absent, *_doubts(found, ramp_s)),
    )


def _modelled(question: Question) -> tuple[Record | None, tuple[str, ...]]:
    """Return the model's record of the pair, or why there is none."""
    try:
        return nominal_record(question), ()
    except (InputError, KeyError) as error:
        return None, (FilledTemplate(ABSENT, reason=error),)


def _measured(question: Question, nominal: Record) -> tuple[StepMetrics, ...]:
    """Measure the model's steps; none where it makes none of a measured input."""
    try:
        levels, _ = jumped(nominal, question.axis, question.drive)
        return step_metrics(levels, question.axis, question.answer, drive=question.drive)
    except InputError:
        return ()


def _figures(
    question: Question, found: tuple[StepMetrics, ...], beside: tuple[StepMetrics, ...]
) -> tuple[Figure, ...]:
    unit = question.unit(question.answer)

    def figure(name: str, scale: Callable[[float], Scale], read: Reader) -> Figure:
        values = [read(each) for each in found]
        return Figure(name, scale(largest(values)), values, [read(each) for each in beside])

    def output(size: float) -> Scale:
        return scale_of(unit, size)

    figures = [
        figure(mark("time of the step"), lambda _: Scale("s", 1.0), lambda each: each.start_s),
        figure(
            mark("size of the step"), output, lambda each: abs(each.output_to - each.output_from)
        ),
        figure(
            mark("static gain"), lambda size: ratio_scale(question, size), lambda each: each.gain
        ),
        figure(mark("rise 10–90 %"), lambda _: _MS, lambda each: each.rise_s),
        figure(mark("delay to 50 %"), lambda _: _MS, lambda each: each.delay_s),
        figure(mark("overshoot"), lambda _: _PERCENT, lambda each: each.overshoot_percent),
        figure(mark("settling to 5 %"), lambda _: _MS, lambda each: each.settling_5_s),
        figure(mark("settling to 2 %"), lambda _: _MS, lambda each: each.settling_2_s),
    ]
    if unit == question.unit(question.drive):
        figures.append(figure(mark("final error"), output, lambda each: each.error))
    figures.append(figure(mark("noise rms"), output, lambda each: each.noise_rms))
    return tuple(figures)


def _response_picture(
    question: Question,
    time_s: FloatArray,
    driven: FloatArray,
    answer: FloatArray,
    nominal: Record | None = None,
) -> Picture:
    """Return the whole record; an input of another kind has no place on the output's scale."""
    scale = scale_of(question.unit(question.answer), float(np.abs(answer).max()))
    curves = [Curve(mark("measured"), "real", time_s, scale.per_si * answer)]
    if nominal is not None:
        model = nominal.signal(question.axis, question.answer)
        curves.insert(0, Curve(mark("model"), mark("model"), time_s, scale.per_si * model, width=3))
    if question.unit(question.drive) == question.unit(question.answer):
        curves.insert(0, Curve(mark("input"), "command", time_s, scale.per_si * driven, width=3))
    return Picture(f"{question.answer} [{scale.symbol}]", mark("time [s]"), tuple(curves))


def _closest(
    question: Question, found: tuple[StepMetrics, ...], answer: FloatArray, nominal: Record | None
) -> Picture:
    """Return the largest step until it has settled, from 0 at its old level to 1 at the new."""
    time_s = question.record.time_s
    step = max(found, key=lambda each: abs(each.output_to - each.output_from))
    size = step.output_to - step.output_from
    begin = int(np.searchsorted(time_s, step.start_s))
    later = [each.start_s for each in found if each.start_s > step.start_s]
    end_s = min(later, default=float(time_s[-1]))
    # Twice the settling time shows the ringing and that it is over.
    shown_s = min(end_s, step.start_s + 2.0 * (step.settling_2_s or end_s))
    rows = slice(begin, max(int(np.searchsorted(time_s, shown_s)), begin + 2))
    since_ms = 1e3 * (time_s[rows] - step.start_s)
    course = (answer[rows] - step.output_from) / (size or 1.0)
    curves = [Curve(mark("measured"), "real", since_ms, course)]
    if nominal is not None:  # from its own old level, which may be another
        model = nominal.signal(question.axis, question.answer)[rows]
        curves.insert(
            0, Curve(mark("model"), mark("model"), since_ms, (model - model[0]) / (size or 1.0), 3)
        )
    return Picture(
        FilledTemplate(mark("largest step, at {time:.4g} s [1]"), time=step.start_s),
        mark("time since the step [ms]"),
        tuple(curves),
    )


def _doubts(found: tuple[StepMetrics, ...], ramp_s: float) -> list[str]:
    doubts = []
    if ramp_s > 0.0:
        doubts.append(
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
        (mark("settling to 2 %"), [each.settling_2_s for each in found]),
        (mark("rise"), [each.rise_s for each in found]),
    ):
        missing = sum(value is None for value in values)
        if missing:
            doubts.append(
                FilledTemplate(
                    mark(
                        "{name}: {n} of {steps} steps give no value; at the end of the hold the "
                        "axis still moves, or noise exceeds the band."
                    ),
                    name=name,
                    n=missing,
                    steps=len(found),
                )
            )
    faint = sum(abs(each.output_to - each.output_from) < 10.0 * each.noise_rms for each in found)
    if faint:
        doubts.append(
            FilledTemplate(
                mark(
                    "{n} of {steps} steps are smaller than 10 times the noise, which determines"
                    " overshoot and times. Record larger steps."
                ),
                n=faint,
                steps=len(found),
            )
        )
    return doubts
