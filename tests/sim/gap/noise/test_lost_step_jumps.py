"""Jumps of a reading count only if they are as large and as sudden as lost steps."""

import numpy as np

from rotemina.sim.gap.noise.lost_step_jumps import jumps

RATE_HZ = 1000.0
TIME_S = np.arange(8000) / RATE_HZ
NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


def test_jumps_smaller_or_slower_than_lost_steps_are_ignored():
    step = np.where(TIME_S > 3.0, 1.0, 0.0)
    assert [round(size) for _, size in jumps(TIME_S, 5.0 * step + 0.01 * NOISE, 5.0)] == [5]
    assert jumps(TIME_S, 2.0 * step + 0.01 * NOISE, 5.0) == []
    slow = np.clip((TIME_S - 3.0) / 0.5, 0.0, 1.0)
    assert jumps(TIME_S, 5.0 * slow + 0.01 * NOISE, 5.0) == []
