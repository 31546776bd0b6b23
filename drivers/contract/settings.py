"""Settings of drivers. The default of a setting also defines its type."""

from collections.abc import Mapping
from math import isfinite
from typing import TYPE_CHECKING

from rotemina.drivers.contract.errors import DriverSettingError
from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.messages import marked

SettingValue = bool | int | float | str


def resolve_settings(
    defaults: Mapping[str, SettingValue], values: Mapping[str, object], owner: str
) -> dict[str, SettingValue]:
    """Return ``defaults`` updated with ``values``; an int is accepted for a float.

    Raises
    ------
    DriverSettingError
        If a setting is unknown or its value has the wrong type. The message names the setting.
    """
    unknown_names = [name for name in values if name not in defaults]
    if unknown_names:
        available = ", ".join(defaults) or marked("engine", "none")
        raise DriverSettingError(
            "{owner}: unknown setting {unknown}; available: {known}",
            owner=owner,
            unknown=repr(unknown_names[0]),
            known=available,
        )
    return {
        name: _check_type(f"{owner}: setting {name}", default, values.get(name, default))
        for name, default in defaults.items()
    }


def _check_type(where: str, default: SettingValue, value: object) -> SettingValue:
    expected_type = type(default)
    if expected_type is float and type(value) is int:
        value = float(value)
    if type(value) is not expected_type or not isinstance(value, (bool, int, float, str)):
        raise DriverSettingError(
            "{where}: {value} must be a {name}, like its default {default}",
            where=where,
            value=repr(value),
            name=expected_type.__name__,
            default=repr(default),
        )
    if isinstance(value, float) and not isfinite(value):
        raise DriverSettingError(
            "{where}: {value} is not a finite number", where=where, value=value
        )
    return value


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        SettingError="rotemina.drivers.contract.errors.DriverSettingError",
        resolve="resolve_settings",
    )
