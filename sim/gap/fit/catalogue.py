"""The installed effects, looked up by their properties instead of their names."""

from functools import lru_cache

from rotemina.sim.effects.formulation import Effect, Formulation
from rotemina.sim.effects.identification import Sign
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.registry import all_effects, effect_ids, effect_named


def catalogue() -> tuple[Effect, ...]:
    """Return the installed effects in the order of the signal chain."""
    return _loaded(effect_ids())


@lru_cache(maxsize=4)
def _loaded(_ids: tuple[str, ...]) -> tuple[Effect, ...]:
    return tuple(all_effects()[0].values())


def shown_as(sign: Sign) -> str | None:
    """Return the effect that shows by a sign; None if none is installed."""
    return next((one.id for one in catalogue() if one.identification.shows_as is sign), None)


def with_parameter(name: str) -> tuple[Effect, Formulation] | None:
    """Return the first effect and formulation that have a parameter."""
    return next(
        ((one, form) for one in catalogue() for form in one.formulations if form.parameter(name)),
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
    return effect_named(effect_id).identification.stepped


def kinship_of(effect_id: str) -> Kinship:
    """Return how an effect relates to others."""
    return effect_named(effect_id).kinship


def is_of(family: Family, effect_id: str) -> bool:
    """Tell whether an effect is of a family."""
    return kinship_of(effect_id).family is family


def brought_along(effect_id: str, by: str) -> float:
    """Return the share of the gap's power above which an effect is a cause next to another one."""
    family = kinship_of(effect_id).family
    return 0.0 if family is None else kinship_of(by).brings_along.get(family, 0.0)
