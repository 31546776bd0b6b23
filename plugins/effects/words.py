"""Texts of the effects in the UI language.

Effects are described in English. A text without a translation, such as that of a plugin's effect,
is shown in English.
"""

import re
from collections.abc import Iterator

from rotemina.plugins.effects import tr
from rotemina.sim.effects import Effect, EffectStage, is_built_in, load_all_effects

_WEIGHT_PATTERN = re.compile(
    r"(?P<name>w\d+), weight of the play with threshold (?P<threshold>\S+)"
)


def iterate_translatable_texts() -> Iterator[str]:
    """Yield the texts of the built-in effects; ``make languages`` collects them for translation."""
    yield from (stage.value for stage in EffectStage)
    effects, _ = load_all_effects()
    for effect in effects.values():
        if is_built_in(effect.id):
            yield from (effect.title, effect.summary)
            for formulation in effect.formulations:
                yield format_name(formulation.name)
                yield from (
                    parameter.meaning
                    for parameter in formulation.parameters
                    if _is_translatable(parameter.meaning)
                )


def _is_translatable(meaning: str) -> bool:
    """Return whether the meaning of a parameter is translated as a whole.

    It is not if it is a symbol of at most two characters, contains a proper name, or is made from
    the template of ``_WEIGHT_PATTERN``, which :func:`translate_meaning` fills in.
    """
    return (
        len(meaning) > 2 and "Butterworth" not in meaning and not _WEIGHT_PATTERN.fullmatch(meaning)
    )


def effect_title(effect: Effect) -> str:
    """Return the title of an effect."""
    return tr(effect.title)


def effect_summary(effect: Effect) -> str:
    """Return the summary of an effect."""
    return tr(effect.summary)


def stage_name(stage: EffectStage) -> str:
    """Return the name of a stage of the signal chain."""
    return tr(stage.value)


def formulation_name(name: str) -> str:
    """Return the name of a formulation."""
    return tr(format_name(name))


def format_name(name: str) -> str:
    """Return the name of a formulation or a parameter with spaces instead of underscores."""
    return name.replace("_", " ")


def translate_meaning(text: str) -> str:
    """Return the meaning of a parameter in the UI language. Symbols are not translated."""
    match = _WEIGHT_PATTERN.fullmatch(text)
    if match is None:
        return tr(text) if text else text
    return tr("{name}, weight of the play with threshold {threshold}").format(**match.groupdict())
