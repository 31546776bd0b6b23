"""The grid of a coarse sensor is distinguished from the steps of a drive."""

import numpy as np
import pytest

from rotemina.sim.gap.noise.reading_increment import coarse_step, stands_on

RATE_HZ = 1000.0
TIME_S = np.arange(8000) / RATE_HZ
NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


def test_a_coarse_grid_is_found_if_noise_does_not_fill_it():
    path = 1000.0 * np.sin(2 * np.pi * 0.2 * TIME_S)
    expected = np.rint(path + NOISE)
    assert coarse_step(8.0 * np.rint(path / 8.0), expected, 1.0) == pytest.approx(8.0, rel=0.01)
    assert coarse_step(np.rint(path + NOISE[::-1]), expected, 1.0) is None


def test_steps_of_a_drive_are_not_the_grid_of_a_sensor():
    path = 1000.0 * np.sin(2 * np.pi * 0.2 * TIME_S)
    quick = 30000.0 * np.sin(2 * np.pi * 3.0 * TIME_S)
    assert stands_on(8.0 * np.rint(quick / 8.0), np.rint(quick + NOISE), 1.0, 8.0)
    moved = 8.0 * np.rint(path / 8.0)
    # The axis rests at each step for a while.
    lagging = np.convolve(moved, np.ones(40) / 40.0, mode="same")
    assert not stands_on(np.rint(lagging), np.rint(path + NOISE), 1.0, 8.0)
