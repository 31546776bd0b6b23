"""A black-box model that searches a residual for dependencies."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.location import probe_residual
from rotemina.sim.records import Tap

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from short_records import make_evidence


@pytest.fixture(scope="module")
def evidence():
    return make_evidence()


def make_noise(evidence):
    return np.random.default_rng(0).standard_normal(evidence.parts[-1].rows.stop)


def test_noise_has_no_features(evidence):
    probe = probe_residual(evidence, make_noise(evidence))
    assert probe.score == pytest.approx(1.0, abs=0.1)
    assert probe.depends_on == ()


def test_a_remainder_that_changes_sign_with_the_motion_depends_on_its_direction(evidence):
    remainder = make_noise(evidence)
    for part in evidence.parts:
        command = evidence.observations[part.record].record.signal("zn", Tap.CMD)
        remainder[part.rows] += 20.0 * np.sign(np.gradient(command))
    probe = probe_residual(evidence, remainder)
    assert probe.score < 0.1 * np.mean(remainder**2)
    assert probe.depends_on[0][0] == "direction"
