"""Panels of others imported again while the window is open: one is mended without a restart."""

import importlib
import sys
from collections.abc import Callable, Hashable, Iterator, Mapping
from functools import partial
from importlib.metadata import EntryPoint, entry_points
from types import ModuleType

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QDockWidget, QMenu, QWidget

from rotemina.app.panel import Area, Panel
from rotemina.app.shell.help_topics import Remedy
from rotemina.app.shell.language import translate
from rotemina.app.shell.palette_entries import Entry
from rotemina.app.shell.panel_host import GROUP, Panels
from rotemina.app.shell.quit_dialog import moves
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.drivers.registry import load_class
from rotemina.sim.plugin_import import import_fault

_OWN = "rotemina."
_PAGE = "plugins.md#reloading"


class Reloading(QObject):
    """Puts a panel of another package, imported again, into the place of the one before.

    Parameters
    ----------
    workbench : Workbench
    panels : Panels
    docks : mapping of str to QDockWidget
    add_dock : callable
        Makes a dock for a panel of this name and class that has none: it was left out.

    Signals
    -------
    renewed(str, type) : name and class of one that was imported again, before it is made.
    """

    renewed = Signal(str, object)

    def __init__(
        self,
        workbench: Workbench,
        panels: Panels,
        docks: Mapping[str, QDockWidget],
        add_dock: Callable[[str, type[Panel]], object],
    ) -> None:
        super().__init__(workbench)
        self._bench, self._panels, self._docks = workbench, panels, docks
        self._add_dock = add_dock

    def names(self) -> list[str]:
        """Return the panels that can be reloaded, those that were left out too."""
        return sorted({point.name for point in _points()})

    def remedy(self, name: str) -> Remedy | None:
        """Return the button that reloads a panel; None for the program's own."""
        if name not in self.names():
            return None
        return Remedy(translate("shell", "Reload"), lambda: self.reload(name))

    def entries(self) -> Iterator[Entry]:
        """Yield an entry of the command palette for each."""
        for name in self.names():
            words = translate("shell", "Reload {name}").format(name=name)
            yield Entry(
                translate("shell", "Plugin"),
                words,
                "",
                self._why_not(),
                partial(self.reload, name),
            )

    def reload(self, name: str) -> None:
        """Import a panel again, close the one before and make it; what fails is told."""
        point = next((one for one in _points() if one.name == name), None)
        reason = self._why_not()
        if point is None:
            reason = translate("shell", "no package that is installed has a panel of this name")
        elif _top(type(self._bench.session.driver).__module__) == _top(point.module):
            reason = translate("shell", "its package has the driver in use; restart the program")
        if point is None or reason is not None:
            self._refuse(name, reason or "")
            return
        self._bench.work(
            f"reload {name}",
            translate("shell", "Importing {name} …").format(name=name),
            lambda: import_fault(point, anew=True),
            lambda fault: self._import(point) if fault is None else self._refuse(name, fault),
        )

    def _why_not(self) -> str | None:
        """Say what stands against it: an import may hold the window up for a while."""
        if moves(self._bench.session.snapshot()):
            return translate("shell", "the machine is moving; stop it first")
        return None

    def _import(self, point: EntryPoint) -> None:
        name, reason = point.name, self._why_not()
        if reason is not None:
            self._refuse(name, reason)
            return
        before = _taken(_top(point.module))
        importlib.invalidate_caches()
        kind = load_class(point, Panel)
        if not isinstance(kind, str) and (kind.area is Area.CENTRE or self._central(name)):
            kind = translate("shell", "panels in the centre need a restart")
        if isinstance(kind, str):
            _taken(_top(point.module))
            sys.modules.update(before)
            self._refuse(name, kind)
            return
        self._exchange(name, kind)

    def _exchange(self, name: str, kind: type[Panel]) -> None:
        old = self._panels.made.pop(name, None)
        self._panels.kinds[name] = kind
        if old is not None:
            old.close()
            old.setParent(None)
            old.deleteLater()
        if name in self._docks:
            self._docks[name].setWindowTitle(translate("panels", kind.title))
        else:
            self._add_dock(name, kind)
        self.renewed.emit(name, kind)
        if self._panels.make(name) is not None:
            text = translate("shell", "Panel {name!r} is reloaded").format(name=name)
            self._bench.settled.emit(panel_subject(name))
            self._bench.notify(Level.GOOD, text)

    def _central(self, name: str) -> bool:
        kind = self._panels.kinds.get(name)
        return kind is not None and kind.area is Area.CENTRE

    def _refuse(self, name: str, reason: str) -> None:
        text = translate("shell", "Panel {name!r} is not reloaded: {reason}")
        self._bench.notify(
            Level.ERROR,
            text.format(name=name, reason=reason),
            about=_PAGE,
            subject=panel_subject(name),
        )


def panel_subject(name: str) -> Hashable:
    """Return what notices about a panel's faults are known by, until it is reloaded."""
    return "panel", name


class ReloadMenu(QMenu):
    """A menu of the panels that can be reloaded; it hides where there is none."""

    def __init__(self, reloading: Reloading, parent: QWidget) -> None:
        super().__init__(translate("shell", "Reload &plugin"), parent)
        self._reloading = reloading

    def look(self) -> None:
        """Find out which there are now."""
        self.clear()
        for entry in self._reloading.entries():
            action = self.addAction(entry.what)
            action.setEnabled(entry.why_not is None)
            action.triggered.connect(lambda _=False, run=entry.run: run())
        self.menuAction().setVisible(not self.isEmpty())


def _points() -> list[EntryPoint]:
    return [one for one in entry_points(group=GROUP) if not one.value.startswith(_OWN)]


def _top(module: str) -> str:
    return module.partition(".")[0]


def _taken(package: str) -> dict[str, ModuleType]:
    """Take a package's modules out of those that are imported, and return them."""
    names = [name for name in sys.modules if _top(name) == package]
    return {name: sys.modules.pop(name) for name in names}
