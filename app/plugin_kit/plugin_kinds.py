"""The five kinds of plugins, and the installed plugins."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from rotemina.drivers.cameras import CameraSource
from rotemina.drivers.contract import discover_drivers, discover_plugins
from rotemina.drivers.inputs import InputSource
from rotemina.sim.effects import load_all_effects
from rotemina.sim.plugin_points import API_VERSIONS

#: Loaded plugins by name, and for each plugin that is left out, the reason.
FoundPlugins = tuple[Mapping[str, Any], Mapping[str, str]]


class PluginKind(StrEnum):
    """Kind of a plugin; the group of its entry points is named after it."""

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
        """The version of the kind's interface in this program."""
        return API_VERSIONS[self.group]


@dataclass(frozen=True, slots=True)
class InstalledPlugin:
    """An entry point of an installed package, loaded if possible.

    Attributes
    ----------
    kind : PluginKind
    name, value : str
        Name and value of the entry point.
    package, version : str
        The package that contains the plugin, and its version; empty if they are unknown.
    loaded : object
        The plugin's class or effect; None if the plugin was left out.
    refusal : str
        Why the plugin was left out; empty if it was loaded.
    """

    kind: PluginKind
    name: str
    value: str
    package: str
    version: str
    loaded: Any = None
    refusal: str = ""

    @property
    def api_version(self) -> int | None:
        """The version of the interface that the plugin was written for; None if it was left out."""
        return None if self.loaded is None else int(self.loaded.api_version)


def load_installed_plugins(kind: PluginKind) -> Iterator[InstalledPlugin]:
    """Load all plugins of a kind; yield them sorted by name, including those left out."""
    plugins, refusals = _FINDERS[kind]()
    for point in sorted(
        entry_points(group=kind.group), key=lambda point: (point.name, point.value)
    ):
        package = point.dist
        description = (
            point.name,
            point.value,
            package.name if package else "",
            package.version if package else "",
        )
        refusal = refusals.get(f"{point.name} ({point.value})") or refusals.get(point.name, "")
        loaded = None if refusal else plugins.get(point.name)
        yield InstalledPlugin(kind, *description, loaded, refusal)


def find_entry_points(name: str) -> list[tuple[PluginKind, EntryPoint]]:
    """Return the entry points with a name, of every kind, without importing them."""
    return [
        (kind, point) for kind in PluginKind for point in entry_points(group=kind.group, name=name)
    ]


def _find_panels() -> FoundPlugins:
    # Qt is imported only here, because the other kinds of plugins work without it.
    try:
        from rotemina.app.panel import Panel
    except ImportError as error:
        reason = f"Qt cannot be loaded here: {error}"
        return {}, {point.name: reason for point in entry_points(group=PluginKind.PANEL.group)}
    return _find_classes(PluginKind.PANEL, Panel)


def _find_classes(kind: PluginKind, base: type) -> FoundPlugins:
    discovery = discover_plugins(kind.group, base)
    return discovery.plugins, discovery.problems


def _find_drivers() -> FoundPlugins:
    discovery = discover_drivers()
    return discovery.plugins, discovery.problems


_FINDERS: Mapping[PluginKind, Callable[[], FoundPlugins]] = {
    PluginKind.DRIVER: _find_drivers,
    PluginKind.PANEL: _find_panels,
    PluginKind.EFFECT: load_all_effects,
    PluginKind.CAMERA: lambda: _find_classes(PluginKind.CAMERA, CameraSource),
    PluginKind.INPUT: lambda: _find_classes(PluginKind.INPUT, InputSource),
}
