"""A test bench for panels with a simulated machine and a virtual clock, without a window."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication, QEvent, QEventLoop
from PySide6.QtWidgets import QApplication
from shiboken6 import isValid

from rotemina.app.language import choose_axis_scale
from rotemina.app.motion.playback import ComparedRun, PlaybackPhase, compare_with_model
from rotemina.app.motion.session import MotionSession
from rotemina.app.panel import Panel, make_panel
from rotemina.app.settings import UserSettings
from rotemina.app.widgets.style import theme as themes
from rotemina.app.workbench import TrajectoryPlan, Workbench
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.records import Record
from rotemina.sim.robot_files import load_robot

_READ_PERIOD_S = 0.02
_FRAME_PERIOD_S = 0.04
# Longest simulated time until the machine reaches the first row of a trajectory.
_MAX_APPROACH_S = 60.0
_COMPARISON_TIMEOUT_S = 10.0
_ALL_EVENTS = QEventLoop.ProcessEventsFlag.AllEvents


class PanelBench:
    """A panel and its workbench, with a connected machine at rest that has sent its first sample.

    Attributes
    ----------
    panel : Panel
    workbench : Workbench
        The workbench of the panel. Tests move the machine through it, as the panel does.
    """

    def __init__(self, panel: Panel, session: MotionSession, clock: VirtualClock) -> None:
        self.panel = panel
        self.workbench = panel.workbench
        self._session = session
        self._clock = clock
        # These panels are closed with the bench, as panels are closed with their window.
        self._other_panels: list[Panel] = []

    def make_another(self) -> Panel:
        """Make another panel of this class on the same workbench, in the present state."""
        self._other_panels.append(make_panel(type(self.panel), self.workbench))
        return self._other_panels[-1]

    @property
    def panels(self) -> tuple[Panel, ...]:
        """All panels of the bench."""
        return self.panel, *self._other_panels

    def advance(self, seconds: float, *, read: bool = True) -> None:
        """Advance the clock and update the panel; without ``read``, no samples arrive."""
        remaining_s = seconds
        while read and remaining_s > 0.0:
            self._clock.advance(min(_READ_PERIOD_S, remaining_s))
            self._session.run_once()
            remaining_s -= _READ_PERIOD_S
        if not read:
            self._clock.advance(seconds)
        self.refresh()

    def hand_record(self, record: Record, name: str = "record") -> ComparedRun:
        """Load a record as the run of the workbench, compared with the model; return the run.

        Raises
        ------
        InputError
            If the record does not fit the robot, or has no measured signal.
        """
        run = compare_with_model(self._session.model, name, record)
        self.workbench.take_run(run)
        QCoreApplication.processEvents()
        return run

    def play(self, trajectory: Record, name: str = "trajectory") -> ComparedRun:
        """Load a trajectory and play it to its end, as an operator does; return the run.

        The panel receives the plan, the states of the machine at 25 Hz, and the run.

        Parameters
        ----------
        trajectory : Record
            Has ``cmd`` of each axis that moves, m or rad, from rest to rest.

        Raises
        ------
        InputError
            If it exceeds a limit, or the machine cannot play it now.
        TimeoutError
            If it does not end, or its comparison takes more than 10 s.
        """
        plan = TrajectoryPlan.from_trajectory(self._session, name, trajectory)
        checked, previous_run = plan.dry_run.require(), self.workbench.run
        self.workbench.take_plan(plan)
        self.workbench.playback.play(checked)
        remaining_s = plan.dry_run.duration_s + _MAX_APPROACH_S
        while self.workbench.playback.state.phase is PlaybackPhase.PLAYING:
            self.advance(_FRAME_PERIOD_S)
            remaining_s -= _FRAME_PERIOD_S
            if remaining_s < 0.0:
                raise TimeoutError(f"{name}: the playback does not end")
        deadline_s = monotonic() + _COMPARISON_TIMEOUT_S
        while self.workbench.busy or self.workbench.has_unhandled_playback:
            if monotonic() > deadline_s:
                raise TimeoutError(f"{name}: its comparison does not end")
            QCoreApplication.processEvents(_ALL_EVENTS, 10)
        self.refresh()
        run = self.workbench.run
        if run is None or run is previous_run:
            raise TimeoutError(f"{name}: the playback was stopped before its first row")
        return run

    def change_without_update(self, change: Callable[[MotionSession], object]) -> None:
        """Change the machine's state, as other parts of the window do; do not update the panel."""
        change(self._session)
        self._clock.advance(_READ_PERIOD_S)
        self._session.run_once()

    def refresh(self) -> None:
        """Update the panel with the machine's state, as the window does once a frame."""
        self.emit_state()
        QCoreApplication.processEvents()

    def emit_state(self) -> None:
        """Update the panel as :meth:`refresh` does, but do not process events."""
        state = self._session.snapshot()
        self.workbench.refreshed.emit(state)
        self.workbench.shown.emit(state)

    def text_of(self, axis: str) -> str:
        """Return the latest reading of an axis as displayed text."""
        axis_model = self.workbench.robot.axes[axis]
        return choose_axis_scale(axis_model).format_with_unit(
            self._session.snapshot().measured[axis]
        )

    # Former names, which work for one more release.
    change_unseen = FormerMember("change_without_update")


@contextmanager
def open_panel_bench(kind: type[Panel], robot: str = "rotemina") -> Iterator[PanelBench]:
    """Make a panel with a simulated machine; close everything afterwards.

    Parameters
    ----------
    kind : type of Panel
    robot : str
        Name of a shipped robot, or a robot file.
    """
    application = _get_application()
    with TemporaryDirectory() as folder:
        clock = VirtualClock(1234.5)
        session = MotionSession(Simulator(load_robot(robot), clock=clock))
        themes.apply_palette(application, themes.DARK)
        settings = UserSettings(Path(folder) / "settings.json")
        workbench = Workbench(session, settings, themes.DARK, Path(folder) / "played")
        bench = None
        try:
            session.connect()
            session.run_once()
            bench = PanelBench(make_panel(kind, workbench), session, clock)
            themes.apply_theme(bench.panel, themes.DARK)
            yield bench
        finally:
            workbench.close()
            for widget in (*(bench.panels if bench is not None else ()), workbench):
                # A check may have deleted the widget already.
                if isValid(widget):
                    widget.deleteLater()
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def _get_application() -> QApplication:
    """Return the application; make an offscreen one if there is none."""
    application = QApplication.instance()
    if application is None:
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
        application = QApplication(["rotemina"])
    assert isinstance(application, QApplication)
    return application


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        panel_bench="open_panel_bench",
    )
