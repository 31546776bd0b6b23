"""Words of the model that the effects panel shows: each is among those that are translated."""

from rotemina.plugins.effects.words import catalogue, meaning_of, spoken
from rotemina.sim.effects.formulation import Stage
from rotemina.sim.effects.registry import all_effects


def test_every_word_of_the_catalogue_is_said():
    effects, _ = all_effects()
    own = [one for one in effects.values() if type(one).__module__.startswith("rotemina.")]
    formulations = [each for one in own for each in one.formulations]
    said = set(catalogue())
    assert {text for one in own for text in (one.title, one.summary)} <= said
    assert {spoken(each.name) for each in formulations} <= said
    assert {stage.value for stage in Stage} <= said
    meanings = {p.meaning for each in formulations for p in each.parameters}
    words = {text for text in meanings if len(text) > 2 and "Butterworth" not in text}
    weights = {text for text in words if "of the play with threshold" in text}
    assert words - weights <= said
    assert not weights & said
    assert {meaning_of(text) for text in weights} == weights
