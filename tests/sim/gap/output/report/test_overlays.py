"""A thinned path keeps its shape."""

import numpy as np
import pytest

from rotemina.sim.gap.output.report.overlays import path


def test_a_thinned_path_keeps_its_ends_and_its_shape():
    phase = np.linspace(0.0, 40.0 * np.pi, 200_001)
    across, up = path(np.cos(phase), np.sin(phase), 2000)
    assert 1000 < len(across) <= 2001
    assert (across[0], up[0]) == pytest.approx((1.0, 0.0))
    assert np.hypot(across, up) == pytest.approx(np.ones(len(across)))
    assert np.ptp(across) == pytest.approx(2.0, abs=0.02)
    still = path(np.zeros(100), np.zeros(100), 50)
    assert len(still[0]) == 2
