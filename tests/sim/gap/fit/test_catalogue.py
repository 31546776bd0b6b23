"""Effects found by what they are, not by their names."""

import pytest

from rotemina.sim.effects.identification import Sign
from rotemina.sim.effects.kinship import Family
from rotemina.sim.gap.fit.catalogue import (
    brought_along,
    by_spectra,
    catalogue,
    is_of,
    shown_as,
    with_parameter,
)


def test_each_sign_shows_an_effect_and_no_two_show_the_same():
    shown = [shown_as(sign) for sign in Sign]
    assert None not in shown
    assert len(set(shown)) == len(shown)


@pytest.mark.parametrize("coupled", [False, True])
def test_what_is_found_from_spectra_acts_from_the_axis_that_is_asked_for(coupled):
    effect, formulation = by_spectra(coupled=coupled)
    assert effect.coupled is coupled
    assert formulation in effect.formulations


def test_no_effect_has_an_unknown_parameter():
    assert with_parameter("no such parameter") is None
    effect, formulation = with_parameter("width")
    assert formulation in effect.formulations
    assert formulation.parameter("width")


def test_what_an_effect_brings_along_is_of_a_family_and_a_share():
    for one in catalogue():
        for other in catalogue():
            share = brought_along(one.id, other.id)
            assert 0.0 <= share <= 1.0
            assert share == 0.0 or any(is_of(family, one.id) for family in Family)
