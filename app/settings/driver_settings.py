"""Parse driver settings that users type, and store them between starts.

A setting has the type of its default value.
"""

import re
from collections.abc import Iterable, Mapping

from rotemina.app.settings.settings import UserSettings
from rotemina.drivers.contract import Driver, DriverSettingError, SettingValue
from rotemina.sim.messages import parse_number

# int() also accepts 1_0 and digits of other scripts, but these are probably typing errors.
_INTEGER_PATTERN = re.compile(r"[+-]?[0-9]+")
_BOOLEAN_WORDS = {"true": True, "yes": True, "on": True, "1": True}
_BOOLEAN_WORDS |= {"false": False, "no": False, "off": False, "0": False}


def parse_setting(name: str, default: SettingValue, text: str) -> SettingValue:
    """Convert the text of a setting to the type of its default.

    Raises
    ------
    DriverSettingError
        If the text does not fit the type; the message quotes it and names the type.
    """
    stripped_text = text.strip()
    if isinstance(default, str):
        return stripped_text
    if isinstance(default, bool):
        if stripped_text.lower() in _BOOLEAN_WORDS:
            return _BOOLEAN_WORDS[stripped_text.lower()]
        raise DriverSettingError(
            "setting {name}: {text} is not a switch; enter true or false",
            name=name,
            text=repr(text),
        )
    if isinstance(default, int):
        if _INTEGER_PATTERN.fullmatch(stripped_text):
            return int(stripped_text)
        raise DriverSettingError(
            "setting {name}: {text} is not an integer", name=name, text=repr(text)
        )
    number = parse_number(stripped_text)
    if number is not None:
        return number
    raise DriverSettingError(
        "setting {name}: {text} is not a number; enter one with a decimal point",
        name=name,
        text=repr(text),
    )


def parse_assignments(kind: type[Driver], assignments: Iterable[str]) -> dict[str, SettingValue]:
    """Parse assignments such as ``baud=9600`` to settings of a driver.

    Raises
    ------
    DriverSettingError
        If a text is not an assignment, names no setting of the driver, or its value has the wrong
        type.
    """
    values: dict[str, SettingValue] = {}
    defaults = kind.default_settings
    for text in assignments:
        name, equals, value = text.partition("=")
        name = name.strip()
        if not equals or not name:
            raise DriverSettingError(
                "--set {text}: write it as name=value, such as baud=9600", text=repr(text)
            )
        if name not in defaults:
            known = ", ".join(defaults) or "none"
            raise DriverSettingError(
                "driver {driver} has no setting {setting}; available: {known}",
                driver=repr(kind.name),
                setting=repr(name),
                known=known,
            )
        values[name] = parse_setting(name, defaults[name], value)
    return values


def load_settings(settings: UserSettings, kind: type[Driver]) -> dict[str, SettingValue]:
    """Return all settings of a driver: the last used values, or else the defaults."""
    return {
        name: settings.get(_make_key(kind, name), default)
        for name, default in kind.default_settings.items()
    }


def store_settings(
    settings: UserSettings, kind: type[Driver], values: Mapping[str, SettingValue]
) -> None:
    """Store the changed settings of a driver for the next start."""
    before = load_settings(settings, kind)
    for name, value in values.items():
        if before[name] != value:
            settings.set(_make_key(kind, name), value)


def _make_key(kind: type[Driver], name: str) -> str:
    return f"driver.{kind.name}.{name}"
