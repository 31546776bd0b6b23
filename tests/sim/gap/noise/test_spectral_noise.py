"""The level of white noise, below lines and slow motion."""

import numpy as np
import pytest

from rotemina.sim.gap.noise.spectral_noise import common_level, noise_level, slow_level

RATE_HZ = 1000.0
TIME_S = np.arange(8000) / RATE_HZ
NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


def test_the_level_of_noise_is_found_below_lines_and_slow_motion():
    slow = 50.0 * np.sin(2 * np.pi * 0.4 * TIME_S) + 5.0 * np.sin(2 * np.pi * 60.0 * TIME_S)
    assert noise_level(2.5 * NOISE + slow) == pytest.approx(2.5, rel=0.12)
    # A random walk.
    assert noise_level(np.cumsum(NOISE)) == 0.0


def test_roughness_only_in_fast_motion_is_not_noise():
    quick = np.where(TIME_S % 1.0 < 0.8, 1.0 + np.sin(TIME_S), 0.0)
    resting = np.zeros(len(TIME_S))
    assert slow_level([(0.8 + 20.0 * quick) * NOISE] * 2, [quick] * 2) == pytest.approx(
        0.8, rel=0.2
    )
    rough, quiet = 20.0 * NOISE[::-1], 0.8 * NOISE
    assert slow_level([rough, quiet], [1.0 + quick, resting]) == pytest.approx(0.8, rel=0.1)
    assert slow_level([2.5 * NOISE + 50.0 * np.sin(TIME_S)], [quick]) == pytest.approx(2.5, rel=0.1)
    # Too short to determine a level.
    assert slow_level([NOISE[:2]], [resting[:2]]) == np.inf


def test_noise_in_only_one_record_does_not_count():
    assert common_level([1.0, 3.6, 0.9]) == 1.0
    # A drift gives no information about noise.
    assert common_level([0.0, 2.0, 2.1]) == 2.0
    assert common_level([0.0]) == 0.0
