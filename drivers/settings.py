"""Driver settings: named, typed by their defaults, unknown ones refused."""

from collections.abc import Mapping
from math import isfinite

from rotemina.sim.errors import InputError
from rotemina.sim.messages import marked, message

SettingValue = bool | int | float | str


class SettingError(InputError):
    """A setting that a driver does not know, or a value that it cannot take."""


def resolve(
    defaults: Mapping[str, SettingValue], given: Mapping[str, object], owner: str
) -> dict[str, SettingValue]:
    """Return ``defaults`` with what was ``given``; a whole number passes for a float.

    Raises
    ------
    SettingError
        With the name of an unknown setting, or of one whose value has the wrong type.
    """
    unknown = [name for name in given if name not in defaults]
    if unknown:
        known = ", ".join(defaults) or marked("engine", "none")
        raise SettingError(
            message("engine", "{owner}: unknown setting {unknown}; available: {known}").fill(
                owner=owner, unknown=repr(unknown[0]), known=known
            )
        )
    return {
        name: _typed(f"{owner}: setting {name}", default, given.get(name, default))
        for name, default in defaults.items()
    }


def _typed(where: str, default: SettingValue, value: object) -> SettingValue:
    wanted = type(default)
    if wanted is float and type(value) is int:
        value = float(value)
    if type(value) is not wanted or not isinstance(value, (bool, int, float, str)):
        raise SettingError(
            message("engine", "{where}: {value} must be a {name}, like its default {default}").fill(
                where=where, value=repr(value), name=wanted.__name__, default=repr(default)
            )
        )
    if isinstance(value, float) and not isfinite(value):
        raise SettingError(
            message("engine", "{where}: {value} is not a finite number").fill(
                where=where, value=value
            )
        )
    return value
