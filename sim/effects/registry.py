"""Installed effects: entry points of the group ``rotemina.effects``.

Built-in effects and those of plugins register in the same way. Each is loaded when it is first
used, so a robot without effects loads none.
"""

from difflib import get_close_matches
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import TYPE_CHECKING

from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.effects.formulation import Effect, EffectStage
from rotemina.sim.errors import EffectError, PluginError
from rotemina.sim.plugin_points import API_VERSIONS, load_plugin, require_version

GROUP = "rotemina.effects"


@cache
def _find_entry_points() -> dict[str, EntryPoint]:
    """Return the entry points by id. A built-in effect takes precedence over a plugin."""
    ordered = sorted(entry_points(group=GROUP), key=lambda p: (not _is_built_in_point(p), p.value))
    points: dict[str, EntryPoint] = {}
    for point in ordered:
        points.setdefault(point.name, point)
    return points


def _is_built_in_point(point: EntryPoint) -> bool:
    return point.value.startswith("rotemina.sim.effects.")


def is_built_in(effect_id: str) -> bool:
    """Return whether an installed effect belongs to the program, not to a plugin."""
    return _is_built_in_point(_find_entry_points()[effect_id])


def list_effect_ids() -> tuple[str, ...]:
    """Return the sorted ids of all installed effects."""
    return tuple(sorted(_find_entry_points()))


@cache
def load_effect(effect_id: str) -> Effect:
    """Load an installed effect.

    Raises
    ------
    EffectError
        If there is no effect of this id, or it cannot be loaded, with the reason.
    """
    point = _find_entry_points().get(effect_id)
    if point is None:
        close_matches = get_close_matches(effect_id, _find_entry_points(), n=1)
        suggestion = f"did you mean {close_matches[0]!r}? " if close_matches else ""
        known_ids = ", ".join(sorted(_find_entry_points()))
        raise EffectError(
            "there is no effect {effect_id}; {meant}available: {known}",
            effect_id=repr(effect_id),
            meant=suggestion,
            known=known_ids,
        )
    try:
        effect = load_plugin(point)
        if not isinstance(effect, Effect):
            raise EffectError(
                "effect {effect_id} ({value}) is not an Effect",
                effect_id=repr(effect_id),
                value=point.value,
            )
        require_version(point, effect.api_version, API_VERSIONS[GROUP])
    except PluginError as error:
        raise EffectError(
            "effect {effect_id}: {error}", effect_id=repr(effect_id), error=str(error)
        ) from error
    if effect.id != effect_id:
        raise EffectError(
            "effect {effect_id} ({value}) has the id {id}",
            effect_id=repr(effect_id),
            value=point.value,
            id=repr(effect.id),
        )
    if not effect.formulations:
        raise EffectError(
            "effect {effect_id} ({value}) has no formulation",
            effect_id=repr(effect_id),
            value=point.value,
        )
    return effect


def load_all_effects() -> tuple[dict[str, Effect], dict[str, str]]:
    """Load all effects.

    Returns
    -------
    effects : dict
        Effects by id, in the order of the signal chain.
    broken : dict
        Reasons why effects cannot be loaded, by id.
    """
    effects: dict[str, Effect] = {}
    broken: dict[str, str] = {}
    for effect_id in list_effect_ids():
        try:
            effects[effect_id] = load_effect(effect_id)
        except EffectError as error:
            broken[effect_id] = str(error)
    for point in entry_points(group=GROUP):
        selected = _find_entry_points().get(point.name)
        if selected is not None and point.value != selected.value:
            broken[f"{point.name} ({point.value})"] = "another effect already has this id"
    order = list(EffectStage)
    ordered = sorted(effects.values(), key=lambda effect: (order.index(effect.stage), effect.id))
    return {effect.id: effect for effect in ordered}, broken


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        all_effects="load_all_effects",
        effect_ids="list_effect_ids",
        effect_named="load_effect",
    )
