"""Filters match their definitions."""

import numpy as np
import pytest

from rotemina.sim.errors import FeedbackError
from rotemina.sim.feedback.filters import design_low_pass, design_notch

RATE_HZ = 5000.0


def compute_response_at(biquad, *frequency_hz):
    return biquad.compute_response(np.exp(2j * np.pi * np.array(frequency_hz) / RATE_HZ))


def test_a_notch_has_its_depth_without_phase_at_its_frequency_and_gain_one_elsewhere():
    response = compute_response_at(design_notch(420.0, 0.7, 0.05, RATE_HZ), 1e-3, 420.0, 2500.0)
    np.testing.assert_allclose(np.abs(response), [1.0, 0.05, 1.0], rtol=1e-9)
    assert abs(np.angle(response[1])) < 1e-9


def test_a_low_pass_is_three_decibels_down_at_its_frequency():
    gains = np.abs(compute_response_at(design_low_pass(800.0, RATE_HZ), 1e-3, 800.0, 2499.999))
    np.testing.assert_allclose(gains, [1.0, np.sqrt(0.5), 0.0], atol=1e-9)


@pytest.mark.parametrize("frequency_hz", [0.0, 2500.0, float("nan")])
def test_a_frequency_beyond_half_the_rate_is_refused(frequency_hz):
    with pytest.raises(FeedbackError, match="below half the loop's rate, 2500 Hz"):
        design_low_pass(frequency_hz, RATE_HZ)
