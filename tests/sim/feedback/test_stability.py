"""Poles and margins match loops that can be solved by hand, and simulations."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from rotemina.sim.errors import UnstableError
from rotemina.sim.feedback import (
    AxisLoop,
    ControllerGains,
    LoopAnalysis,
    NotchFilter,
    check_stability,
    compute_sensitivity_peak,
)
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

RATE_HZ = 5000.0
TUNED = ControllerGains(integral=900.0, notch=NotchFilter(420.0, 1.0, 0.025))


@pytest.fixture(scope="module")
def static_axis():
    """An axis that reaches its command within one sample: y_k = u_{k−1}."""
    return AxisLoop(load_robot("picma"), "p", 1000.0).sampled_axis


def make_integral_gains(share):
    """Return integral gains with I h = share at 1 kHz."""
    return ControllerGains(integral=1000.0 * share)


def test_an_integrator_around_a_static_axis_has_the_pole_one_minus_its_share(static_axis):
    stability = LoopAnalysis(static_axis).compute_stability(make_integral_gains(0.3))
    assert stability.radius == pytest.approx(0.7)
    assert stability.is_stable
    assert stability.gain_margin == pytest.approx(2.0 / 0.3)
    assert stability.peak_sensitivity == pytest.approx(2.0 / 1.7, rel=1e-3)  # at half the rate


def test_one_more_sample_of_delay_halves_the_maximum_gain(static_axis):
    delayed_axis = replace(static_axis, delay=1)
    # z² − z + K has its roots on the unit circle at K = 1.
    assert LoopAnalysis(delayed_axis).compute_stability(make_integral_gains(0.999)).is_stable
    assert not LoopAnalysis(delayed_axis).compute_stability(make_integral_gains(1.001)).is_stable
    stability = LoopAnalysis(delayed_axis).compute_stability(make_integral_gains(0.25))
    assert stability.gain_margin == pytest.approx(4.0, rel=1e-3)
    np.testing.assert_allclose(np.sort(np.abs(stability.poles))[-2:], 0.5, rtol=1e-6)


def test_phase_and_delay_margin_are_those_of_the_integrator(static_axis):
    share = 0.2
    crossing = 2.0 * np.arcsin(share / 2.0)  # rad a sample, where |K / (1 − q)| = 1
    phase = np.pi / 2.0 - crossing / 2.0  # margin of q/(1 − q)
    stability = LoopAnalysis(static_axis).compute_stability(make_integral_gains(share))
    assert stability.phase_margin_deg == pytest.approx(np.degrees(phase), rel=1e-3)
    assert stability.delay_margin_s == pytest.approx(phase / crossing * 1e-3, rel=1e-3)


def test_without_feedback_all_margins_are_infinite(static_axis):
    stability = LoopAnalysis(static_axis).compute_stability(ControllerGains())
    assert stability.is_stable
    assert stability.peak_sensitivity == 1.0
    assert (stability.gain_margin, stability.phase_margin_deg, stability.bandwidth_hz) == (
        inf,
        inf,
        0.0,
    )


def test_the_simulated_loop_grows_beyond_the_gain_margin(loop):
    margin = LoopAnalysis(loop.sampled_axis).compute_stability(TUNED).gain_margin
    assert margin < 20.0
    reference = np.r_[np.full(5, 30e-6), np.full(3000, 30.001e-6)]
    growths = []
    for factor in (0.97, 1.03):
        gains = replace(TUNED, integral=TUNED.integral * margin * factor)
        error = loop.follow(gains, reference).position - reference
        growths.append(np.abs(error[-300:]).max() / np.abs(error[300:600]).max())
    assert growths[0] < 1.0 < growths[1]


def test_a_small_disturbance_decays_as_fast_as_the_largest_pole(loop):
    radius = LoopAnalysis(loop.sampled_axis).compute_stability(TUNED).radius
    reference = np.r_[np.full(5, 30e-6), np.full(2500, 30.001e-6)]
    error = np.abs(loop.follow(TUNED, reference).position - reference)
    early, late = error[500:700].max(), error[1000:1200].max()
    assert (late / early) ** (1 / 500) == pytest.approx(radius, rel=1e-3)


def test_an_axis_with_dynamics_is_stable_up_to_the_delay_margin(loop):
    stability = LoopAnalysis(loop.sampled_axis).compute_stability(TUNED)
    max_delay = int(stability.delay_margin_s * RATE_HZ)  # whole intervals within the margin
    assert max_delay >= 2
    for delay, is_stable in ((max_delay, True), (max_delay + 1, False)):
        delayed_axis = replace(loop.sampled_axis, delay=delay)
        assert LoopAnalysis(delayed_axis).compute_stability(TUNED).is_stable is is_stable


def test_gains_that_are_unstable_without_a_notch_are_refused_with_the_reason(loop):
    with pytest.raises(UnstableError, match=r"largest pole .* not inside .* nothing was applied"):
        check_stability(loop.sampled_axis, ControllerGains(integral=900.0))
    with pytest.raises(UnstableError, match=r"peak sensitivity Ms = .* must be at most 1\.2"):
        check_stability(loop.sampled_axis, TUNED, 1.2)
    tuned = check_stability(loop.sampled_axis, TUNED)
    assert tuned.is_stable
    assert tuned.peak_sensitivity < 1.7
    assert tuned.bandwidth_hz > 80.0
    assert (
        compute_sensitivity_peak(LoopAnalysis(loop.sampled_axis), ControllerGains(integral=900.0))
        == inf
    )


def test_the_analysis_includes_the_resonance_mismatch(robot):
    effect = AxisEffect(axis="zn", id="resonance_mismatch", parameters={"frequency_error": -0.3})
    detuned_loop = AxisLoop(replace(robot, effects=(effect,)), "zn", RATE_HZ)
    assert (
        not LoopAnalysis(detuned_loop.sampled_axis)
        .compute_stability(replace(TUNED, integral=2000.0))
        .is_stable
    )
