"""The installed effects: entry points of the group ``rotemina.effects``.

Built-in effects and those of plugins register in the same way. Each is loaded at its first use, so
a robot without effects loads none.
"""

from difflib import get_close_matches
from functools import cache
from importlib.metadata import EntryPoint, entry_points

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.formulation import Effect, Stage
from rotemina.sim.messages import message
from rotemina.sim.plugin_points import API_VERSIONS, PluginError, load, require_version

GROUP = "rotemina.effects"


@cache
def _points() -> dict[str, EntryPoint]:
    """Return the entry points by id; of two with one id the built-in one."""
    ordered = sorted(entry_points(group=GROUP), key=lambda p: (not _built_in(p), p.value))
    points: dict[str, EntryPoint] = {}
    for point in ordered:
        points.setdefault(point.name, point)
    return points


def _built_in(point: EntryPoint) -> bool:
    return point.value.startswith("rotemina.sim.effects.")


def is_built_in(effect_id: str) -> bool:
    """Tell whether an installed effect is one of the program's own, and no plugin's."""
    return _built_in(_points()[effect_id])


def effect_ids() -> tuple[str, ...]:
    """Return the ids of all installed effects, sorted."""
    return tuple(sorted(_points()))


@cache
def effect_named(effect_id: str) -> Effect:
    """Return an installed effect.

    Raises
    ------
    EffectError
        If there is none of that id, or it cannot be loaded, with the reason.
    """
    point = _points().get(effect_id)
    if point is None:
        near = get_close_matches(effect_id, _points(), n=1)
        meant = f"did you mean {near[0]!r}? " if near else ""
        known = ", ".join(sorted(_points()))
        raise EffectError(
            message("engine", "there is no effect {effect_id}; {meant}available: {known}").fill(
                effect_id=repr(effect_id), meant=meant, known=known
            )
        )
    try:
        effect = load(point)
        if not isinstance(effect, Effect):
            raise EffectError(
                message("engine", "effect {effect_id} ({value}) is not an Effect").fill(
                    effect_id=repr(effect_id), value=point.value
                )
            )
        require_version(point, effect.api_version, API_VERSIONS[GROUP])
    except PluginError as error:
        raise EffectError(
            message("engine", "effect {effect_id}: {error}").fill(
                effect_id=repr(effect_id), error=str(error)
            )
        ) from error
    if effect.id != effect_id:
        raise EffectError(
            message("engine", "effect {effect_id} ({value}) has the id {id}").fill(
                effect_id=repr(effect_id), value=point.value, id=repr(effect.id)
            )
        )
    if not effect.formulations:
        raise EffectError(
            message("engine", "effect {effect_id} ({value}) has no formulation").fill(
                effect_id=repr(effect_id), value=point.value
            )
        )
    return effect


def all_effects() -> tuple[dict[str, Effect], dict[str, str]]:
    """Return the effects by id in the order of the signal chain, and why others are left out."""
    found: dict[str, Effect] = {}
    broken: dict[str, str] = {}
    for effect_id in effect_ids():
        try:
            found[effect_id] = effect_named(effect_id)
        except EffectError as error:
            broken[effect_id] = str(error)
    for point in entry_points(group=GROUP):
        taken = _points().get(point.name)
        if taken is not None and point.value != taken.value:
            broken[f"{point.name} ({point.value})"] = "another effect already has this id"
    order = list(Stage)
    ranked = sorted(found.values(), key=lambda effect: (order.index(effect.stage), effect.id))
    return {effect.id: effect for effect in ranked}, broken
