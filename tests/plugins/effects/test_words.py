"""All texts of the effects that the panel shows are in its translation catalogue."""

from rotemina.plugins.effects.words import (
    format_name,
    iterate_translatable_texts,
    translate_meaning,
)
from rotemina.sim.effects import EffectStage, load_all_effects


def test_all_effect_texts_are_in_the_catalogue():
    effects, _ = load_all_effects()
    shipped_effects = [
        effect for effect in effects.values() if type(effect).__module__.startswith("rotemina.")
    ]
    formulations = [
        formulation for effect in shipped_effects for formulation in effect.formulations
    ]
    catalogue_texts = set(iterate_translatable_texts())
    assert {
        text for effect in shipped_effects for text in (effect.title, effect.summary)
    } <= catalogue_texts
    assert {format_name(formulation.name) for formulation in formulations} <= catalogue_texts
    assert {stage.value for stage in EffectStage} <= catalogue_texts
    meanings = {
        parameter.meaning for formulation in formulations for parameter in formulation.parameters
    }
    full_texts = {text for text in meanings if len(text) > 2 and "Butterworth" not in text}
    numbered_texts = {text for text in full_texts if "of the play with threshold" in text}
    assert full_texts - numbered_texts <= catalogue_texts
    assert not numbered_texts & catalogue_texts
    assert {translate_meaning(text) for text in numbered_texts} == numbered_texts
