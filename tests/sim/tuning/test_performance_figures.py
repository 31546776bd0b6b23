"""Figures of answers that are made by hand."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from rotemina.sim.feedback.axis_loop import Traces
from rotemina.sim.tuning.pareto_front import knee_of
from rotemina.sim.tuning.performance_figures import (
    UNUSABLE,
    Figures,
    figures_of,
    overshoot_of,
    settling_of,
    worst,
)
from rotemina.sim.tuning.tuning_scenario import Scenario

H = 1e-3


def answer(position, target=1.0, distance=1.0, limited=0):
    position = np.array(position)
    reference = np.full(len(position), target)
    reference[0] = target - distance
    time_s = H * np.arange(len(position))
    traces = Traces(time_s, reference, position.copy(), position, position, limited)
    return Scenario("step", reference, 0.0), traces


def test_settling_is_when_it_comes_to_stay():
    inside = answer([0.0, 0.9995, 1.1, 0.9995, 1.0005, 1.0])
    assert settling_of(*inside, 0.0) == pytest.approx(3 * H)
    assert settling_of(*answer([0.0, 0.5, 1.0, 1.1]), 0.0) == inf
    assert settling_of(*inside, 0.05) == pytest.approx(1 * H)  # three floors are wider


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_overshoot_counts_beyond_the_end_alone(sign):
    scenario, traces = answer([0.0, sign * 1.25, sign * 0.8], sign, sign)
    assert overshoot_of(scenario, traces) == pytest.approx(0.25)
    assert overshoot_of(*answer([0.0, 0.9, 1.0])) == 0.0


def test_figures_of_a_step_and_a_triangle():
    step, traces = answer([0.0, 1.0, 1.0, 1.5], limited=1)
    feed = traces.output - np.array([0.0, 0.1, 0.0, 0.1])
    found = figures_of(
        (step, traces, feed),
        (step, traces, feed),
        span=2.0,
        floor=0.0,
        peak_sensitivity=1.4,
    )
    assert found.tracking_rms == pytest.approx(0.5 / 2.0 / 2.0)
    assert found.absolute_error == pytest.approx(0.5 * H)
    assert found.effort == pytest.approx(0.1 / H / 2.0)
    assert found.limited == 0.25
    assert found.peak_sensitivity == 1.4


def test_the_worst_is_taken_figure_by_figure():
    one = replace(UNUSABLE, tracking_rms=1.0, overshoot=0.0)
    other = Figures(
        tracking_rms=2.0,
        settling_s=0.0,
        overshoot=-1.0,
        absolute_error=0.0,
        effort=0.0,
        peak_sensitivity=0.0,
        limited=0.0,
    )
    assert worst([one, other]) == replace(UNUSABLE, tracking_rms=2.0, overshoot=0.0)


def test_the_knee_is_where_the_front_bends():
    front = np.array([[0.0, 10.0], [1.0, 2.0], [4.0, 1.0], [10.0, 0.0]])
    assert knee_of(front) == 1
    assert knee_of(front * [1e-9, 1e6]) == 1  # whatever the units
    assert knee_of(front[[3, 0]]) == 1
    assert knee_of(np.array([[0.0, 2.0], [1.0, 1.0], [2.0, 0.0]])) == 0  # straight: the best
    assert knee_of(np.array([[0.0, 1.0], [9.0, 0.9], [10.0, 0.0]])) == 0  # bends outwards
