"""The five kinds of plugins, and which are installed."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.inputs.device import InputSource
from rotemina.drivers.registry import discover, discover_drivers
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.plugin_points import API_VERSIONS

Found = tuple[Mapping[str, Any], Mapping[str, str]]


class Kind(StrEnum):
    """What a plugin can be; the entry-point groups are called after it."""

    DRIVER = "driver"
    PANEL = "panel"
    EFFECT = "effect"
    CAMERA = "camera"
    INPUT = "input"

    @property
    def group(self) -> str:
        """The group of entry points."""
        return f"rotemina.{self}s"

    @property
    def api_version(self) -> int:
        """The version of its interface that this program has."""
        return API_VERSIONS[self.group]


@dataclass(frozen=True, slots=True)
class Plugin:
    """One entry point, as it was found.

    Attributes
    ----------
    kind : Kind
    name, value : str
        Of the entry point.
    package, version : str
        The package that brings it, and that package's version; empty where none is known.
    loaded : object
        The class or effect; None where it was left out.
    refused : str
        Why it was left out; empty where it was not.
    """

    kind: Kind
    name: str
    value: str
    package: str
    version: str
    loaded: Any = None
    refused: str = ""

    @property
    def api_version(self) -> int | None:
        """The version of the interface that it was written for; None where it was left out."""
        return None if self.loaded is None else int(self.loaded.api_version)


def installed_plugins(kind: Kind) -> Iterator[Plugin]:
    """Load all plugins of a kind, sorted by name; those that are left out are there too."""
    found, broken = _FINDERS[kind]()
    for point in sorted(
        entry_points(group=kind.group), key=lambda point: (point.name, point.value)
    ):
        own = point.dist
        about = (point.name, point.value, own.name if own else "", own.version if own else "")
        refused = broken.get(f"{point.name} ({point.value})") or broken.get(point.name, "")
        yield Plugin(kind, *about, None if refused else found.get(point.name), refused)


def named_points(name: str) -> list[tuple[Kind, EntryPoint]]:
    """Return the entry points of a name, of every kind; nothing is imported."""
    return [(kind, point) for kind in Kind for point in entry_points(group=kind.group, name=name)]


def _panels() -> Found:
    # Qt is loaded only when it is wanted: the other kinds do without its libraries.
    try:
        from rotemina.app.panel import Panel
    except ImportError as error:
        reason = f"Qt cannot be loaded here: {error}"
        return {}, {point.name: reason for point in entry_points(group=Kind.PANEL.group)}
    return _classes(Kind.PANEL, Panel)


def _classes(kind: Kind, base: type) -> Found:
    discovery = discover(kind.group, base)
    return discovery.found, discovery.broken


def _drivers() -> Found:
    discovery = discover_drivers()
    return discovery.found, discovery.broken


_FINDERS: Mapping[Kind, Callable[[], Found]] = {
    Kind.DRIVER: _drivers,
    Kind.PANEL: _panels,
    Kind.EFFECT: all_effects,
    Kind.CAMERA: lambda: _classes(Kind.CAMERA, CameraSource),
    Kind.INPUT: lambda: _classes(Kind.INPUT, InputSource),
}
