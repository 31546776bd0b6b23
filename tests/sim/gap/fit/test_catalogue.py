"""Effects are found by their properties, not by their names."""

import pytest

from rotemina.sim.effects import EffectFamily, EffectSignature
from rotemina.sim.gap.fit import (
    brought_along,
    by_spectra,
    catalogue,
    is_of,
    shown_as,
    with_parameter,
)


def test_each_signature_belongs_to_a_different_effect():
    effects = [shown_as(signature) for signature in EffectSignature]
    assert None not in effects
    assert len(set(effects)) == len(effects)


@pytest.mark.parametrize("coupled", [False, True])
def test_the_effect_for_spectra_is_coupled_if_requested(coupled):
    effect, formulation = by_spectra(coupled=coupled)
    assert effect.coupled is coupled
    assert formulation in effect.formulations


def test_no_effect_has_an_unknown_parameter():
    assert with_parameter("no such parameter") is None
    effect, formulation = with_parameter("width")
    assert formulation in effect.formulations
    assert formulation.find_parameter("width")


def test_companions_belong_to_a_family_and_have_a_share():
    for effect in catalogue():
        for other in catalogue():
            share = brought_along(effect.id, other.id)
            assert 0.0 <= share <= 1.0
            assert share == 0.0 or any(is_of(family, effect.id) for family in EffectFamily)
