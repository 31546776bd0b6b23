"""Explanations: causes beside the model's own parameters."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.compare.explanations import beside, explanation, mean_squares, untouched
from rotemina.sim.gap.fit.baseline import baseline
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.records.record import Tap

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from short_records import GAIN, LATE, evidence


@pytest.fixture(scope="module")
def seen():
    return evidence(GAIN)


def test_a_cause_takes_the_place_of_the_own_parameter_that_it_is(seen):
    ids = [one.id for one in beside(seen, [GAIN])]
    assert ids.count(GAIN.id) == 1
    assert ids[0] == GAIN.id
    assert set(ids) == {one.id for one in (GAIN, *baseline(seen))}


def test_own_parameters_start_from_where_an_earlier_explanation_left_them(seen):
    tuned = fit(seen, beside(seen, [LATE]), most_steps=0)
    own = tuple(
        replace(one, parameters=dict.fromkeys(one.parameters, 0.01)) for one in tuned.effects[1:]
    )
    begun = explanation(seen, 1, replace(tuned, effects=(tuned.effects[0], *own)))
    assert tuple(beside(seen, [LATE], begun)[1:]) == own


def test_a_residual_is_counted_tap_by_tap(seen):
    left = np.zeros(seen.parts[-1].rows.stop)
    for part in seen.parts:
        left[part.rows] = 2.0 if part.tap is Tap.MEAS else 1.0
    squares = mean_squares(seen, left)
    assert squares == {tap: 4.0 if tap is Tap.MEAS else 1.0 for tap in squares}
    assert Tap.MEAS in squares


def test_the_untouched_model_leaves_the_gap_and_has_no_causes(seen):
    bare = untouched(seen)
    assert bare.causes == ()
    assert bare.held_out == pytest.approx(seen.residual(()), abs=1e-9)
    assert bare.score > 10.0
