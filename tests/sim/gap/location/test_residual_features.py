"""A black box that looks for what is left in a residual."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.location.residual_features import probed
from rotemina.sim.records.record import Tap

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from short_records import evidence


@pytest.fixture(scope="module")
def seen():
    return evidence()


def noise(seen):
    return np.random.default_rng(0).standard_normal(seen.parts[-1].rows.stop)


def test_noise_is_left_as_it_is(seen):
    found = probed(seen, noise(seen))
    assert found.score == pytest.approx(1.0, abs=0.1)
    assert found.depends_on == ()


def test_a_remainder_that_turns_with_the_motion_depends_on_its_direction(seen):
    remainder = noise(seen)
    for part in seen.parts:
        command = seen.observations[part.record].record.signal("zn", Tap.CMD)
        remainder[part.rows] += 20.0 * np.sign(np.gradient(command))
    found = probed(seen, remainder)
    assert found.score < 0.1 * np.mean(remainder**2)
    assert found.depends_on[0][0] == "direction"
