"""Deferred creation of panels: visible ones at once, the others in small steps."""

from collections.abc import Callable, Mapping, Sequence
from threading import Thread

from PySide6.QtCore import QCoreApplication, QElapsedTimer, QEvent, QObject, QTimer, Signal
from PySide6.QtWidgets import QDockWidget

from rotemina.app.motion.state import ConnectionState
from rotemina.app.shell.panels.panel_host import PanelCollection
from rotemina.app.widgets.drawing import drop_spare_plots, make_spare_plot
from rotemina.app.workbench import Workbench

# Pause between two steps, in which the window handles the operator's input.
_STEP_INTERVAL_MS = 30
# Panels wait at most this long for a machine that is being connected, which needs the processor.
_MAX_CONNECTION_WAIT_MS = 1500


class DeferredPanelLoader(QObject):
    """Loader that creates the panels of docks.

    A panel whose dock becomes visible is created next. The others follow one by one once the window
    is shown, so that the start does not wait for them; the window reacts between the steps. All
    panels are created before anything is read or compared in the background, so no panel misses a
    trajectory or a record.

    Attributes
    ----------
    load : callable, optional
        Starts and returns a thread that imports the modules of the other panels. They are created
        once it has ended.

    Signals
    -------
    done() : all panels are created.
    """

    done = Signal()

    def __init__(
        self, panels: PanelCollection, docks: Mapping[str, QDockWidget], workbench: Workbench
    ) -> None:
        super().__init__(workbench)
        self._panels, self._docks, self._session = panels, docks, workbench.session
        self.start_loading: Callable[[], Thread] | None = None
        self._loading: Thread | None = None
        self._since = QElapsedTimer()
        self._visibility_timer = QTimer(self, singleShot=True, interval=0)
        self._visibility_timer.timeout.connect(self.make_visible_panels)
        self._next = QTimer(self, interval=_STEP_INTERVAL_MS)
        self._next.timeout.connect(self._make_next)
        for dock in docks.values():
            dock.visibilityChanged.connect(
                lambda visible: visible and self._visibility_timer.start(0)
            )
        for name in panels.pending_names:
            if panels.panel_types[name].at_once:
                panels.make(name)
        workbench.jobs.busy_changed.connect(self._make_all_before_work)
        workbench.closing.connect(self._stop)

    def start(self) -> None:
        """Begin to create the panels that are not visible."""
        self._since.start()
        self._next.start()

    def make_visible_panels(self) -> None:
        """Create the panels of visible docks; the others wait until these are painted.

        Before the window is shown, all visible ones are created at once; afterwards they are
        created in steps.
        """
        visible_names = [name for name in self._panels.pending_names if self._is_visible(name)]
        if not self._since.isValid():
            self._make_immediately(visible_names)
        elif visible_names or self._panels.has_unplaced:
            self._make_step(visible_names[0] if visible_names else "")
            self._visibility_timer.start(_STEP_INTERVAL_MS if self._is_loading else 0)
        if self._next.isActive():
            self._next.start()

    def _make_immediately(self, names: Sequence[str]) -> None:
        for name in names:
            self._panels.make(name)
        # Painting plots twice is slow, so the layout is finished before anything is painted.
        if names:
            # One pass each for the frames, the docks and the window's division of space.
            for _ in range(3):
                QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)

    def _is_visible(self, name: str) -> bool:
        dock = self._docks.get(name)
        return dock is not None and dock.isVisible() and not dock.visibleRegion().isEmpty()

    def _make_next(self) -> None:
        connected = self._session.snapshot().connection is ConnectionState.CONNECTED
        if not connected and self._since.elapsed() < _MAX_CONNECTION_WAIT_MS:
            return
        if not self._make_step():
            drop_spare_plots()
            self._next.stop()
            self.done.emit()

    def _make_step(self, preferred_name: str = "") -> bool:
        """Do one short step of the work; return whether there is more to do.

        The first steps import the modules on another thread and create plots one by one.
        """
        if self.start_loading is not None:
            self._loading, self.start_loading = self.start_loading(), None
        if self._is_loading or (self._panels.pending_names and not make_spare_plot()):
            return True
        return self._panels.make_step(preferred_name)

    @property
    def _is_loading(self) -> bool:
        return self._loading is not None and self._loading.is_alive()

    def _make_all_before_work(self, activity: str) -> None:
        # Some panels start to read a file while they are created. That must not create the others.
        if activity and not self._panels.is_making:
            self._panels.make_all()

    def _stop(self) -> None:
        self._visibility_timer.stop()
        self._next.stop()
        drop_spare_plots()
