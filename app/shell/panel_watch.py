"""Panels of others that fail while the window is open: they are named and left out.

What a panel raises in a paint event, a timer, a slot or a thread reaches nobody but Python's hooks,
and would come again with every frame. The hooks find the panel by the code that was running. One
that cannot paint is left out at once, for Qt may not survive the next attempt; one that fails
otherwise gets a few chances, for a button that does not work is no reason to take the rest away.
Panels of this program stay, whatever they raise: an operator needs them. What is no panel's of
others is logged, so that the log page and a support bundle hold it, and told once.

A panel that never returns holds up the window, and nothing in its own process can end it.
"""

import logging
import sys
import threading
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, MutableMapping
from contextlib import contextmanager
from types import FrameType, TracebackType

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabWidget, QWidget
from shiboken6 import invalidate, isValid

from rotemina.app.panel import Panel
from rotemina.app.shell.help_topics import Explained, Remedy
from rotemina.app.shell.language import translate
from rotemina.app.shell.panel_declarations import PanelKind
from rotemina.app.shell.reloading import panel_subject
from rotemina.app.shell.workbench import Level
from rotemina.app.widgets.scroll_areas import frame_of

logger = logging.getLogger(__name__)

#: What a panel may raise in slots and timers before it is left out.
MOST_FAULTS = 3
_OWN = "rotemina."
_PAGE = "plugins.md#what-a-bad-plugin-can-do"


class PanelWatch(QObject):
    """Watches the panels of a window from :meth:`install` to :meth:`remove`.

    Parameters
    ----------
    window : QMainWindow
    panels : mapping of str to Panel
        The window's own: one that is left out is taken from it.
    docks : dict of str to QDockWidget
        Likewise.
    tell : callable
        Tells the operator something: a level and a text.
    kinds : mapping of str to type, optional
        The panels' classes, where some panels are not made yet.
    remedy : callable
        Returns what mends a panel of a name.
    """

    _raised = Signal(object)

    def __init__(
        self,
        window: QMainWindow,
        panels: MutableMapping[str, Panel],
        docks: dict[str, QDockWidget],
        tell: Callable[[Level, str], object],
        kinds: Mapping[str, PanelKind] | None = None,
        remedy: Callable[[str], Remedy | None] = lambda _: None,
    ) -> None:
        super().__init__()
        self._window = window
        self._panels = panels
        self._docks = docks
        self._tell = tell
        self._remedy = remedy
        # By module and the packages above it: whose code it is, also after a panel has gone.
        self._modules: dict[str, str] = {}
        self._classes: dict[tuple[str, str], str] = {}
        if kinds is None:
            kinds = {name: type(panel) for name, panel in panels.items()}
        self._faults: Counter[str] = Counter()
        for name, kind in kinds.items():
            self.begin_with(name, kind)
        self._places: Counter[tuple[type[BaseException], str, int]] = Counter()
        self._before = sys.excepthook, threading.excepthook, sys.unraisablehook
        self._raised.connect(self._judge)

    def begin_with(self, name: str, kind: PanelKind) -> None:
        """Watch a panel of this class from now on, whatever one of its name did before."""
        self._faults.pop(name, None)
        if isinstance(kind, type) and not kind.__module__.startswith(_OWN):
            self._classes[kind.__module__, kind.__qualname__] = name
            for module in _upwards(kind.__module__):
                self._modules.setdefault(module, name)

    def install(self) -> None:
        """Begin to watch."""
        self._before = sys.excepthook, threading.excepthook, sys.unraisablehook
        sys.excepthook = self.on_exception
        threading.excepthook = self._on_thread
        sys.unraisablehook = self._on_unraisable

    def remove(self) -> None:
        """Watch no longer."""
        sys.excepthook, threading.excepthook, sys.unraisablehook = self._before

    def on_exception(
        self, kind: type[BaseException], error: BaseException, trace: TracebackType | None
    ) -> None:
        """Note an exception that nobody caught, on any thread."""
        self._raised.emit(error.with_traceback(trace))

    @contextmanager
    def guarding(self) -> Iterator[None]:
        """Note what panels raise while this lasts.

        What an event raises in the middle of a call of Qt's is raised by that call in its turn.
        """
        try:
            yield
        except BaseException as error:
            if not self._noted(error, error.__traceback__, handle_painter=invalidate):
                raise

    def _on_thread(self, seen: threading.ExceptHookArgs) -> None:
        # A thread may end itself by SystemExit, which nothing else hears of.
        if seen.exc_value is not None and not isinstance(seen.exc_value, SystemExit):
            self.on_exception(seen.exc_type, seen.exc_value, seen.exc_traceback)

    def _on_unraisable(self, seen: "sys.UnraisableHookArgs") -> None:
        if seen.exc_value is not None:
            self.on_exception(seen.exc_type, seen.exc_value, seen.exc_traceback)

    def _judge(self, error: BaseException) -> None:
        """Note an exception, on the window's thread."""
        if not self._noted(error, error.__traceback__):
            self._log(error)

    def _log(self, error: BaseException) -> None:
        """Log what is no panel's of others; the same again only at 2, 4, 8 … times."""
        frames = list(_frames(error.__traceback__))
        where = (frames[-1].f_code.co_filename, frames[-1].f_lineno) if frames else ("", 0)
        self._places[type(error), *where] += 1
        times = self._places[type(error), *where]
        if times == 1:
            logger.error("a fault of the program", exc_info=error)
            text = translate(
                "shell",
                "Program error: {error}. The log has details; please save a support bundle.",
            )
            self._tell(Level.ERROR, text.format(error=_said(error)))
        elif times & (times - 1) == 0:
            logger.error("the same fault of the program, %d times so far: %s", times, _said(error))

    def _noted(
        self,
        error: BaseException,
        trace: TracebackType | None,
        handle_painter: Callable[[QPainter], object] = QPainter.end,
    ) -> bool:
        """Judge an exception, and return whether it is that of a panel that is watched.

        ``handle_painter`` is called for each painter that it has left active. To end one is right
        within the paint event alone: later, what it painted on may be gone, and Qt would crash.
        """
        frames = list(_frames(trace))
        name = next(filter(None, map(self._owner, frames)), None)
        if name is None:
            return False
        if name not in self._panels:
            return True  # what is left of it may fail as long as it likes
        logger.error("panel %s", name, exc_info=error)
        self._faults[name] += 1
        painting = any(frame.f_code.co_name == "paintEvent" for frame in frames)
        if painting or self._faults[name] >= MOST_FAULTS:
            panel = self._panels.pop(name)
            dock = self._docks.pop(name, None)
            for painter in _active_painters(frames, panel):
                handle_painter(painter)
            text = (
                translate("shell", "Panel {name!r} is left out: it cannot be drawn: {error}")
                if painting
                else translate("shell", "Panel {name!r} is left out after {n} faults: {error}")
            )
            told = text.format(name=name, n=self._faults[name], error=_said(error))
            notice = self._explained(told, name)
            # Not now: this may be in the middle of the panel's own event.
            QTimer.singleShot(0, self._window, lambda: self._take_out(panel, dock, notice))
        elif self._faults[name] == 1:
            text = translate("shell", "Panel {name!r} has failed: {error}")
            told = text.format(name=name, error=_said(error))
            self._tell(Level.WARNING, self._explained(told, name))
        return True

    def _explained(self, text: str, name: str) -> Explained:
        return Explained(text, _PAGE, self._remedy(name), subject=panel_subject(name))

    def _owner(self, frame: FrameType) -> str | None:
        """Return the panel whose code a frame runs; several classes may share a module."""
        module = str(frame.f_globals.get("__name__", ""))
        name = self._classes.get((module, frame.f_code.co_qualname.partition(".")[0]))
        if name is not None:
            return name
        above = _upwards(module)
        return next((self._modules[one] for one in above if one in self._modules), None)

    def _take_out(self, panel: Panel, dock: QDockWidget | None, notice: Explained) -> None:
        """Take a panel out of the window and end it, with its timers and what it listens to."""
        self._tell(Level.ERROR, notice)
        panel.hide()
        if dock is not None:
            self._window.removeDockWidget(dock)
            dock.deleteLater()
        elif (tabs := _tabs_of(panel)) is not None:
            page = frame_of(panel)
            tabs.removeTab(tabs.indexOf(page))
            page.deleteLater()
        panel.deleteLater()


def _active_painters(frames: Iterable[FrameType], panel: Panel) -> Iterator[QPainter]:
    """Yield the painters that a failed paint event has left active.

    Qt would paint and resize the whole window beneath them, and crash.
    """
    for holder in (*(frame.f_locals for frame in frames), vars(panel)):
        for value in list(holder.values()):
            if isinstance(value, QPainter) and isValid(value) and value.isActive():
                yield value


def _said(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"


def _frames(trace: TracebackType | None) -> Iterator[FrameType]:
    while trace is not None:
        yield trace.tb_frame
        trace = trace.tb_next


def _upwards(module: str) -> Iterator[str]:
    """Yield a module's name and those of the packages above it."""
    while module:
        yield module
        module = module.rpartition(".")[0]


def _tabs_of(panel: QWidget) -> QTabWidget | None:
    """Return the tabs that a panel is a page of."""
    widget = panel.parentWidget()
    while widget is not None and not isinstance(widget, QTabWidget):
        widget = widget.parentWidget()
    return widget
