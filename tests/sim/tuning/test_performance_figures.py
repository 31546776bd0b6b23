"""Performance figures of hand-made responses."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from rotemina.sim.feedback import LoopTraces
from rotemina.sim.tuning.pareto_front import find_knee
from rotemina.sim.tuning.performance_figures import (
    INFINITE_FIGURES,
    TuningFigures,
    compute_figures,
    overshoot_ratio,
    settling_time,
    worst_figures,
)
from rotemina.sim.tuning.tuning_scenario import TuningScenario

SAMPLE_S = 1e-3


def make_response(position, target=1.0, distance=1.0, limited=0):
    position = np.array(position)
    reference = np.full(len(position), target)
    reference[0] = target - distance
    time_s = SAMPLE_S * np.arange(len(position))
    traces = LoopTraces(time_s, reference, position.copy(), position, position, limited)
    return TuningScenario("step", reference, 0.0), traces


def test_settling_time_is_when_the_error_stays_within_the_band():
    response = make_response([0.0, 0.9995, 1.1, 0.9995, 1.0005, 1.0])
    assert settling_time(*response, 0.0) == pytest.approx(3 * SAMPLE_S)
    assert settling_time(*make_response([0.0, 0.5, 1.0, 1.1]), 0.0) == inf
    assert settling_time(*response, 0.05) == pytest.approx(
        1 * SAMPLE_S
    )  # three noise floors are a wider band


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_overshoot_counts_only_beyond_the_target(sign):
    scenario, traces = make_response([0.0, sign * 1.25, sign * 0.8], sign, sign)
    assert overshoot_ratio(scenario, traces) == pytest.approx(0.25)
    assert overshoot_ratio(*make_response([0.0, 0.9, 1.0])) == 0.0


def test_figures_of_a_step_and_a_triangle():
    step, traces = make_response([0.0, 1.0, 1.0, 1.5], limited=1)
    feed = traces.output - np.array([0.0, 0.1, 0.0, 0.1])
    figures = compute_figures(
        (step, traces, feed),
        (step, traces, feed),
        span=2.0,
        floor=0.0,
        peak_sensitivity=1.4,
    )
    assert figures.tracking_rms == pytest.approx(0.5 / 2.0 / 2.0)
    assert figures.absolute_error == pytest.approx(0.5 * SAMPLE_S)
    assert figures.effort == pytest.approx(0.1 / SAMPLE_S / 2.0)
    assert figures.limited == 0.25
    assert figures.peak_sensitivity == 1.4


def test_worst_figures_are_the_maximum_of_each_figure():
    first = replace(INFINITE_FIGURES, tracking_rms=1.0, overshoot=0.0)
    second = TuningFigures(
        tracking_rms=2.0,
        settling_s=0.0,
        overshoot=-1.0,
        absolute_error=0.0,
        effort=0.0,
        peak_sensitivity=0.0,
        limited=0.0,
    )
    assert worst_figures([first, second]) == replace(
        INFINITE_FIGURES, tracking_rms=2.0, overshoot=0.0
    )


def test_the_knee_is_where_the_front_bends():
    front = np.array([[0.0, 10.0], [1.0, 2.0], [4.0, 1.0], [10.0, 0.0]])
    assert find_knee(front) == 1
    assert find_knee(front * [1e-9, 1e6]) == 1  # in any units
    assert find_knee(front[[3, 0]]) == 1
    assert (
        find_knee(np.array([[0.0, 2.0], [1.0, 1.0], [2.0, 0.0]])) == 0
    )  # on a straight front, the first point
    assert (
        find_knee(np.array([[0.0, 1.0], [9.0, 0.9], [10.0, 0.0]])) == 0
    )  # the front bends outwards
