"""A gap counts only beyond the quantization cells of a coarse reading."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.reading_cells import beyond

RATE_HZ = 1000.0


TIME_S = np.arange(8000) / RATE_HZ


def test_a_gap_beyond_cells_is_found_for_any_offset():
    gap = np.linspace(-3.0, 5.0, 4001)
    remainder = beyond(gap, 1.0, None)
    # The smallest remainder is symmetric, because the mean is removed.
    assert remainder.min() == pytest.approx(-3.0, abs=0.01)
    assert remainder.max() == pytest.approx(3.0, abs=0.01)
    assert np.abs(beyond(0.9 * np.sin(TIME_S) + 70.0, 1.0, None)).max() < 1e-3
    is_used = np.ones(len(gap), dtype=bool)
    is_used[-500:] = False
    partial_remainder = beyond(gap, 1.0, is_used)
    assert not partial_remainder[~is_used].any()
    assert partial_remainder[is_used].max() == pytest.approx(
        -partial_remainder[is_used].min(), abs=0.01
    )
