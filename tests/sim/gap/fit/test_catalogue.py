"""Effects are found by their properties, not by their names."""

from rotemina.sim.effects import EffectFamily, EffectSignature
from rotemina.sim.gap.fit import (
    brought_along,
    catalogue,
    is_of,
    shown_as,
)


def test_each_signature_belongs_to_a_different_effect():
    effects = [shown_as(signature) for signature in EffectSignature]
    assert None not in effects
    assert len(set(effects)) == len(effects)


def test_companions_belong_to_a_family_and_have_a_share():
    for effect in catalogue():
        for other in catalogue():
            share = brought_along(effect.id, other.id)
            assert 0.0 <= share <= 1.0
            assert share == 0.0 or any(is_of(family, effect.id) for family in EffectFamily)
