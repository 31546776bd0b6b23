"""Whole sentences of the diagnosis, in the language of the window.

The diagnosis says them in English, as its reports have them: they are known here by their
templates, and by what stands in these. One that is not known is shown as the diagnosis says it.
"""

import re
from collections.abc import Callable, Mapping
from functools import cache

from rotemina.app.shell.language import marked, translate
from rotemina.plugins.gap.words import all_of, any_of, effect_word
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.gap.diagnosis import UNKNOWN

REMARKS = (
    marked("gap", "Its gap comes from what was found on other axes."),
    marked("gap", "It is coupled to axis {axis}, whose gap is larger and not explained."),
    marked("gap", "What is left depends on {groups}, as far as simple features predict it."),
    marked("gap", "{n} sudden jumps by whole multiples of four full steps were taken back."),
    marked("gap", "{n} spikes or dropouts of the sensor were left out."),
    marked("gap", "A vibration of {frequencies}, whatever the axis did, was set aside."),
    marked("gap", "The sensor reads in steps of {step}."),
    marked("gap", "The sensor is {times} times as noisy as declared."),
    marked("gap", "The axis was commanded but not measured: nothing is said of it."),
    marked("gap", "The axis was never commanded to move: only what acts without motion can show."),
    marked("gap", "The axis' own sensor was not recorded: nothing is said of that sensor."),
    marked(
        "gap",
        "No independent reference (ref) was recorded: effects of the sensor cannot be told from "
        "those of the axis.",
    ),
    marked(
        "gap",
        "The reading stands at exactly {stand}: either the axis does not follow, or the sensor is "
        "{fault}, and the records cannot tell which.",
    ),
    marked(
        "gap",
        "A command goes beyond the range {range}, to {value}; the model knows no ends of the "
        "range.",
    ),
    marked(
        "gap",
        "The {tap} channel is {gain} × what is commanded, which no single effect brings about: "
        "check signs, units and the gain in the robot file.",
    ),
    marked(
        "gap",
        "Time leaps {n} ×, by up to {time} s: the record is split there, and what came before a "
        "piece is unknown.",
    ),
    marked(
        "gap",
        "Time leaps {n} ×, by up to {time} s: the record is split there, and what came before a "
        "piece is unknown; {rows} rows in pieces shorter than {least} are left out.",
    ),
    marked(
        "gap",
        "Rows are missing in a record for up to {time} s while no axis is under way; the commands "
        "are taken as held meanwhile.",
    ),
    marked(
        "gap",
        "Rows of a record are {low} to {high} s apart; if these are times of a computer and not "
        "of the device, their scatter passes for noise of the sensors.",
    ),
    marked(
        "gap",
        "Rows are missing at {n} places of a record; the commands are taken as held there.",
    ),
)
# Why an experiment is suggested: one of these, then some of those that follow, in this order.
REASONS = (
    marked(
        "gap",
        "The records move {axis} too little to tell effects apart. Play this: {test}; it goes "
        "through many amplitudes and speeds.",
    ),
    marked(
        "gap",
        "To tell {effects} apart, play this: {test}; it sets them{closest} {floors} apart, even "
        "once each is fitted to it",
    ),
)
MORE = (
    marked("gap", ", which may be too little"),
    marked(
        "gap",
        ", if the reference (ref) of {axis} is recorded too: without it, it does not tell "
        "{effects} apart",
    ),
    marked("gap", "; no test here tells {any} from one of them"),
)
# What stands in a field of a sentence.
STANDS = (marked("gap", "{value} for {share} % of the rows, while the axis is commanded to move"),)
FAULTS = (marked("gap", "stuck or not connected"), marked("gap", "saturated"))
CLOSEST = (marked("gap", ", the closest two of them,"),)
FLOORS = (marked("gap", "{n} noise floors (rms)"),)
RANGES = (marked("gap", "{low} to {high}"),)
MOTIONS = (marked("gap", "{name}, ±{size} about {middle}, {time} s"),)
NAMES = (
    marked("gap", "{name} of {moved} while {held} is held"),
    marked("gap", "fast {size}triangle"),
    marked("gap", "slow {size}triangle"),
    marked("gap", "fast {hz} Hz sine"),
    marked("gap", "{hz} Hz sine"),
    marked("gap", "decaying triangle"),
    marked("gap", "staircase"),
    marked("gap", "row of steps"),
    marked("gap", "steps with long holds"),
    marked("gap", "one step there and back with very long holds"),
    marked("gap", "ramps at two constant speeds"),
    marked("gap", "multisine"),
    marked("gap", "chirp"),
)
SIZES = (marked("gap", "small "), marked("gap", "large "))
GROUPS = (
    marked("gap", "command"),
    marked("gap", "direction"),
    marked("gap", "speed"),
    marked("gap", "past commands"),
    marked("gap", "time"),
    marked("gap", "position phase"),
    marked("gap", "axis {axis}"),
)
_FIELD = re.compile(r"\{(\w+)\}")
_FORMS = {"floors": r"[\d.e+-]+ .*?"}  # of fields that begin with a number


def remark_of(said: str) -> str:
    """Return a remark in the language of the window."""
    return _known(REMARKS, said)


def reason_of(said: str) -> str:
    """Return why an experiment is suggested, in the language of the window."""
    for template in REASONS:
        found = _pattern(template).match(said)
        if found is None:
            continue
        told, rest = _filled(template, found), said[found.end() :]
        for more in MORE:
            own = _pattern(more).match(rest)
            if own is not None:
                told, rest = told + _filled(more, own), rest[own.end() :]
        if rest in ("", "."):
            return f"{told}{rest}"
    return said


def _known(templates: tuple[str, ...], said: str) -> str:
    """Return a text in the language of the window by the first template that it was made from."""
    for template in templates:
        found = _pattern(template).fullmatch(said)
        if found is not None:
            return _filled(template, found)
    return said


@cache
def _pattern(template: str) -> re.Pattern[str]:
    """Return what finds a template's fields in a text that was made from it."""
    parts = _FIELD.split(template)  # plain, name, plain, name, …, plain
    plain = [re.escape(text) for text in parts[::2]]
    fields = [f"(?P<{name}>{_FORMS.get(name, '.*?')})" for name in parts[1::2]]
    return re.compile("".join(a + b for a, b in zip(plain, [*fields, ""], strict=True)), re.DOTALL)


def _filled(template: str, found: re.Match[str]) -> str:
    values = {
        name: _SHOWN[name](text) if name in _SHOWN else text
        for name, text in found.groupdict().items()
    }
    return translate("gap", template).format(**values)


def _effects(text: str, word: str, listed: Callable[[list[str]], str]) -> str:
    """Return a list of effects, each without capital letters, some with the axis they come from."""
    names = [name for part in text.split(f" {word} ") for name in part.split(", ")]
    return listed([_effect(name) for name in names])


def _effect(name: str) -> str:
    effect, _, axis = name.partition(" from ")
    shown = effect_word(_ids().get(effect, effect))
    if not axis:
        return shown
    return translate("gap", "{effect} from {axis}").format(effect=shown, axis=axis)


@cache
def _ids() -> Mapping[str, str]:
    effects, _ = all_effects()
    return {one.title.lower(): one.id for one in effects.values()} | {"unknown effect": UNKNOWN}


def _groups(text: str) -> str:
    parts = (part.partition(" (") for part in text.split(", "))
    return ", ".join("".join((_known(GROUPS, name), *rest)) for name, *rest in parts)


def _by(templates: tuple[str, ...]) -> Callable[[str], str]:
    return lambda text: _known(templates, text)


_SHOWN: dict[str, Callable[[str], str]] = {
    "effects": lambda text: _effects(text, "and", all_of),
    "any": lambda text: _effects(text, "or", any_of),
    "groups": _groups,
    "test": _by(MOTIONS),
    "name": _by(NAMES),
    "size": _by(SIZES),
    "stand": _by(STANDS),
    "fault": _by(FAULTS),
    "closest": _by(CLOSEST),
    "floors": _by(FLOORS),
    "range": _by(RANGES),
}
