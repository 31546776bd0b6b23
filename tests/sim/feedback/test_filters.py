"""Filters against what defines them."""

import numpy as np
import pytest

from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.filters import low_pass, notch

RATE_HZ = 5000.0


def at(biquad, *frequency_hz):
    return biquad.response(np.exp(2j * np.pi * np.array(frequency_hz) / RATE_HZ))


def test_a_notch_has_its_depth_at_its_frequency_and_leaves_the_rest():
    gains = np.abs(at(notch(420.0, 0.7, 0.05, RATE_HZ), 1e-3, 420.0, 2500.0))
    np.testing.assert_allclose(gains, [1.0, 0.05, 1.0], rtol=1e-9)


def test_a_notch_turns_the_phase_by_nothing_at_its_frequency():
    assert abs(np.angle(at(notch(420.0, 0.7, 0.05, RATE_HZ), 420.0)[0])) < 1e-9


def test_a_low_pass_is_three_decibels_down_at_its_frequency():
    gains = np.abs(at(low_pass(800.0, RATE_HZ), 1e-3, 800.0, 2499.999))
    np.testing.assert_allclose(gains, [1.0, np.sqrt(0.5), 0.0], atol=1e-9)


@pytest.mark.parametrize("frequency_hz", [0.0, 2500.0, float("nan")])
def test_a_frequency_beyond_half_the_rate_is_refused(frequency_hz):
    with pytest.raises(FeedbackError, match="below half the loop's rate, 2500 Hz"):
        low_pass(frequency_hz, RATE_HZ)
