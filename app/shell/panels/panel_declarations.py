"""Properties of the program's own panels, saved between starts.

At the start, the window needs only the title and place of each panel. It needs the module of a
panel when the panel is created. Loading all modules would take a tenth of the start-up time. Panels
of other packages are loaded at the start, so that their faults are reported then.
"""

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import EntryPoint
from pathlib import Path

from rotemina.app.panel import Panel, PanelArea
from rotemina.app.settings import UserSettings
from rotemina.drivers.contract import load_class
from rotemina.sim.errors import PluginError

_PANELS_KEY = "window.panels"
_PROGRAM_FOLDER = Path(__file__).parents[3]


@dataclass(frozen=True, slots=True)
class DeclaredPanel:
    """Panel whose module is not loaded yet, with the properties of its class."""

    point: EntryPoint
    title: str
    area: PanelArea
    order: int
    help_page: str
    at_once: bool

    def load(self) -> type[Panel]:
        """Load and return the class.

        Raises
        ------
        PluginError
            If it cannot be loaded.
        """
        loaded = load_class(self.point, Panel)
        if isinstance(loaded, str):
            raise PluginError(loaded)
        return loaded


PanelKind = type[Panel] | DeclaredPanel


class PanelDeclarations:
    """Properties of panels, saved in the preferences; damaged entries are ignored."""

    def __init__(self, settings: UserSettings) -> None:
        self._settings = settings
        self._saved: dict[str, object] = {}
        with suppress(ValueError, RecursionError):
            content = json.loads(settings.get(_PANELS_KEY, "{}"))
            self._saved = content if isinstance(content, dict) else {}

    def find_declaration(self, point: EntryPoint) -> DeclaredPanel | None:
        """Return the saved properties of a panel, or None if it is new or has changed."""
        match self._saved.get(point.value):
            case [str(stamp), str(title), str(area), int(order), str(page), bool(at_once)] if (
                stamp == _compute_stamp(point.module) and area in [*PanelArea]
            ):
                return DeclaredPanel(point, title, PanelArea(area), order, page, at_once)
        return None

    def save(self, kinds: Mapping[str, PanelKind]) -> None:
        """Save the properties of panels; those of panels that are not loaded stay unchanged."""
        declarations: dict[str, object] = {}
        for kind in kinds.values():
            if isinstance(kind, DeclaredPanel):
                declarations[kind.point.value] = self._saved[kind.point.value]
            elif (stamp := _compute_stamp(kind.__module__)) is not None:
                properties = [kind.title, kind.area, kind.order, kind.help_page, kind.at_once]
                declarations[f"{kind.__module__}:{kind.__qualname__}"] = [stamp, *properties]
        if declarations != self._saved:
            self._saved = declarations
            self._settings.set(_PANELS_KEY, json.dumps(declarations))


def _compute_stamp(module: str) -> str | None:
    """Return time and size of a module's file, or None if it is not part of this program."""
    package, *names = module.split(".")
    with suppress(OSError):
        if package == "rotemina":
            file_status = _PROGRAM_FOLDER.joinpath(*names).with_suffix(".py").stat()
            return f"{file_status.st_mtime_ns} {file_status.st_size}"
    return None
