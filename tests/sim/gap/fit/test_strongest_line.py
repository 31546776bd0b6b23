"""Spectral lines in a remainder over position."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.strongest_line import line_over

BOUNDS = (1e-4, 4e-3)
POSITION = np.linspace(0.01, 0.05, 20_000)
RNG = np.random.default_rng(0)


def make_wave(period, amplitude=1e-6):
    return amplitude * np.sin(2 * np.pi * POSITION / period + 0.7)


def test_the_strongest_of_two_periods_is_found_despite_noise_and_a_slope():
    gap = (
        make_wave(1e-3)
        + make_wave(3.1e-4, 4e-7)
        + 1e-3 * POSITION
        + 2e-7 * RNG.standard_normal(len(POSITION))
    )
    assert line_over(POSITION, gap, BOUNDS) == pytest.approx(1e-3, rel=0.01)


def test_a_long_hold_counts_as_one_position():
    position = np.concatenate([POSITION, np.full(50_000, POSITION[-1])])
    gap = np.concatenate([make_wave(1e-3), 5e-6 * np.sin(np.arange(50_000) / 50.0)])
    assert line_over(position, gap, BOUNDS) == pytest.approx(1e-3, rel=0.01)


def test_a_travel_that_is_too_short_has_no_line():
    assert line_over(POSITION[:50], make_wave(1e-4)[:50], BOUNDS) is None


def test_a_line_beyond_the_bounds_is_not_named():
    period = line_over(POSITION, make_wave(1e-3), (1e-4, 5e-4))
    assert period is not None
    assert period <= 5e-4
