"""Performance figures of a set of gains."""

from dataclasses import fields
from math import inf

import numpy as np
from pydantic.dataclasses import dataclass

from rotemina.sim.arrays import FloatArray
from rotemina.sim.feedback import LoopTraces
from rotemina.sim.robot import FORBID_UNKNOWN
from rotemina.sim.tuning.tuning_scenario import TuningScenario

# Half width of the band within which a step has settled: a share of the step, or a multiple of the
# sensor's noise floor, whichever is larger.
SETTLED_STEP_RATIO, SETTLED_NOISE_FLOOR_RATIO = 1e-3, 3.0


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class TuningFigures:
    """Performance figures of one axis, or the worst figures of several.

    Attributes
    ----------
    tracking_rms : float
        RMS error of the true position while following the triangle, as a share of the range.
    settling_s : float
        Time from the beginning of the step until the true position stays within 0.1 % of the step,
        or three noise floors of the sensor, from its end; infinite if it does not.
    overshoot : float
        Overshoot of the true position as a share of the step.
    absolute_error : float
        Integral of |reference − position| over the step, m s or rad s.
    effort : float
        RMS rate of change of the feedback's part of the output, ranges per second.
    peak_sensitivity : float
        Ms.
    limited : float
        Share of the samples in which the output was limited.
    """

    tracking_rms: float
    settling_s: float
    overshoot: float
    absolute_error: float
    effort: float
    peak_sensitivity: float
    limited: float


# Figures of gains that cannot be simulated.
INFINITE_FIGURES = TuningFigures(
    **dict.fromkeys((field.name for field in fields(TuningFigures)), inf)
)


def compute_figures(
    step: tuple[TuningScenario, LoopTraces, FloatArray],
    triangle: tuple[TuningScenario, LoopTraces, FloatArray],
    *,
    span: float,
    floor: float,
    peak_sensitivity: float,
) -> TuningFigures:
    """Return the figures of a step and a triangle, each with its traces and feed-forward (n,)."""
    step_scenario, step_traces, _ = step
    triangle_scenario, triangle_traces, _ = triangle
    interval_s = float(step_traces.time_s[1])
    is_after_start = triangle_traces.time_s >= triangle_scenario.begin_s
    samples = len(step_traces.time_s) + len(triangle_traces.time_s)
    return TuningFigures(
        tracking_rms=_rms((triangle_traces.position - triangle_traces.reference)[is_after_start])
        / span,
        settling_s=settling_time(step_scenario, step_traces, floor),
        overshoot=overshoot_ratio(step_scenario, step_traces),
        absolute_error=interval_s
        * float(np.abs(step_traces.position - step_traces.reference).sum()),
        effort=max(
            _rms(np.diff(traces.output - feed)) / (interval_s * span)
            for _, traces, feed in (step, triangle)
        ),
        peak_sensitivity=peak_sensitivity,
        limited=(step_traces.limited_count + triangle_traces.limited_count) / samples,
    )


def settling_time(scenario: TuningScenario, traces: LoopTraces, floor: float) -> float:
    """Return the settling time of a step, s from its beginning; infinite if it does not settle."""
    band = max(SETTLED_STEP_RATIO * abs(scenario.distance), SETTLED_NOISE_FLOOR_RATIO * floor)
    outside = np.flatnonzero(np.abs(traces.position - scenario.target) > band)
    last_outside = int(outside[-1]) if len(outside) else -1
    if last_outside == len(traces.time_s) - 1:
        return inf
    return max(float(traces.time_s[last_outside + 1]) - scenario.begin_s, 0.0)


def overshoot_ratio(scenario: TuningScenario, traces: LoopTraces) -> float:
    """Return the overshoot of a step as a share of its distance."""
    excess = (traces.position - scenario.target) / scenario.distance
    return max(float(excess.max()), 0.0)


def worst_figures(candidates: list[TuningFigures]) -> TuningFigures:
    """Return the largest value of each figure."""
    names = [field.name for field in fields(TuningFigures)]
    return TuningFigures(
        **{name: max(getattr(figures, name) for figures in candidates) for name in names}
    )


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
