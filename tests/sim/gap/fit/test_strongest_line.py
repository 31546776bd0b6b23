"""Lines in a remainder over position."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.strongest_line import line_over

BOUNDS = (1e-4, 4e-3)
PLACE = np.linspace(0.01, 0.05, 20_000)
RNG = np.random.default_rng(0)


def wave(period, size=1e-6):
    return size * np.sin(2 * np.pi * PLACE / period + 0.7)


def test_the_strongest_of_two_periods_is_found_in_noise_and_beside_a_slope():
    gap = wave(1e-3) + wave(3.1e-4, 4e-7) + 1e-3 * PLACE + 2e-7 * RNG.standard_normal(len(PLACE))
    assert line_over(PLACE, gap, BOUNDS) == pytest.approx(1e-3, rel=0.01)


def test_a_long_hold_counts_as_one_place():
    place = np.concatenate([PLACE, np.full(50_000, PLACE[-1])])
    gap = np.concatenate([wave(1e-3), 5e-6 * np.sin(np.arange(50_000) / 50.0)])
    assert line_over(place, gap, BOUNDS) == pytest.approx(1e-3, rel=0.01)


def test_too_short_a_way_has_no_line():
    assert line_over(PLACE[:50], wave(1e-4)[:50], BOUNDS) is None


def test_a_line_beyond_the_bounds_is_not_named():
    found = line_over(PLACE, wave(1e-3), (1e-4, 5e-4))
    assert found is not None
    assert found <= 5e-4
