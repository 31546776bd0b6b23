"""Bands of a signal add up to it."""

import numpy as np
import pytest

from rotemina.sim.gap.location import split_into_bands

RATE_HZ = 1000.0


def test_bands_add_up_to_the_signal():
    rng = np.random.default_rng(3)
    signal = np.cumsum(rng.standard_normal(5001))
    time_s = np.arange(5001) / RATE_HZ
    parts = split_into_bands(time_s, signal, np.array([0.1, 1.0, 10.0, 100.0, 1000.0]))
    assert parts.shape == (4, 5001)
    assert parts.sum(axis=0) == pytest.approx(signal, abs=1e-9)
    assert np.sum(parts**2) == pytest.approx(np.sum(signal**2))
