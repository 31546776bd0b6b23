"""Poles and margins against loops that can be solved by hand, and against simulation."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from rotemina.sim.feedback.axis_loop import AxisLoop
from rotemina.sim.feedback.gains import Gains, Notch
from rotemina.sim.feedback.stability import (
    LoopAnalysis,
    UnstableError,
    check_stability,
    sensitivity_peak,
)
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

RATE_HZ = 5000.0
TUNED = Gains(integral=900.0, notch=Notch(420.0, 1.0, 0.025))


@pytest.fixture(scope="module")
def static():
    """An axis that is at once where it is sent: y_k = u_{k−1}."""
    return AxisLoop(load_robot("picma"), "p", 1000.0).sampled


def integrator(share):
    """I h = share at 1 kHz."""
    return Gains(integral=1000.0 * share)


def test_an_integrator_around_a_static_axis_has_the_pole_one_minus_its_share(static):
    found = LoopAnalysis(static).stability(integrator(0.3))
    assert found.radius == pytest.approx(0.7)
    assert found.stable
    assert found.gain_margin == pytest.approx(2.0 / 0.3)
    assert found.peak_sensitivity == pytest.approx(2.0 / 1.7, rel=1e-3)  # at half the rate


def test_one_more_sample_of_delay_halves_the_gain_that_it_bears(static):
    late = replace(static, delay=1)
    # z² − z + K: on the unit circle at K = 1.
    assert LoopAnalysis(late).stability(integrator(0.999)).stable
    assert not LoopAnalysis(late).stability(integrator(1.001)).stable
    found = LoopAnalysis(late).stability(integrator(0.25))
    assert found.gain_margin == pytest.approx(4.0, rel=1e-3)
    np.testing.assert_allclose(np.sort(np.abs(found.poles))[-2:], 0.5, rtol=1e-6)


def test_phase_and_delay_margin_are_those_of_the_integrator(static):
    share = 0.2
    crossing = 2.0 * np.arcsin(share / 2.0)  # rad a sample, where |K / (1 − q)| = 1
    phase = np.pi / 2.0 - crossing / 2.0  # of what is left of q/(1 − q)
    found = LoopAnalysis(static).stability(integrator(share))
    assert found.phase_margin_deg == pytest.approx(np.degrees(phase), rel=1e-3)
    assert found.delay_margin_s == pytest.approx(phase / crossing * 1e-3, rel=1e-3)


def test_without_feedback_nothing_is_near_the_end(static):
    found = LoopAnalysis(static).stability(Gains())
    assert found.stable
    assert found.peak_sensitivity == 1.0
    assert (found.gain_margin, found.phase_margin_deg, found.bandwidth_hz) == (inf, inf, 0.0)


def test_the_gain_margin_is_where_the_simulated_loop_begins_to_grow(loop):
    margin = LoopAnalysis(loop.sampled).stability(TUNED).gain_margin
    assert margin < 20.0
    reference = np.r_[np.full(5, 30e-6), np.full(3000, 30.001e-6)]
    sizes = []
    for factor in (0.97, 1.03):
        gains = replace(TUNED, integral=TUNED.integral * margin * factor)
        error = loop.follow(gains, reference).position - reference
        sizes.append(np.abs(error[-300:]).max() / np.abs(error[300:600]).max())
    assert sizes[0] < 1.0 < sizes[1]


def test_a_small_disturbance_dies_away_as_fast_as_the_largest_pole(loop):
    radius = LoopAnalysis(loop.sampled).stability(TUNED).radius
    reference = np.r_[np.full(5, 30e-6), np.full(2500, 30.001e-6)]
    error = np.abs(loop.follow(TUNED, reference).position - reference)
    early, late = error[500:700].max(), error[1000:1200].max()
    assert (late / early) ** (1 / 500) == pytest.approx(radius, rel=1e-3)


def test_a_late_output_shows_in_the_poles_of_an_axis_with_dynamics(loop):
    found = LoopAnalysis(loop.sampled).stability(TUNED)
    most = int(found.delay_margin_s * RATE_HZ)  # whole intervals that it bears
    assert most >= 2
    for delay, stable in ((most, True), (most + 1, False)):
        late = replace(loop.sampled, delay=delay)
        assert LoopAnalysis(late).stability(TUNED).stable is stable


def test_a_notch_lets_the_loop_be_faster(loop):
    with_it = LoopAnalysis(loop.sampled).stability(TUNED)
    assert with_it.stable
    assert with_it.peak_sensitivity < 1.7
    assert with_it.bandwidth_hz > 80.0
    assert not LoopAnalysis(loop.sampled).stability(Gains(integral=900.0)).stable


def test_unstable_gains_are_refused_with_the_reason(loop):
    with pytest.raises(UnstableError, match=r"largest pole .* not inside .* nothing was applied"):
        check_stability(loop.sampled, Gains(integral=900.0))
    with pytest.raises(UnstableError, match=r"peak sensitivity Ms = .* must be at most 1\.2"):
        check_stability(loop.sampled, TUNED, 1.2)
    assert check_stability(loop.sampled, TUNED).stable
    assert sensitivity_peak(LoopAnalysis(loop.sampled), Gains(integral=900.0)) == inf


def test_a_detuned_axis_is_analysed_as_it_is_simulated(robot):
    effect = AxisEffect(axis="zn", id="resonance_mismatch", parameters={"frequency_error": -0.3})
    far = AxisLoop(replace(robot, effects=(effect,)), "zn", RATE_HZ)
    assert not LoopAnalysis(far.sampled).stability(replace(TUNED, integral=2000.0)).stable
