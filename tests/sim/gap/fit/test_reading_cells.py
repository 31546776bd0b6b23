"""A gap counts as far as it goes beyond the cells of a coarse reading."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.reading_cells import beyond

RATE_HZ = 1000.0


TIME_S = np.arange(8000) / RATE_HZ


def test_a_gap_beyond_cells_is_found_whatever_the_offset():
    gap = np.linspace(-3.0, 5.0, 4001)
    left = beyond(gap, 1.0, None)
    # What leaves least is as far beyond on either side: the middle is taken off.
    assert left.min() == pytest.approx(-3.0, abs=0.01)
    assert left.max() == pytest.approx(3.0, abs=0.01)
    assert np.abs(beyond(0.9 * np.sin(TIME_S) + 70.0, 1.0, None)).max() < 1e-3
    kept = np.ones(len(gap), dtype=bool)
    kept[-500:] = False
    some = beyond(gap, 1.0, kept)
    assert not some[~kept].any()
    assert some[kept].max() == pytest.approx(-some[kept].min(), abs=0.01)
