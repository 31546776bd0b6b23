"""A test bench for panels: a simulated machine, no window, manual time."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic

from PySide6.QtCore import QCoreApplication, QEvent, QEventLoop
from PySide6.QtWidgets import QApplication
from shiboken6 import isValid

from rotemina.app.display_units import axis_scale
from rotemina.app.motion.compared_run import Run, compared
from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.session import MotionSession
from rotemina.app.panel import Panel, make_panel
from rotemina.app.settings import Settings
from rotemina.app.shell import theme as themes
from rotemina.app.shell.loaded_trajectory import Plan
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.records.record import Record
from rotemina.sim.robot.file import load_robot

_READ_S = 0.02
_FRAME_S = 0.04
_WAY_S = 60.0  # of the machine's time, for the way to the first row
_COMPARED_S = 10.0
_ALL_EVENTS = QEventLoop.ProcessEventsFlag.AllEvents


class PanelBench:
    """A panel on a workbench with a connected machine at rest, with its first sample.

    Attributes
    ----------
    panel : Panel
    workbench : Workbench
        The panel's own; what moves the machine is asked of it, as by the panel.
    """

    def __init__(self, panel: Panel, session: MotionSession, clock: VirtualClock) -> None:
        self.panel = panel
        self.workbench = panel.workbench
        self._session = session
        self._clock = clock
        self._others: list[Panel] = []  # end with the bench: nothing ends before its window closes

    def make_another(self) -> Panel:
        """Make another panel of this kind on the same workbench, as the machine stands now."""
        self._others.append(make_panel(type(self.panel), self.workbench))
        return self._others[-1]

    @property
    def panels(self) -> tuple[Panel, ...]:
        """All panels of the bench."""
        return self.panel, *self._others

    def advance(self, seconds: float, *, read: bool = True) -> None:
        """Advance time and show it; without ``read`` the machine has nothing to say meanwhile."""
        left_s = seconds
        while read and left_s > 0.0:
            self._clock.advance(min(_READ_S, left_s))
            self._session.run_once()
            left_s -= _READ_S
        if not read:
            self._clock.advance(seconds)
        self.refresh()

    def hand_record(self, record: Record, name: str = "record") -> Run:
        """Hand the panel a record, compared with the model in use; return the run.

        Raises
        ------
        InputError
            If it does not fit the robot, or nothing was measured.
        """
        run = compared(self._session.model, name, record)
        self.workbench.take_run(run)
        QCoreApplication.processEvents()
        return run

    def play(self, trajectory: Record, name: str = "trajectory") -> Run:
        """Plan a trajectory and play it to its end, as an operator does; return the run.

        The panel hears of the plan, follows the machine at 25 Hz, and is handed the run.

        Parameters
        ----------
        trajectory : Record
            With ``cmd`` of each axis that moves, m or rad, from rest to rest.

        Raises
        ------
        InputError
            If it exceeds a limit, or the machine does not take it now.
        TimeoutError
            If it does not end, or is not compared within 10 s.
        """
        plan = Plan.tried(self._session, name, trajectory)
        checked, before = plan.dry_run.require(), self.workbench.run
        self.workbench.take_plan(plan)
        self.workbench.playback.play(checked)
        most_s = plan.dry_run.duration_s + _WAY_S
        while self.workbench.playback.state.phase is PlaybackPhase.PLAYING:
            self.advance(_FRAME_S)
            most_s -= _FRAME_S
            if most_s < 0.0:
                raise TimeoutError(f"{name}: it does not end")
        ends_s = monotonic() + _COMPARED_S
        while self.workbench.busy or self.workbench.untold:
            if monotonic() > ends_s:
                raise TimeoutError(f"{name}: it is not compared")
            QCoreApplication.processEvents(_ALL_EVENTS, 10)
        self.refresh()
        run = self.workbench.run
        if run is None or run is before:
            raise TimeoutError(f"{name}: it was stopped before its first row")
        return run

    def change_unseen(self, change: Callable[[MotionSession], object]) -> None:
        """Change the machine's state, as another part of the window does, and show nothing yet."""
        change(self._session)
        self._clock.advance(_READ_S)
        self._session.run_once()

    def refresh(self) -> None:
        """Update the panel with the machine's state, as the window does once a frame."""
        self.emit_state()
        QCoreApplication.processEvents()

    def emit_state(self) -> None:
        """Update the panel as :meth:`refresh` does, but let no event be processed."""
        state = self._session.snapshot()
        self.workbench.refreshed.emit(state)
        self.workbench.shown.emit(state)

    def text_of(self, axis: str) -> str:
        """Return the latest reading of an axis as screens write it."""
        described = self.workbench.robot.axes[axis]
        return axis_scale(described).text(self._session.snapshot().measured[axis])


@contextmanager
def panel_bench(kind: type[Panel], robot: str = "rotemina") -> Iterator[PanelBench]:
    """Make a panel on a simulated machine; everything is closed afterwards.

    Parameters
    ----------
    kind : type of Panel
    robot : str
        A shipped robot, or a robot file.
    """
    application = _application()
    with TemporaryDirectory() as folder:
        clock = VirtualClock(1234.5)
        session = MotionSession(Simulator(load_robot(robot), clock=clock))
        themes.prepare(application, themes.DARK)
        settings = Settings(Path(folder) / "settings.json")
        workbench = Workbench(session, settings, themes.DARK, Path(folder) / "played")
        bench = None
        try:
            session.connect()
            session.run_once()
            bench = PanelBench(make_panel(kind, workbench), session, clock)
            themes.dress(bench.panel, themes.DARK)
            yield bench
        finally:
            workbench.close()
            for widget in (*(bench.panels if bench is not None else ()), workbench):
                if isValid(widget):  # a check may have ended it before
                    widget.deleteLater()
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def _application() -> QApplication:
    """Return the application, made without a display if there is none."""
    application = QApplication.instance()
    if application is None:
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
        application = QApplication(["rotemina"])
    assert isinstance(application, QApplication)
    return application
