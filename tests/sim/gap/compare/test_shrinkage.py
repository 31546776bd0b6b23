"""Shrinkage of the gap, cause by cause."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.compare import (
    LeftBy,
    closing,
    shrinkage,
    untouched,
)
from rotemina.sim.gap.compare.explanations import explanation
from rotemina.sim.gap.fit import fit
from rotemina.sim.gap.location import ResidualProbe
from rotemina.sim.records import Tap

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from short_records import DELAY, GAIN, make_evidence


@pytest.fixture(scope="module")
def evidence():
    return make_evidence(GAIN, DELAY)


@pytest.fixture(scope="module")
def gap_shrinkage(evidence):
    """Shrinkage by the true causes, as if they had been fitted."""
    best = explanation(evidence, 2, fit(evidence, [GAIN, DELAY], most_steps=0))
    rng, probe = np.random.default_rng(0), ResidualProbe(best.held_out, ())
    return shrinkage(
        evidence, untouched(evidence), best, probe, Tap.MEAS, rng, LeftBy(evidence, best)
    )


def test_each_cause_closes_its_part_and_the_parts_add_up(gap_shrinkage):
    assert [step.effect for step in gap_shrinkage.steps] == [GAIN.id, DELAY.id]
    assert gap_shrinkage.raw > gap_shrinkage.steps[0].rms > gap_shrinkage.steps[1].rms
    assert gap_shrinkage.steps[1].rms == pytest.approx(gap_shrinkage.corrected)
    assert sum(step.shapley for step in gap_shrinkage.steps) == pytest.approx(gap_shrinkage.closed)
    assert gap_shrinkage.closed > 0.99


def test_the_interval_contains_the_share(gap_shrinkage):
    low, high = gap_shrinkage.closed_interval
    assert low <= gap_shrinkage.closed <= high


def test_without_a_gap_nothing_is_closed(evidence):
    noise = np.random.default_rng(0).standard_normal(evidence.parts[-1].rows.stop)
    rng = np.random.default_rng(1)
    assert closing(evidence, noise, 0.5 * noise, Tap.MEAS, rng) == (None, None)
