"""How far the gap shrinks cause by cause."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.compare.explanations import explanation, untouched
from rotemina.sim.gap.compare.shrinkage import LeftBy, closing, shrinkage
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.gap.location.residual_features import Probe
from rotemina.sim.records.record import Tap

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from short_records import GAIN, LATE, evidence


@pytest.fixture(scope="module")
def seen():
    return evidence(GAIN, LATE)


@pytest.fixture(scope="module")
def found(seen):
    """The true causes, as if they had been fitted."""
    best = explanation(seen, 2, fit(seen, [GAIN, LATE], most_steps=0))
    rng, probe = np.random.default_rng(0), Probe(best.held_out, ())
    return shrinkage(seen, untouched(seen), best, probe, Tap.MEAS, rng, LeftBy(seen, best))


def test_each_cause_takes_its_part_and_all_together_take_what_is_closed(found):
    assert [one.effect for one in found.steps] == [GAIN.id, LATE.id]
    assert found.raw > found.steps[0].rms > found.steps[1].rms
    assert found.steps[1].rms == pytest.approx(found.corrected)
    assert sum(one.shapley for one in found.steps) == pytest.approx(found.closed)
    assert found.closed > 0.99


def test_the_interval_holds_the_share(found):
    low, high = found.closed_interval
    assert low <= found.closed <= high


def test_without_a_gap_nothing_is_closed(seen):
    noise = np.random.default_rng(0).standard_normal(seen.parts[-1].rows.stop)
    rng = np.random.default_rng(1)
    assert closing(seen, noise, 0.5 * noise, Tap.MEAS, rng) == (None, None)
