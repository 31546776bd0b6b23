"""Driver settings as users type them: types from the defaults, stored between starts."""

import re
from collections.abc import Iterable, Mapping

from rotemina.app.settings import Settings
from rotemina.drivers.driver import Driver
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.sim.messages import message
from rotemina.sim.quantities import parsed

# What int() takes beside these (1_0, digits of other scripts) is likelier a slip.
_WHOLE = re.compile(r"[+-]?[0-9]+")
_SWITCHES = {"true": True, "yes": True, "on": True, "1": True}
_SWITCHES |= {"false": False, "no": False, "off": False, "0": False}


def typed(name: str, default: SettingValue, text: str) -> SettingValue:
    """Return the value of a setting that a text means, in the type of its default.

    Raises
    ------
    SettingError
        With what was written and what is wanted.
    """
    word = text.strip()
    if isinstance(default, str):
        return word
    if isinstance(default, bool):
        if word.lower() in _SWITCHES:
            return _SWITCHES[word.lower()]
        raise SettingError(
            message("engine", "setting {name}: {text} is not a switch; enter true or false").fill(
                name=name, text=repr(text)
            )
        )
    if isinstance(default, int):
        if _WHOLE.fullmatch(word):
            return int(word)
        raise SettingError(
            message("engine", "setting {name}: {text} is not an integer").fill(
                name=name, text=repr(text)
            )
        )
    number = parsed(word)
    if number is not None:
        return number
    raise SettingError(
        message(
            "engine", "setting {name}: {text} is not a number; enter one with a decimal point"
        ).fill(name=name, text=repr(text))
    )


def assigned(kind: type[Driver], assignments: Iterable[str]) -> dict[str, SettingValue]:
    """Return the settings that texts such as ``baud=9600`` give a driver.

    Raises
    ------
    SettingError
        If one is no assignment, names no setting of the driver, or has a value of another type.
    """
    values: dict[str, SettingValue] = {}
    defaults = kind.default_settings
    for text in assignments:
        name, equals, value = text.partition("=")
        name = name.strip()
        if not equals or not name:
            raise SettingError(
                message("engine", "--set {text}: write it as name=value, such as baud=9600").fill(
                    text=repr(text)
                )
            )
        if name not in defaults:
            known = ", ".join(defaults) or "none"
            raise SettingError(
                message(
                    "engine", "driver {driver} has no setting {setting}; available: {known}"
                ).fill(driver=repr(kind.name), setting=repr(name), known=known)
            )
        values[name] = typed(name, defaults[name], value)
    return values


def kept(settings: Settings, kind: type[Driver]) -> dict[str, SettingValue]:
    """Return all settings of a driver: as used last, else their defaults."""
    return {
        name: settings.get(_key(kind, name), default)
        for name, default in kind.default_settings.items()
    }


def keep(settings: Settings, kind: type[Driver], values: Mapping[str, SettingValue]) -> None:
    """Store the settings of a driver for the next start, if they changed."""
    before = kept(settings, kind)
    for name, value in values.items():
        if before[name] != value:
            settings.set(_key(kind, name), value)


def _key(kind: type[Driver], name: str) -> str:
    return f"driver.{kind.name}.{name}"
