"""The search problem: gains from variables, and their figures."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from rotemina.sim.errors import TuningError, UnstableError
from rotemina.sim.feedback import ControllerGains, FeedForward
from rotemina.sim.robot_files import load_robot
from rotemina.sim.tuning import TuningProblem
from rotemina.sim.tuning.search_problem import VARIABLES

GOOD_SHARES = [0.5, 0.05, 0.1, 0.9, 0.8, 0.0]


def test_gains_are_within_bounds_and_increase_with_their_shares(problem):
    low, high = problem.gains_of(np.zeros(6)), problem.gains_of(np.ones(6))
    assert low.proportional == low.derivative == 0.0
    assert 0.0 < low.integral < high.integral
    assert 0.0 == low.double_integral < high.double_integral
    assert high.low_pass_hz < 0.5 * problem.rate_hz
    assert high.notch.frequency_hz == pytest.approx(420.0, rel=1e-3)
    assert low.notch.damping < high.notch.damping
    assert len(VARIABLES) == 6


def test_figures_of_good_gains_are_repeatable(problem):
    gains = problem.gains_of(GOOD_SHARES)
    figures = problem.evaluate(gains)
    assert figures == problem.evaluate(gains)
    assert figures.peak_sensitivity < 1.7
    assert figures.tracking_rms < 0.005
    assert figures.settling_s < 0.05
    assert figures.limited == 0.0


def test_robust_figures_are_worse_than_nominal_figures(problem):
    gains = problem.gains_of(GOOD_SHARES)
    _, nominal = problem.try_out(gains)
    robust = problem.evaluate(gains)
    assert robust.peak_sensitivity > nominal.peak_sensitivity
    assert robust.tracking_rms > nominal.tracking_rms


def test_unstable_gains_are_never_simulated(problem, monkeypatch):
    monkeypatch.setattr(problem.loop, "follow", lambda *_, **__: pytest.fail("simulated"))
    unstable = ControllerGains(integral=5000.0)
    figures = problem.evaluate(unstable)
    assert figures.peak_sensitivity == inf == figures.tracking_rms
    with pytest.raises(UnstableError, match="nothing was applied"):
        problem.try_out(unstable)


def test_gains_with_too_high_sensitivity_on_one_axis_are_not_simulated(problem):
    gains = replace(problem.gains_of(GOOD_SHARES), integral=1400.0, low_pass_hz=None)
    figures = problem.evaluate(gains)
    assert 1.7 < figures.peak_sensitivity < inf
    assert figures.tracking_rms == inf


def test_a_trial_gives_the_traces_of_a_step_and_a_triangle(problem):
    (step, triangle), figures = problem.try_out(problem.gains_of(GOOD_SHARES))
    assert (step.scenario.name, triangle.scenario.name) == ("step", "triangle")
    for trial in (step, triangle):
        assert len(trial.traces.position) == len(trial.feed) == len(trial.scenario.reference)
    assert figures.settling_s < 0.05
    assert abs(step.traces.position[-1] - step.scenario.target) < 100e-9


def test_an_inverse_is_part_of_the_feed_forward(worn_robot):
    class ScalingInverse:
        def reset(self):
            return self

        def step(self, desired):
            return 0.9 * desired

        def run(self, desired):
            return 0.9 * desired

    problem_with_inverse = TuningProblem(
        worn_robot, "zn", 5000.0, inverse=ScalingInverse(), spread=0.0
    )
    (step, _), _ = problem_with_inverse.try_out(problem_with_inverse.gains_of(GOOD_SHARES))
    assert step.feed[0] == pytest.approx(0.9 * step.scenario.reference[0])
    assert isinstance(FeedForward((1.0,), ScalingInverse()).run(np.ones(3)), np.ndarray)


def test_static_axes_and_tables_can_be_tuned():
    static_problem = TuningProblem(load_robot("picma"), "p", 1000.0)
    gains = static_problem.gains_of([0.3, 0.1, 0.0, 0.9, 0.5, 0.0])
    assert gains.notch is None
    assert static_problem.evaluate(gains).peak_sensitivity < 1.7
    table_problem = TuningProblem(load_robot("rotemina"), "x", 2000.0, spread=0.0)
    assert np.isfinite(
        table_problem.evaluate(table_problem.gains_of([0.3, 0.0, 0.0, 0.9, 0.8, 0.0])).tracking_rms
    )


def test_a_loop_slower_than_the_resonance_is_refused():
    with pytest.raises(TuningError, match=r"1000 Hz is too slow .* above 1050 Hz"):
        TuningProblem(load_robot("rotemina"), "zn", 1000.0)
