"""Discovery of drivers and other plugins by their entry points."""

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from rotemina.drivers.contract.driver import Driver
from rotemina.sim.errors import InputError, PluginError
from rotemina.sim.plugin_points import load_plugin, require_version

DRIVER_GROUP = "rotemina.drivers"


@dataclass(frozen=True, slots=True)
class PluginDiscovery:
    """Result of a search for plugins.

    Attributes
    ----------
    plugins : dict
        The class of each plugin, or a substitute for it, by name.
    problems : dict of str to str
        Why a plugin cannot be used, by name.
    """

    plugins: dict[str, Any]
    problems: dict[str, str]


def discover_plugins(
    group: str,
    base: type,
    find_substitute: Callable[[EntryPoint], object | None] = lambda point: None,
) -> PluginDiscovery:
    """Load every entry point of a group; a plugin that cannot be used is reported as a problem.

    A valid plugin is a subclass of ``base`` without abstract methods, and has the same
    ``api_version`` if the base has one. If ``find_substitute`` returns an object for an entry
    point, the object is used instead of the class, which is then not loaded.
    """
    plugins: dict[str, Any] = {}
    problems: dict[str, str] = {}
    for point in sorted(entry_points(group=group), key=lambda point: (point.name, point.value)):
        if point.name in plugins:
            problems[f"{point.name} ({point.value})"] = "another plugin already has this name"
            continue
        plugin_or_problem = find_substitute(point) or load_class(point, base)
        if isinstance(plugin_or_problem, str):
            problems[point.name] = plugin_or_problem
        else:
            plugins[point.name] = plugin_or_problem
    return PluginDiscovery(plugins, problems)


def make_sources(
    group: str, base: type, program_sources: Mapping[str, Any], **arguments: object
) -> tuple[dict[str, Any], dict[str, str]]:
    """Create every installed source of a group, in addition to the program's own sources.

    Returns
    -------
    sources : dict
        Sources by name.
    problems : dict of str to str
        Why a source cannot be used, by name.
    """
    discovery = discover_plugins(group, base)
    sources, problems = dict(program_sources), dict(discovery.problems)
    for name, source_class in discovery.plugins.items():
        if name in sources:
            problems[name] = "the program has a source of this name itself"
            continue
        try:
            sources[name] = source_class(**arguments)
        # A plugin may raise any exception; the other sources must still work.
        except Exception as error:
            problems[name] = f"it cannot be created: {type(error).__name__}: {error}"
    return sources, problems


def discover_drivers() -> PluginDiscovery:
    """Find the installed drivers, which are subclasses of :class:`Driver`."""
    return discover_plugins(DRIVER_GROUP, Driver)


def find_driver(name: str) -> type[Driver]:
    """Return the class of an installed driver; no other driver is loaded.

    Raises
    ------
    InputError
        If there is no driver with this name, or it cannot be loaded; the message gives the reason.
    """
    points = sorted(entry_points(group=DRIVER_GROUP), key=lambda point: (point.name, point.value))
    point = next((point for point in points if point.name == name), None)
    if point is None:
        raise InputError(
            "there is no driver {name}; installed: {names}",
            name=repr(name),
            names=", ".join(dict.fromkeys(point.name for point in points)),
        )
    class_or_problem = load_class(point, Driver)
    if isinstance(class_or_problem, str):
        raise InputError(
            "driver {name} cannot be used: {broken}", name=repr(name), broken=class_or_problem
        )
    return class_or_problem


def load_class(point: EntryPoint, base: type) -> type[Any] | str:
    """Return the class of an entry point, or a text that says why it cannot be used."""
    try:
        loaded = load_plugin(point)
        if not isinstance(loaded, type) or not issubclass(loaded, base):
            return f"{point.value} is no {base.__name__}"
        version, expected_version = (getattr(cls, "api_version", None) for cls in (loaded, base))
        require_version(point, version, expected_version)
    except PluginError as error:
        return str(error)
    if inspect.isabstract(loaded):
        missing = ", ".join(sorted(getattr(loaded, "__abstractmethods__", ())))
        return f"{point.value} does not define {missing}"
    return loaded
