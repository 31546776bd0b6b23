"""Gains as a search problem."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.gains import Gains
from rotemina.sim.feedback.stability import UnstableError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.tuning.errors import TuningError
from rotemina.sim.tuning.search_problem import VARIABLES, TuningProblem

GOOD = [0.5, 0.05, 0.1, 0.9, 0.8, 0.0]


def test_gains_lie_between_their_bounds_and_rise_with_their_shares(problem):
    low, high = problem.gains_of(np.zeros(6)), problem.gains_of(np.ones(6))
    assert low.proportional == low.derivative == 0.0
    assert 0.0 < low.integral < high.integral
    assert 0.0 == low.double_integral < high.double_integral
    assert high.low_pass_hz < 0.5 * problem.rate_hz
    assert high.notch.frequency_hz == pytest.approx(420.0, rel=1e-3)
    assert low.notch.damping < high.notch.damping
    assert len(VARIABLES) == 6


def test_good_gains_have_figures_that_come_again(problem):
    gains = problem.gains_of(GOOD)
    figures = problem.evaluate(gains)
    assert figures == problem.evaluate(gains)
    assert figures.peak_sensitivity < 1.7
    assert figures.tracking_rms < 0.005
    assert figures.settling_s < 0.05
    assert figures.limited == 0.0


def test_robust_figures_are_no_better_than_those_of_the_axis_itself(problem):
    gains = problem.gains_of(GOOD)
    _, nominal = problem.try_out(gains)
    robust = problem.evaluate(gains)
    assert robust.peak_sensitivity > nominal.peak_sensitivity
    assert robust.tracking_rms > nominal.tracking_rms


def test_unstable_gains_are_never_simulated(problem, monkeypatch):
    monkeypatch.setattr(problem.loop, "follow", lambda *_, **__: pytest.fail("simulated"))
    unstable = Gains(integral=5000.0)
    figures = problem.evaluate(unstable)
    assert figures.peak_sensitivity == inf == figures.tracking_rms
    with pytest.raises(UnstableError, match="nothing was applied"):
        problem.try_out(unstable)


def test_gains_too_near_the_end_for_one_of_five_axes_are_not_simulated_either(problem):
    lively = replace(problem.gains_of(GOOD), integral=1400.0, low_pass_hz=None)
    figures = problem.evaluate(lively)
    assert 1.7 < figures.peak_sensitivity < inf
    assert figures.tracking_rms == inf


def test_a_trial_gives_the_traces_of_a_step_and_a_triangle(problem):
    (step, triangle), figures = problem.try_out(problem.gains_of(GOOD))
    assert (step.scenario.name, triangle.scenario.name) == ("step", "triangle")
    for one in (step, triangle):
        assert len(one.traces.position) == len(one.feed) == len(one.scenario.reference)
    assert figures.settling_s < 0.05
    assert abs(step.traces.position[-1] - step.scenario.target) < 100e-9


def test_an_inverse_takes_part_in_the_feed_forward(worn):
    class Shrunk:
        def reset(self):
            return self

        def step(self, desired):
            return 0.9 * desired

        def run(self, desired):
            return 0.9 * desired

    with_it = TuningProblem(worn, "zn", 5000.0, inverse=Shrunk(), spread=0.0)
    (step, _), _ = with_it.try_out(with_it.gains_of(GOOD))
    assert step.feed[0] == pytest.approx(0.9 * step.scenario.reference[0])
    assert isinstance(FeedForward((1.0,), Shrunk()).run(np.ones(3)), np.ndarray)


def test_other_kinds_of_axes_can_be_tuned_too():
    static = TuningProblem(load_robot("picma"), "p", 1000.0)
    gains = static.gains_of([0.3, 0.1, 0.0, 0.9, 0.5, 0.0])
    assert gains.notch is None
    assert static.evaluate(gains).peak_sensitivity < 1.7
    table = TuningProblem(load_robot("rotemina"), "x", 2000.0, spread=0.0)
    assert np.isfinite(table.evaluate(table.gains_of([0.3, 0.0, 0.0, 0.9, 0.8, 0.0])).tracking_rms)


def test_a_loop_slower_than_the_resonance_is_refused():
    with pytest.raises(TuningError, match=r"1000 Hz is too slow .* above 1050 Hz"):
        TuningProblem(load_robot("rotemina"), "zn", 1000.0)
