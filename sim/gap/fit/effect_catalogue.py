"""The installed effects, looked up by their properties instead of their names."""

from functools import lru_cache

from rotemina.sim.effects import (
    AxisProperties,
    Effect,
    EffectFamily,
    EffectRelations,
    EffectSignature,
    Formulation,
    list_effect_ids,
    load_all_effects,
    load_effect,
)
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.robot import AxisEffect


def catalogue() -> tuple[Effect, ...]:
    """Return the installed effects in the order of the signal chain."""
    return _loaded(list_effect_ids())


@lru_cache(maxsize=4)
def _loaded(_ids: tuple[str, ...]) -> tuple[Effect, ...]:
    return tuple(load_all_effects()[0].values())


def shown_as(sign: EffectSignature) -> str | None:
    """Return the effect that shows by a sign; None if none is installed."""
    return next((one.id for one in catalogue() if one.identification.shows_as is sign), None)


def with_parameter(name: str) -> tuple[Effect, Formulation] | None:
    """Return the first effect and formulation that have a parameter."""
    return next(
        (
            (one, form)
            for one in catalogue()
            for form in one.formulations
            if form.find_parameter(name)
        ),
        None,
    )


def by_spectra(*, coupled: bool) -> tuple[Effect, Formulation] | None:
    """Return the effect whose many parameters are found at once from spectra."""
    return next(
        (
            (one, form)
            for one in catalogue()
            for form in one.formulations
            if form.by_spectra and one.coupled is coupled
        ),
        None,
    )


def is_stepped(effect_id: str) -> bool:
    """Tell whether an effect acts by jumps on a grid."""
    return load_effect(effect_id).identification.stepped


def kinship_of(effect_id: str) -> EffectRelations:
    """Return how an effect relates to others."""
    return load_effect(effect_id).kinship


def is_of(family: EffectFamily, effect_id: str) -> bool:
    """Tell whether an effect is of a family."""
    return kinship_of(effect_id).family is family


def brought_along(effect_id: str, by: str) -> float:
    """Return the share of the gap's power above which an effect is a cause next to another one."""
    family = kinship_of(effect_id).family
    return 0.0 if family is None else kinship_of(by).brings_along.get(family, 0.0)


def baseline(evidence: Evidence) -> tuple[AxisEffect, ...]:
    """Return the re-tuning of an axis' own parameters, from none on.

    A missing effect must not be taken for a wrong parameter, nor a wrong parameter for an effect.
    """
    facts = AxisProperties.of(evidence.robot.axes[evidence.axis])
    found = []
    for effect in catalogue():
        own = effect.identification.retunes(facts)
        if own is not None and facts.kind in effect.kinds:
            found.append(
                AxisEffect(
                    axis=evidence.axis,
                    id=effect.id,
                    formulation=own.formulation,
                    parameters=dict(own.values),
                )
            )
    return tuple(found)


def is_own(evidence: Evidence, effect: AxisEffect) -> bool:
    """Tell whether an effect is no more than the model's own parameters are."""
    own = {(one.id, one.formulation) for one in baseline(evidence)}
    return is_whole_own(effect.id) or (effect.id, effect.formulation) in own


def is_whole_own(effect_id: str) -> bool:
    """Tell whether an effect only changes numbers of the model, in any formulation."""
    effect = load_effect(effect_id)
    return len(effect.formulations) == 1 and effect.identification.is_retuning
