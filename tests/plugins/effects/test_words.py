"""Words of the model that the effects panel shows: each is marked for translation."""

from rotemina.plugins.effects.parameter_meanings import MEANINGS, meaning_of
from rotemina.plugins.effects.words import EFFECTS, FORMULATIONS, STAGES, spoken
from rotemina.sim.effects.formulation import Stage
from rotemina.sim.effects.registry import all_effects


def test_every_word_of_the_catalogue_is_marked():
    effects, _ = all_effects()
    own = [one for one in effects.values() if type(one).__module__.startswith("rotemina.")]
    formulations = [each for one in own for each in one.formulations]
    assert {text for one in own for text in (one.title, one.summary)} <= set(EFFECTS)
    assert {spoken(each.name) for each in formulations} <= set(FORMULATIONS)
    assert {stage.value for stage in Stage} == set(STAGES)
    meanings = {p.meaning for each in formulations for p in each.parameters}
    words = {text for text in meanings if len(text) > 2 and "Butterworth" not in text}
    weights = {text for text in words if "of the play with threshold" in text}
    assert words - weights <= set(MEANINGS)
    assert {meaning_of(text) for text in weights} == weights
