"""What the catalogue says of its effects, in the language of the window.

The model says it in English. What has no translation, as a plugin's effect, is shown as it is.
"""

import re
from collections.abc import Iterator

from rotemina.plugins.effects import tr
from rotemina.sim.effects.formulation import Effect, Stage
from rotemina.sim.effects.registry import all_effects, is_built_in

_WEIGHT = re.compile(r"(?P<name>w\d+), weight of the play with threshold (?P<threshold>\S+)")


def catalogue() -> Iterator[str]:
    """Yield the words of the shipped effects: ``make languages`` looks here for what is said."""
    yield from (stage.value for stage in Stage)
    for effect in all_effects()[0].values():
        if is_built_in(effect.id):
            yield from (effect.title, effect.summary)
            for formulation in effect.formulations:
                yield spoken(formulation.name)
                yield from (one.meaning for one in formulation.parameters if _is_said(one.meaning))


def _is_said(meaning: str) -> bool:
    """Whether a meaning is more than a symbol, a name, or a weight, which is filled in."""
    return len(meaning) > 2 and "Butterworth" not in meaning and not _WEIGHT.fullmatch(meaning)


def effect_title(effect: Effect) -> str:
    """Return what an effect is called."""
    return tr(effect.title)


def effect_summary(effect: Effect) -> str:
    """Return the characteristic of an effect."""
    return tr(effect.summary)


def stage_name(stage: Stage) -> str:
    """Return what a stage of the signal chain is called."""
    return tr(stage.value)


def formulation_name(name: str) -> str:
    """Return what a formulation is called."""
    return tr(spoken(name))


def spoken(name: str) -> str:
    """Return the name of a formulation or a parameter as people write it."""
    return name.replace("_", " ")


def meaning_of(text: str) -> str:
    """Return what a parameter means in the language of the window; symbols stay."""
    weight = _WEIGHT.fullmatch(text)
    if weight is None:
        return tr(text) if text else text
    return tr("{name}, weight of the play with threshold {threshold}").format(**weight.groupdict())
