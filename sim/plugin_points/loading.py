"""Interface versions and loading of plugins, shared by all five groups of entry points.

The module is in the lowest layer because the effects are loaded there.
"""

import warnings
from collections.abc import Mapping
from importlib.metadata import EntryPoint
from types import MappingProxyType
from typing import Any

from rotemina.sim.errors import PluginError, describe_exception
from rotemina.sim.plugin_points.trial_import import find_import_fault

#: Version of the interface of each group. It is raised when names or meanings change; plugins
#: written for the previous version are accepted for one more release.
API_VERSIONS: Mapping[str, int] = MappingProxyType(
    {
        "rotemina.drivers": 4,
        "rotemina.panels": 2,
        "rotemina.effects": 2,
        "rotemina.cameras": 2,
        "rotemina.inputs": 2,
    }
)


def load_plugin(point: EntryPoint) -> Any:
    """Import the object that an entry point names.

    Raises
    ------
    PluginError
        If the import does not end, ends the process or raises any exception.
    """
    fault = find_import_fault(point)
    if fault is not None:
        raise PluginError("{value} is not imported: {fault}", value=point.value, fault=fault)
    try:
        return point.load()
    # A plugin may raise anything, and must not end the program.
    except (Exception, SystemExit) as error:
        raise PluginError(
            "{value} cannot be imported: {name}: {error}",
            value=point.value,
            name=type(error).__name__,
            error=describe_exception(error),
        ) from error


def require_version(point: EntryPoint, version: object, current: int | None) -> None:
    """Refuse a plugin whose version of the interface is neither the current nor the previous one.

    A plugin for the previous version is accepted with a :class:`DeprecationWarning`.

    Raises
    ------
    PluginError
        If the plugin was written for any other version.
    """
    if version == current:
        return
    if current is not None and version == current - 1:
        warnings.warn(
            f"{point.value} is made for version {version} of the interface. This release still "
            f"accepts it, the next one will not: adapt the plugin and set api_version to {current}",
            DeprecationWarning,
            stacklevel=2,
        )
        return
    raise PluginError(
        "{value} is made for version {version} of the interface, but this program "
        "has version {wanted}: install a matching version of the plugin",
        value=point.value,
        version=str(version),
        wanted=str(current),
    )
