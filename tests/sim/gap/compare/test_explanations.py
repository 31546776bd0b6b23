"""Explanations: causes in addition to the parameters of the model."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.sim.gap.compare import untouched
from rotemina.sim.gap.compare.explanations import beside, explanation
from rotemina.sim.gap.fit import baseline, fit

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from short_records import DELAY, GAIN, make_evidence


@pytest.fixture(scope="module")
def evidence():
    return make_evidence(GAIN)


def test_a_cause_replaces_the_model_parameter_that_it_equals(evidence):
    ids = [effect.id for effect in beside(evidence, [GAIN])]
    assert ids.count(GAIN.id) == 1
    assert ids[0] == GAIN.id
    assert set(ids) == {effect.id for effect in (GAIN, *baseline(evidence))}


def test_model_parameters_start_from_an_earlier_explanation(evidence):
    tuned = fit(evidence, beside(evidence, [DELAY]), most_steps=0)
    model_effects = tuple(
        replace(effect, parameters=dict.fromkeys(effect.parameters, 0.01))
        for effect in tuned.effects[1:]
    )
    earlier = explanation(evidence, 1, replace(tuned, effects=(tuned.effects[0], *model_effects)))
    assert tuple(beside(evidence, [DELAY], earlier)[1:]) == model_effects


def test_the_untouched_model_leaves_the_gap_and_has_no_causes(evidence):
    explanation_without_causes = untouched(evidence)
    assert explanation_without_causes.causes == ()
    assert explanation_without_causes.held_out == pytest.approx(evidence.residual(()), abs=1e-9)
    assert explanation_without_causes.score > 10.0
