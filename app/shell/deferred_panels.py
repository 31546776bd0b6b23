"""When panels are made: what is seen at once, the rest gradually, while nobody waits for it."""

from collections.abc import Callable, Mapping, Sequence
from threading import Thread

from PySide6.QtCore import QCoreApplication, QElapsedTimer, QEvent, QObject, QTimer, Signal
from PySide6.QtWidgets import QDockWidget

from rotemina.app.motion.state import Connection
from rotemina.app.shell.panel_host import Panels
from rotemina.app.shell.plot import drop_plots_ahead, make_plot_ahead
from rotemina.app.shell.workbench import Workbench

_BETWEEN_MS = 30  # for what the operator does meanwhile
_CONNECTING_MS = 1500  # for which they leave the processor to a machine that is being connected


class LatePanels(QObject):
    """Makes the panels of docks.

    One whose dock is shown is made next. The others follow one by one as soon as the
    window stands, so that a start does not wait for them: in small steps, between which the window
    reacts. They are made before anything is read or compared in the background: none misses a
    trajectory or a record.

    Attributes
    ----------
    load : callable, optional
        Begins to load what the others need, on a thread that it returns; they wait for it.

    Signals
    -------
    done() : all are made.
    """

    done = Signal()

    def __init__(
        self, panels: Panels, docks: Mapping[str, QDockWidget], workbench: Workbench
    ) -> None:
        super().__init__(workbench)
        self._panels, self._docks, self._session = panels, docks, workbench.session
        self.load: Callable[[], Thread] | None = None
        self._loading: Thread | None = None
        self._since = QElapsedTimer()
        self._look = QTimer(self, singleShot=True, interval=0)
        self._look.timeout.connect(self.make_seen)
        self._next = QTimer(self, interval=_BETWEEN_MS)
        self._next.timeout.connect(self._make_next)
        for dock in docks.values():
            dock.visibilityChanged.connect(lambda seen: seen and self._look.start(0))
        for name in panels.waiting:
            if panels.kinds[name].at_once:
                panels.make(name)
        workbench.busy_changed.connect(self._before_work)
        workbench.closing.connect(self._end)

    def start(self) -> None:
        """Begin to make those that are not seen."""
        self._since.start()
        self._next.start()

    def make_seen(self) -> None:
        """Make those whose docks are in sight; the others wait until these are painted.

        Until the window is shown all of them are made at once, and from then on in steps.
        """
        seen = [name for name in self._panels.waiting if self._is_seen(name)]
        if not self._since.isValid():
            self._make_at_once(seen)
        elif seen or self._panels.has_unplaced:
            self._make_step(seen[0] if seen else "")
            self._look.start(_BETWEEN_MS if self._is_loading else 0)
        if self._next.isActive():
            self._next.start()

    def _make_at_once(self, names: Sequence[str]) -> None:
        for name in names:
            self._panels.make(name)
        if names:  # laid out before anything is painted: plots take long to paint again
            for _ in range(3):  # what frames need, and docks, and how the window shares its room
                QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)

    def _is_seen(self, name: str) -> bool:
        dock = self._docks.get(name)
        return dock is not None and dock.isVisible() and not dock.visibleRegion().isEmpty()

    def _make_next(self) -> None:
        connected = self._session.snapshot().connection is Connection.CONNECTED
        if not connected and self._since.elapsed() < _CONNECTING_MS:
            return
        if not self._make_step():
            drop_plots_ahead()
            self._next.stop()
            self.done.emit()

    def _make_step(self, first: str = "") -> bool:
        """Do a part of the work that the window does not feel; return whether there is more.

        Modules are loaded on another thread before, and plots made one by one.
        """
        if self.load is not None:
            self._loading, self.load = self.load(), None
        if self._is_loading or (self._panels.waiting and not make_plot_ahead()):
            return True
        return self._panels.make_step(first)

    @property
    def _is_loading(self) -> bool:
        return self._loading is not None and self._loading.is_alive()

    def _before_work(self, doing: str) -> None:
        if doing and not self._panels.making:  # some read a file of their own when they are made
            self._panels.make_all()

    def _end(self) -> None:
        self._look.stop()
        self._next.stop()
        drop_plots_ahead()
