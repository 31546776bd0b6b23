"""Detection of panels of other packages that fail while the window is open, and their removal.

An exception in a panel's paint event, timer, slot or thread reaches only Python's hooks and would
repeat with every frame. The hooks find the panel by the code that was running. A panel that fails
to paint is removed at once, because Qt may not survive the next attempt. A panel with other faults
may fail a few times before it is removed: one faulty button should not cost the operator the
whole panel.

Panels of this program always stay, because the operator needs them. Faults outside the panels of
other packages are logged, so that the log window and a support bundle contain them, and reported
once.

A panel that never returns blocks the window, and nothing in its own process can end it.
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

from rotemina.app.language import translate
from rotemina.app.panel import Panel
from rotemina.app.shell.panels.panel_declarations import PanelKind
from rotemina.app.shell.panels.panel_host import make_panel_subject
from rotemina.app.widgets.layout import find_frame
from rotemina.app.workbench import Level, NoticeMessage

logger = logging.getLogger(__name__)

#: Faults in slots and timers after which a panel is removed.
MAX_FAULTS = 3
_OWN_PREFIX = "rotemina."
_HELP_PAGE = "plugins.md#what-a-bad-plugin-can-do"


class PanelWatch(QObject):
    """Watch over the panels of a window, from :meth:`install` to :meth:`remove`.

    Parameters
    ----------
    window : QMainWindow
    panels : mapping of str to Panel
        The window's own mapping; a removed panel is deleted from it.
    docks : dict of str to QDockWidget
        The window's own mapping, as for ``panels``.
    tell : callable
        Shows a text to the operator, with a level.
    kinds : mapping of str to type, optional
        The panels' classes, if some panels are not created yet.
    """

    _raised = Signal(object)

    def __init__(
        self,
        window: QMainWindow,
        panels: MutableMapping[str, Panel],
        docks: dict[str, QDockWidget],
        notify: Callable[[Level, str], object],
        kinds: Mapping[str, PanelKind] | None = None,
    ) -> None:
        super().__init__()
        self._window = window
        self._panels = panels
        self._docks = docks
        self._tell = notify
        # Panel names by module and parent package, and by class. They are kept when a panel is
        # removed, so that its code is still recognised.
        self._modules: dict[str, str] = {}
        self._classes: dict[tuple[str, str], str] = {}
        if kinds is None:
            kinds = {name: type(panel) for name, panel in panels.items()}
        self._faults: Counter[str] = Counter()
        for name, kind in kinds.items():
            self._watch_panel(name, kind)
        self._program_fault_counts: Counter[tuple[type[BaseException], str, int]] = Counter()
        self._original_hooks = sys.excepthook, threading.excepthook, sys.unraisablehook
        self._raised.connect(self._on_raised)

    def _watch_panel(self, name: str, kind: PanelKind) -> None:
        if isinstance(kind, type) and not kind.__module__.startswith(_OWN_PREFIX):
            self._classes[kind.__module__, kind.__qualname__] = name
            for module in _list_packages(kind.__module__):
                self._modules.setdefault(module, name)

    def install(self) -> None:
        """Start watching."""
        self._original_hooks = sys.excepthook, threading.excepthook, sys.unraisablehook
        sys.excepthook = self.on_exception
        threading.excepthook = self._on_thread_exception
        sys.unraisablehook = self._on_unraisable

    def remove(self) -> None:
        """Stop watching."""
        sys.excepthook, threading.excepthook, sys.unraisablehook = self._original_hooks

    def on_exception(
        self, kind: type[BaseException], error: BaseException, trace: TracebackType | None
    ) -> None:
        """Handle an uncaught exception of any thread."""
        self._raised.emit(error.with_traceback(trace))

    @contextmanager
    def guard(self) -> Iterator[None]:
        """Handle exceptions of panels in this context.

        If an event raises an exception during a call to Qt, that call raises it again.
        """
        try:
            yield
        except BaseException as error:
            if not self._handle_panel_fault(error, error.__traceback__, handle_painter=invalidate):
                raise

    def _on_thread_exception(self, arguments: threading.ExceptHookArgs) -> None:
        # A thread may raise SystemExit to end itself; that does not affect the program.
        if arguments.exc_value is not None and not isinstance(arguments.exc_value, SystemExit):
            self.on_exception(arguments.exc_type, arguments.exc_value, arguments.exc_traceback)

    def _on_unraisable(self, arguments: "sys.UnraisableHookArgs") -> None:
        if arguments.exc_value is not None:
            self.on_exception(arguments.exc_type, arguments.exc_value, arguments.exc_traceback)

    def _on_raised(self, error: BaseException) -> None:
        if not self._handle_panel_fault(error, error.__traceback__):
            self._log_program_fault(error)

    def _log_program_fault(self, error: BaseException) -> None:
        """Log a fault outside the watched panels; log repeats only at the 2nd, 4th, 8th … time."""
        frames = list(_walk_frames(error.__traceback__))
        location = (frames[-1].f_code.co_filename, frames[-1].f_lineno) if frames else ("", 0)
        self._program_fault_counts[type(error), *location] += 1
        count = self._program_fault_counts[type(error), *location]
        if count == 1:
            logger.error("program error", exc_info=error)
            text = translate(
                "shell",
                "Program error: {error}. The log has details; please save a support bundle.",
            )
            self._tell(Level.ERROR, text.format(error=_describe_error(error)))
        elif count & (count - 1) == 0:
            logger.error(
                "the same program error, %d times so far: %s", count, _describe_error(error)
            )

    def _handle_panel_fault(
        self,
        error: BaseException,
        trace: TracebackType | None,
        handle_painter: Callable[[QPainter], object] = QPainter.end,
    ) -> bool:
        """Handle an exception if the code of a watched panel raised it; return whether it did.

        ``handle_painter`` is called for each painter that was left active. A painter may only be
        ended within the paint event: later, its device may be gone, and Qt would crash.
        """
        frames = list(_walk_frames(trace))
        name = next(filter(None, map(self._find_owner, frames)), None)
        if name is None:
            return False
        if name not in self._panels:
            # The panel is already removed, so later faults in its code are ignored.
            return True
        logger.error("panel %s", name, exc_info=error)
        self._faults[name] += 1
        is_painting = any(frame.f_code.co_name == "paintEvent" for frame in frames)
        if is_painting or self._faults[name] >= MAX_FAULTS:
            panel = self._panels.pop(name)
            dock = self._docks.pop(name, None)
            for painter in _find_active_painters(frames, panel):
                handle_painter(painter)
            text = (
                translate("shell", "Panel {name!r} is left out: it cannot be drawn: {error}")
                if is_painting
                else translate("shell", "Panel {name!r} is left out after {n} faults: {error}")
            )
            message = text.format(name=name, n=self._faults[name], error=_describe_error(error))
            notice = self._make_message(message, name)
            # Later, because this may run inside the panel's own event.
            QTimer.singleShot(0, self._window, lambda: self._remove_panel(panel, dock, notice))
        elif self._faults[name] == 1:
            text = translate("shell", "Panel {name!r} has failed: {error}")
            message = text.format(name=name, error=_describe_error(error))
            self._tell(Level.WARNING, self._make_message(message, name))
        return True

    def _make_message(self, text: str, name: str) -> NoticeMessage:
        return NoticeMessage(text, _HELP_PAGE, subject=make_panel_subject(name))

    def _find_owner(self, frame: FrameType) -> str | None:
        """Return the name of the panel whose code a frame runs.

        The class is checked first, because several panels may share a module.
        """
        module = str(frame.f_globals.get("__name__", ""))
        name = self._classes.get((module, frame.f_code.co_qualname.partition(".")[0]))
        if name is not None:
            return name
        packages = _list_packages(module)
        return next(
            (self._modules[package] for package in packages if package in self._modules), None
        )

    def _remove_panel(self, panel: Panel, dock: QDockWidget | None, notice: NoticeMessage) -> None:
        self._tell(Level.ERROR, notice)
        panel.hide()
        if dock is not None:
            self._window.removeDockWidget(dock)
            dock.deleteLater()
        elif (tabs := _find_tabs(panel)) is not None:
            page = find_frame(panel)
            tabs.removeTab(tabs.indexOf(page))
            page.deleteLater()
        panel.deleteLater()


def _find_active_painters(frames: Iterable[FrameType], panel: Panel) -> Iterator[QPainter]:
    """Yield the painters that a failed paint event left active.

    Qt would paint and resize the whole window with them still active, and crash.
    """
    for variables in (*(frame.f_locals for frame in frames), vars(panel)):
        for value in list(variables.values()):
            if isinstance(value, QPainter) and isValid(value) and value.isActive():
                yield value


def _describe_error(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"


def _walk_frames(trace: TracebackType | None) -> Iterator[FrameType]:
    while trace is not None:
        yield trace.tb_frame
        trace = trace.tb_next


def _list_packages(module: str) -> Iterator[str]:
    while module:
        yield module
        module = module.rpartition(".")[0]


def _find_tabs(panel: QWidget) -> QTabWidget | None:
    widget = panel.parentWidget()
    while widget is not None and not isinstance(widget, QTabWidget):
        widget = widget.parentWidget()
    return widget
