"""What the program's own panels say of themselves, kept from start to start.

A window needs title and place of each panel at once, its module only when it is made: to load those
of all panels would take a tenth of a start. Panels of other packages are loaded at the start, so
that what is wrong with them is told then.
"""

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import EntryPoint
from pathlib import Path

from rotemina.app.panel import Area, Panel
from rotemina.app.settings import Settings
from rotemina.drivers.registry import load_class
from rotemina.sim.plugin_points import PluginError

_KEY = "window.panels"
_PROGRAM = Path(__file__).parents[2]


@dataclass(frozen=True, slots=True)
class DeclaredPanel:
    """A panel whose module is not loaded yet; it says what its class says."""

    point: EntryPoint
    title: str
    area: Area
    order: int
    help_page: str
    at_once: bool

    def load(self) -> type[Panel]:
        """Return the class.

        Raises
        ------
        PluginError
            If there is none.
        """
        loaded = load_class(self.point, Panel)
        if isinstance(loaded, str):
            raise PluginError(loaded)
        return loaded


PanelKind = type[Panel] | DeclaredPanel


class Declarations:
    """Keeps what panels say of themselves among the preferences; what is spoilt is not known."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._kept: dict[str, object] = {}
        with suppress(ValueError, RecursionError):
            found = json.loads(settings.get(_KEY, "{}"))
            self._kept = found if isinstance(found, dict) else {}

    def known(self, point: EntryPoint) -> DeclaredPanel | None:
        """Return a panel as it was when it was last loaded; None: it is new, or was changed."""
        match self._kept.get(point.value):
            case [str(stamp), str(title), str(area), int(order), str(page), bool(at_once)] if (
                stamp == _stamp(point.module) and area in [*Area]
            ):
                return DeclaredPanel(point, title, Area(area), order, page, at_once)
        return None

    def keep(self, kinds: Mapping[str, PanelKind]) -> None:
        """Keep what panels say: of those that are not loaded, what they said before."""
        kept: dict[str, object] = {}
        for kind in kinds.values():
            if isinstance(kind, DeclaredPanel):
                kept[kind.point.value] = self._kept[kind.point.value]
            elif (stamp := _stamp(kind.__module__)) is not None:
                said = [kind.title, kind.area, kind.order, kind.help_page, kind.at_once]
                kept[f"{kind.__module__}:{kind.__qualname__}"] = [stamp, *said]
        if kept != self._kept:
            self._kept = kept
            self._settings.set(_KEY, json.dumps(kept))


def _stamp(module: str) -> str | None:
    """Return what changes with a module of this program; None for those of others."""
    top, *names = module.split(".")
    with suppress(OSError):
        if top == "rotemina":
            found = _PROGRAM.joinpath(*names).with_suffix(".py").stat()
            return f"{found.st_mtime_ns} {found.st_size}"
    return None
