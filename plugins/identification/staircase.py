"""Step figures of a record that holds steps: rise, overshoot, settling, static gain."""

import numpy as np

from rotemina.plugins.identification.findings import (
    Curve,
    Findings,
    Picture,
    Scale,
    ratio_scale,
    scale_of,
)
from rotemina.plugins.identification.question import Question
from rotemina.plugins.identification.statistics import HEAD, Figure, largest
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.identification.steps import StepMetrics, step_metrics

_MS = Scale("ms", 1e3)
_PERCENT = Scale("%", 1.0)


def step_findings(question: Question) -> Findings:
    """Measure every step between two holds; rows need not be equally spaced."""
    question.check()
    record, axis = question.record, question.axis
    driven, answer = (record.signal(axis, tap) for tap in (question.drive, question.answer))
    time_s = record.time_s - record.time_s[0]
    try:
        found = step_metrics(record, axis, question.answer, drive=question.drive)
    except InputError as error:
        course = _course(question, time_s, driven, answer)
        return Findings(question, (course,), notices=(str(error),))
    figures = _figures(question, found)
    return Findings(
        question,
        (_course(question, time_s, driven, answer), _closest(found, record.time_s, answer)),
        HEAD,
        (("steps", str(len(found)), "", ""), *(figure.row() for figure in figures)),
        tuple(figure.column() for figure in figures),
        tuple(_doubts(found)),
    )


def _figures(question: Question, found: tuple[StepMetrics, ...]) -> tuple[Figure, ...]:
    unit = question.unit(question.answer)
    steps = [each.output_to - each.output_from for each in found]
    noise = [each.noise_rms for each in found]
    gains = [each.gain for each in found]
    figures = [
        Figure("at", Scale("s", 1.0), [each.start_s for each in found]),
        Figure("step of the output", scale_of(unit, largest(steps)), steps),
        Figure("static gain", ratio_scale(question, largest(gains)), gains),
        Figure("rise 10–90 %", _MS, [each.rise_s for each in found]),
        Figure("delay to 50 %", _MS, [each.delay_s for each in found]),
        Figure("overshoot", _PERCENT, [each.overshoot_percent for each in found]),
        Figure("settling to 5 %", _MS, [each.settling_5_s for each in found]),
        Figure("settling to 2 %", _MS, [each.settling_2_s for each in found]),
    ]
    if unit == question.unit(question.drive):
        errors = [each.error for each in found]
        figures.append(Figure("final error", scale_of(unit, largest(errors)), errors))
    figures.append(Figure("noise rms", scale_of(unit, largest(noise)), noise))
    return tuple(figures)


def _course(
    question: Question, time_s: FloatArray, driven: FloatArray, answer: FloatArray
) -> Picture:
    """Return the whole record; an input of another kind has no place on the output's scale."""
    scale = scale_of(question.unit(question.answer), float(np.abs(answer).max()))
    curves = [Curve("measured", "real", time_s, scale.per_si * answer)]
    if question.unit(question.drive) == question.unit(question.answer):
        curves.insert(0, Curve("input", "command", time_s, scale.per_si * driven, width=3))
    return Picture(f"{question.answer} [{scale.symbol}]", "time [s]", tuple(curves))


def _closest(found: tuple[StepMetrics, ...], time_s: FloatArray, answer: FloatArray) -> Picture:
    """Return the largest step until it has settled, from 0 at its old level to 1 at the new."""
    step = max(found, key=lambda each: abs(each.output_to - each.output_from))
    size = step.output_to - step.output_from
    begin = int(np.searchsorted(time_s, step.start_s))
    later = [each.start_s for each in found if each.start_s > step.start_s]
    end_s = min(later, default=float(time_s[-1]))
    # Twice the settling time shows the ringing and that it is over.
    shown_s = min(end_s, step.start_s + 2.0 * (step.settling_2_s or end_s))
    rows = slice(begin, max(int(np.searchsorted(time_s, shown_s)), begin + 2))
    course = (answer[rows] - step.output_from) / (size or 1.0)
    curve = Curve("measured", "real", 1e3 * (time_s[rows] - step.start_s), course)
    return Picture(f"largest step, at {step.start_s:.4g} s [1]", "since the step [ms]", (curve,))


def _doubts(found: tuple[StepMetrics, ...]) -> list[str]:
    doubts = []
    for name, values in (
        ("settling to 2 %", [each.settling_2_s for each in found]),
        ("rise", [each.rise_s for each in found]),
    ):
        missing = sum(value is None for value in values)
        if missing:
            doubts.append(
                f"{name}: {missing} of {len(found)} steps do not show it; they still move, or "
                "noise exceeds the band, at the end of their hold."
            )
    faint = sum(abs(each.output_to - each.output_from) < 10.0 * each.noise_rms for each in found)
    if faint:
        doubts.append(
            f"{faint} of {len(found)} steps are smaller than 10 times the noise about their "
            "level: overshoot and times are those of the noise; record larger steps."
        )
    return doubts
