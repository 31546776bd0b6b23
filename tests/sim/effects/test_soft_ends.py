"""The ends of an amplifier, read from the voltages that it gave."""

import numpy as np
import pytest

from rotemina.sim.effects.saturation import soft
from rotemina.sim.effects.soft_ends import Bend, bent_ends


def given(asked, bend):
    return np.array([soft(one, 0.0, 0.0, 0.0, 0.0, 0.0, bend, None) for one in asked])


def test_both_ends_and_their_softness_come_back():
    rng = np.random.default_rng(1)
    asked = rng.uniform(-20.0, 140.0, 3000)
    truth = Bend(-4.0, 112.0, 0.06)
    seen = given(asked, truth) + rng.normal(0.0, 3e-3, len(asked))
    found = bent_ends(asked, seen, (seen.min(), seen.max()))
    assert found == pytest.approx(truth, rel=1e-3)


def test_an_end_that_was_not_come_near_may_be_anywhere_beyond():
    asked = np.linspace(-30.0, 60.0, 2000)
    truth = Bend(-4.0, 400.0, 0.02)
    seen = given(asked, truth)
    found = bent_ends(asked, seen, (seen.min(), seen.max())).without_high(400.0)
    assert found.low == pytest.approx(truth.low, abs=0.5)
    assert np.abs(given(asked, found) - seen).max() < 1.0
    assert found.without_low(-300.0).low == -300.0
