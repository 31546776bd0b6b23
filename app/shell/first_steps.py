"""A card for the first start: four steps, each one click, gone when they are done."""

from collections.abc import Callable
from typing import NamedTuple

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QToolButton, QWidget

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.flow_layout import FlowLayout
from rotemina.app.widgets.layouts import in_row
from rotemina.drivers.samples import DeviceState
from rotemina.sim.trajectory.first_trajectory import example_for

_KEY = "window.first_steps"  # the preference: whether the card is still wanted


class _Step(NamedTuple):
    """A step's buttons, why it cannot be done now, and whether it is done."""

    buttons: tuple[QPushButton, ...]
    tip: str
    against: Callable[[SessionState], str | None]
    done: Callable[[], bool]


class FirstSteps(QFrame):
    """Take the simulator or connect; load the example; play; diagnose.

    It is hidden until :meth:`offer`.

    Signals
    -------
    asked(str) : which panel is to be shown.
    """

    asked = Signal(str)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("notice")
        self.setProperty("level", "info")
        self._bench = workbench
        self._chosen = self._diagnosed = False
        self.stay = button(translate("shell", "Simulator"), self._stay)
        self.connect_ = button(translate("shell", "Connect …"), self._connect)
        self.load = button(translate("shell", "Load example"), self._load)
        self.play = button(translate("shell", "Play"), workbench.toggle_playback)
        self.diagnose = button(translate("shell", "Diagnose"), self._diagnose)
        self.close_ = QToolButton()
        self.close_.setText("✕")
        self.close_.setAutoRaise(True)
        self.close_.setToolTip(translate("shell", "Close this card permanently"))
        self.close_.setAccessibleName(translate("shell", "Close this card permanently"))
        self.close_.clicked.connect(self.end)
        self._steps = self._listed()
        self._marks = [QLabel() for _ in self._steps]
        row = FlowLayout(self)
        row.setContentsMargins(10, 4, 6, 4)
        row.setSpacing(8)
        for mark, step in zip(self._marks, self._steps, strict=True):
            first, *others = step.buttons
            row.addWidget(_in_one(mark, first))
            for one in others:
                row.addWidget(one)
        row.addWidget(self.close_)
        self.hide()

    def offer(self) -> None:
        """Show it, unless it was closed or done at an earlier start."""
        if self.isHidden() and self._bench.settings.get(_KEY, True):
            self.show()
            self._bench.refreshed.connect(self.refresh)

    def end(self) -> None:
        """Put it away for good."""
        self._bench.settings.set(_KEY, False)
        if not self.isHidden():
            self.hide()
            self._bench.refreshed.disconnect(self.refresh)

    def refresh(self, state: SessionState) -> None:
        """Tick what is done; once all is, the card goes."""
        done = [step.done() for step in self._steps]
        for number, (mark, step, ticked) in enumerate(
            zip(self._marks, self._steps, done, strict=True), start=1
        ):
            mark.setText("✓" if ticked else f"{number}")
            for one in step.buttons:
                allow(one, step.against(state), step.tip)
        if all(done):
            self.end()

    # --- steps ------------------------------------------------------------------------------------

    def _listed(self) -> tuple[_Step, ...]:
        bench = self._bench

        def free(_: SessionState) -> str | None:
            return None

        def no_play(state: SessionState) -> str | None:
            if bench.plan is None:
                return translate("shell", "there is no trajectory; load one first")
            if bench.playback.state.phase is PlaybackPhase.PAUSED:
                return translate("shell", "a trajectory is paused; resume or end it")
            if bench.at_rest.against_another is not None:
                return bench.at_rest.against_another
            if state.activity is not DeviceState.IDLE:
                return translate("shell", "the axes are still moving")
            return bench.plan.refusal or state.locked

        def no_diagnosis(_: SessionState) -> str | None:
            if bench.record is not None:
                return None
            return translate("shell", "there is no record; play a trajectory or open one")

        return (
            _Step(
                (self.stay, self.connect_),
                translate("shell", "The simulator moves no real machine"),
                free,
                lambda: self._chosen,
            ),
            _Step(
                (self.load,),
                translate("shell", "A trajectory for this robot, checked on the model first"),
                free,
                lambda: bench.plan is not None,
            ),
            _Step(
                (self.play,),
                translate("shell", "Esc stops"),
                no_play,
                lambda: bench.run is not None,
            ),
            _Step(
                (self.diagnose,),
                translate("shell", "Find out why model and machine differ"),
                no_diagnosis,
                lambda: self._diagnosed,
            ),
        )

    def _stay(self) -> None:
        self._chosen |= self._bench.use_simulator(self._bench.settings)

    def _connect(self) -> None:
        self._chosen = True
        self.asked.emit("connection")

    def _load(self) -> None:
        self.asked.emit("trajectory")
        robot = self._bench.robot
        self._bench.plan_trajectory(translate("shell", "example"), example_for(robot))

    def _diagnose(self) -> None:
        self._diagnosed = True
        self.asked.emit("gap")  # makes the panel, if it is not made yet
        self._bench.diagnosis_asked.emit()


def _in_one(*parts: QWidget) -> QWidget:
    """Return widgets as one, which stay together where a row is broken."""
    together = QWidget()
    in_row(*parts, on=together, margins=0, spacing=4)
    return together
