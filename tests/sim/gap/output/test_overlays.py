"""A thinned path keeps its shape."""

import numpy as np
import pytest

from rotemina.sim.gap.output.overlays import thin_path


def test_a_thinned_path_keeps_its_ends_and_its_shape():
    phase = np.linspace(0.0, 40.0 * np.pi, 200_001)
    x, y = thin_path(np.cos(phase), np.sin(phase), 2000)
    assert 1000 < len(x) <= 2001
    assert (x[0], y[0]) == pytest.approx((1.0, 0.0))
    assert np.hypot(x, y) == pytest.approx(np.ones(len(x)))
    assert np.ptp(x) == pytest.approx(2.0, abs=0.02)
    point = thin_path(np.zeros(100), np.zeros(100), 50)
    assert len(point[0]) == 2
