"""Discovery of drivers and other plugins among the installed entry points."""

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from rotemina.drivers.driver import Driver
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.plugin_points import PluginError, load, require_version

DRIVERS = "rotemina.drivers"


@dataclass(frozen=True, slots=True)
class Discovery:
    """The classes ``found`` by name, or what stands for them, and why others are ``broken``."""

    found: dict[str, Any]
    broken: dict[str, str]


def discover(
    group: str, base: type, known: Callable[[EntryPoint], object | None] = lambda point: None
) -> Discovery:
    """Load every entry point of a group; a bad one is named and left out, never raised.

    A good one is a subclass of ``base`` that leaves nothing abstract and has the same
    ``api_version``, where the base has one. What ``known`` returns stands for a class, which is not
    loaded then.
    """
    found: dict[str, Any] = {}
    broken: dict[str, str] = {}
    for point in sorted(entry_points(group=group), key=lambda point: (point.name, point.value)):
        if point.name in found:
            broken[f"{point.name} ({point.value})"] = "another plugin already has this name"
            continue
        loaded = known(point) or load_class(point, base)
        if isinstance(loaded, str):
            broken[point.name] = loaded
        else:
            found[point.name] = loaded
    return Discovery(found, broken)


def make_sources(
    group: str, base: type, own: Mapping[str, Any], **arguments: object
) -> tuple[dict[str, Any], dict[str, str]]:
    """Make every installed source of a group, beside those that the program makes itself.

    Return them by name, and why others are broken and left out.
    """
    discovery = discover(group, base)
    sources, broken = dict(own), dict(discovery.broken)
    for name, source in discovery.found.items():
        if name in sources:
            broken[name] = "the program has a source of this name itself"
            continue
        try:
            sources[name] = source(**arguments)
        except Exception as error:  # a plugin may raise anything
            broken[name] = f"it cannot be made: {type(error).__name__}: {error}"
    return sources, broken


def discover_drivers() -> Discovery:
    """Return the installed drivers, subclasses of :class:`rotemina.drivers.driver.Driver`."""
    return discover(DRIVERS, Driver)


def driver_named(name: str) -> type[Driver]:
    """Return an installed driver; the others are not loaded.

    Raises
    ------
    InputError
        If there is none of that name, or it cannot be loaded, with the reason.
    """
    points = sorted(entry_points(group=DRIVERS), key=lambda point: (point.name, point.value))
    point = next((point for point in points if point.name == name), None)
    if point is None:
        raise InputError(
            message("engine", "there is no driver {name}; installed: {names}").fill(
                name=repr(name), names=", ".join(dict.fromkeys(point.name for point in points))
            )
        )
    loaded = load_class(point, Driver)
    if isinstance(loaded, str):
        raise InputError(
            message("engine", "driver {name} cannot be used: {broken}").fill(
                name=repr(name), broken=loaded
            )
        )
    return loaded


def load_class(point: EntryPoint, base: type) -> type[Any] | str:
    """Return the class, or the problem of the entry point."""
    try:
        loaded = load(point)
        if not isinstance(loaded, type) or not issubclass(loaded, base):
            return f"{point.value} is no {base.__name__}"
        version, wanted = (getattr(kind, "api_version", None) for kind in (loaded, base))
        require_version(point, version, wanted)
    except PluginError as error:
        return str(error)
    if inspect.isabstract(loaded):
        missing = ", ".join(sorted(getattr(loaded, "__abstractmethods__", ())))
        return f"{point.value} does not define {missing}"
    return loaded
