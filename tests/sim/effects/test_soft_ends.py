"""Fit of an amplifier's output limits from commanded and measured voltages."""

import numpy as np
import pytest

from rotemina.sim.effects.saturation import apply_soft_limits
from rotemina.sim.effects.soft_ends import AmplifierLimits, fit_limits


def limit_voltages(commanded, limits):
    return np.array(
        [apply_soft_limits(voltage, 0.0, 0.0, 0.0, 0.0, 0.0, limits, None) for voltage in commanded]
    )


def test_both_limits_and_the_softness_are_found():
    rng = np.random.default_rng(1)
    commanded = rng.uniform(-20.0, 140.0, 3000)
    true_limits = AmplifierLimits(-4.0, 112.0, 0.06)
    measured = limit_voltages(commanded, true_limits) + rng.normal(0.0, 3e-3, len(commanded))
    fit = fit_limits(commanded, measured, (measured.min(), measured.max()))
    assert fit == pytest.approx(true_limits, rel=1e-3)


def test_a_limit_that_was_not_reached_stays_open():
    commanded = np.linspace(-30.0, 60.0, 2000)
    true_limits = AmplifierLimits(-4.0, 400.0, 0.02)
    measured = limit_voltages(commanded, true_limits)
    fit = fit_limits(commanded, measured, (measured.min(), measured.max())).without_high(400.0)
    assert fit.low == pytest.approx(true_limits.low, abs=0.5)
    assert np.abs(limit_voltages(commanded, fit) - measured).max() < 1.0
    assert fit.without_low(-300.0).low == -300.0
