"""Steady spectral lines of a gap are distinguished from decaying ones."""

import numpy as np
import pytest

from rotemina.sim.gap.noise.vibration_lines import tones

RATE_HZ = 1000.0
TIME_S = np.arange(8000) / RATE_HZ
NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


def test_a_decaying_line_is_not_a_vibration():
    resting = np.zeros(len(TIME_S), dtype=bool)
    tone = 3.0 * np.sin(2 * np.pi * 23.0 * TIME_S)
    assert tones(TIME_S, tone + NOISE, resting) == pytest.approx([23.0], abs=0.05)
    assert tones(TIME_S, tone * np.exp(-TIME_S) + NOISE, resting) == []
