"""What the five groups of entry points have in common: versions of interfaces, and loading.

It stands in the lowest layer because effects are found there.
"""

from collections.abc import Mapping
from importlib.metadata import EntryPoint
from types import MappingProxyType
from typing import Any

from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import message
from rotemina.sim.plugin_import import import_fault

#: The version of the interface that plugins of each group are written for. It grows when a plugin
#: written for the one before would fail.
API_VERSIONS: Mapping[str, int] = MappingProxyType(
    {
        "rotemina.drivers": 3,
        "rotemina.panels": 1,
        "rotemina.effects": 1,
        "rotemina.cameras": 1,
        "rotemina.inputs": 1,
    }
)


class PluginError(InputError):
    """A plugin that cannot be used."""


def load(point: EntryPoint) -> Any:
    """Import what an entry point names.

    Raises
    ------
    PluginError
        If its import does not end, ends the process or raises anything.
    """
    fault = import_fault(point)
    if fault is not None:
        raise PluginError(
            message("engine", "{value} is not imported: {fault}").fill(
                value=point.value, fault=fault
            )
        )
    try:
        return point.load()
    except (Exception, SystemExit) as error:  # a plugin may raise anything, and must end nothing
        raise PluginError(
            message("engine", "{value} cannot be imported: {name}: {error}").fill(
                value=point.value, name=type(error).__name__, error=reason_of(error)
            )
        ) from error


def require_version(point: EntryPoint, version: object, wanted: int | None) -> None:
    """Refuse a plugin that was written for another version of its interface.

    Raises
    ------
    PluginError
    """
    if version != wanted:
        raise PluginError(
            message(
                "engine",
                "{value} is made for version {version} of the interface, but this program "
                "has version {wanted}: install a matching version of the plugin",
            ).fill(value=point.value, version=str(version), wanted=str(wanted))
        )
