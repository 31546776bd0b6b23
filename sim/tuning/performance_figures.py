"""The figures by which a set of gains is judged."""

from dataclasses import fields
from math import inf

import numpy as np
from pydantic.dataclasses import dataclass

from rotemina.sim.arrays import FloatArray
from rotemina.sim.feedback.axis_loop import Traces
from rotemina.sim.robot.numbers import FORBID_UNKNOWN
from rotemina.sim.tuning.tuning_scenario import Scenario

SETTLED_SHARE, SETTLED_FLOORS = 1e-3, 3.0  # of the step, of the sensor's floor: the wider one


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Figures:
    """Of one axis, or the worst of several.

    Attributes
    ----------
    tracking_rms : float
        Of the true position against the triangle, as a share of the range.
    settling_s : float
        From the beginning of the step until the true position stays within 0.1 % of the step, or
        three floors of the sensor, of its end; infinite where it does not.
    overshoot : float
        Share of the step by which the true position goes beyond.
    absolute_error : float
        Integral of |reference − position| over the step, m s or rad s.
    effort : float
        Rms speed of what the feedback adds to the output, ranges per second.
    peak_sensitivity : float
        Ms.
    limited : float
        Share of the samples at which a limit cut the output off.
    """

    tracking_rms: float
    settling_s: float
    overshoot: float
    absolute_error: float
    effort: float
    peak_sensitivity: float
    limited: float


UNUSABLE = Figures(**dict.fromkeys((field.name for field in fields(Figures)), inf))


def figures_of(
    step: tuple[Scenario, Traces, FloatArray],
    triangle: tuple[Scenario, Traces, FloatArray],
    *,
    span: float,
    floor: float,
    peak_sensitivity: float,
) -> Figures:
    """Return the figures of a step and a triangle, each with its traces and feed-forward (n,)."""
    move, went, _ = step
    swing, swung, _ = triangle
    interval_s = float(went.time_s[1])
    begun = swung.time_s >= swing.begin_s
    samples = len(went.time_s) + len(swung.time_s)
    return Figures(
        tracking_rms=_rms((swung.position - swung.reference)[begun]) / span,
        settling_s=settling_of(move, went, floor),
        overshoot=overshoot_of(move, went),
        absolute_error=interval_s * float(np.abs(went.position - went.reference).sum()),
        effort=max(
            _rms(np.diff(traces.output - feed)) / (interval_s * span)
            for _, traces, feed in (step, triangle)
        ),
        peak_sensitivity=peak_sensitivity,
        limited=(went.limited + swung.limited) / samples,
    )


def settling_of(scenario: Scenario, traces: Traces, floor: float) -> float:
    """Return when a step has settled, s from its beginning; infinite where it has not."""
    band = max(SETTLED_SHARE * abs(scenario.distance), SETTLED_FLOORS * floor)
    outside = np.flatnonzero(np.abs(traces.position - scenario.target) > band)
    last = int(outside[-1]) if len(outside) else -1
    if last == len(traces.time_s) - 1:
        return inf
    return max(float(traces.time_s[last + 1]) - scenario.begin_s, 0.0)


def overshoot_of(scenario: Scenario, traces: Traces) -> float:
    """Return the share of a step by which it goes beyond its end."""
    beyond = (traces.position - scenario.target) / scenario.distance
    return max(float(beyond.max()), 0.0)


def worst(several: list[Figures]) -> Figures:
    """Return the greatest of each figure."""
    names = [field.name for field in fields(Figures)]
    return Figures(**{name: max(getattr(one, name) for one in several) for name in names})


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
