"""A card with the first four steps for a new user; it disappears when they are done."""

from collections.abc import Callable
from typing import NamedTuple

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QToolButton, QWidget

from rotemina.app.language import translate
from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import enable_unless, make_button
from rotemina.app.widgets.layout import FlowLayout, make_row
from rotemina.app.workbench import Workbench
from rotemina.drivers.contract import DeviceState
from rotemina.sim.trajectory import make_example

# Preference: whether the card is still shown.
_WANTED_KEY = "window.first_steps"


class _Step(NamedTuple):
    """One step: its buttons, their tooltip, why it cannot be done now, and whether it is done."""

    buttons: tuple[QPushButton, ...]
    tip: str
    find_objection: Callable[[SessionState], str | None]
    is_done: Callable[[], bool]


class FirstStepsCard(QFrame):
    """A card with four steps: choose the simulator or connect, load the example, play, diagnose.

    The card is hidden until :meth:`offer` is called.

    Signals
    -------
    panel_asked(str) : the panel of this name should be shown.
    """

    panel_asked = Signal(str)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("notice")
        self.setProperty("level", "info")
        self._bench = workbench
        self._is_device_chosen = self._is_diagnosis_started = False
        self.simulator_button = make_button(translate("shell", "Simulator"), self._use_simulator)
        self.connect_ = make_button(translate("shell", "Connect …"), self._connect)
        self.load = make_button(translate("shell", "Load example"), self._load)
        self.play = make_button(translate("shell", "Play"), workbench.toggle_playback)
        self.diagnose = make_button(translate("shell", "Diagnose"), self._diagnose)
        self.close_ = QToolButton()
        self.close_.setText("✕")
        self.close_.setAutoRaise(True)
        self.close_.setToolTip(translate("shell", "Close this card permanently"))
        self.close_.setAccessibleName(translate("shell", "Close this card permanently"))
        self.close_.clicked.connect(self.end)
        self._steps = self._make_steps()
        self._marks = [QLabel() for _ in self._steps]
        row = FlowLayout(self)
        row.setContentsMargins(10, 4, 6, 4)
        row.setSpacing(8)
        for number_label, step in zip(self._marks, self._steps, strict=True):
            first, *others = step.buttons
            row.addWidget(_group_widgets(number_label, first))
            for extra_button in others:
                row.addWidget(extra_button)
        row.addWidget(self.close_)
        self.hide()

    def offer(self) -> None:
        """Show the card, unless it was closed or finished at an earlier start."""
        if self.isHidden() and self._bench.settings.get(_WANTED_KEY, True):
            self.show()
            self._bench.refreshed.connect(self.refresh)

    def end(self) -> None:
        """Hide the card permanently."""
        self._bench.settings.set(_WANTED_KEY, False)
        if not self.isHidden():
            self.hide()
            self._bench.refreshed.disconnect(self.refresh)

    def refresh(self, state: SessionState) -> None:
        """Tick the finished steps; hide the card once all are finished."""
        completed = [step.is_done() for step in self._steps]
        for number, (number_label, step, is_completed) in enumerate(
            zip(self._marks, self._steps, completed, strict=True), start=1
        ):
            number_label.setText("✓" if is_completed else f"{number}")
            for step_button in step.buttons:
                enable_unless(step_button, step.find_objection(state), step.tip)
        if all(completed):
            self.end()

    def _make_steps(self) -> tuple[_Step, ...]:
        bench = self._bench

        def find_no_objection(_: SessionState) -> str | None:
            return None

        def find_play_objection(state: SessionState) -> str | None:
            if bench.plan is None:
                return translate("shell", "there is no trajectory; load one first")
            if bench.playback.state.phase is PlaybackPhase.PAUSED:
                return translate("shell", "a trajectory is paused; resume or end it")
            if bench.at_rest.objection is not None:
                return bench.at_rest.objection
            if state.activity is not DeviceState.IDLE:
                return translate("shell", "the axes are still moving")
            return bench.plan.refusal or state.lock_reason

        def find_diagnosis_objection(_: SessionState) -> str | None:
            if bench.record is not None:
                return None
            return translate("shell", "there is no record; play a trajectory or open one")

        return (
            _Step(
                (self.simulator_button, self.connect_),
                translate("shell", "The simulator moves no real machine"),
                find_no_objection,
                lambda: self._is_device_chosen,
            ),
            _Step(
                (self.load,),
                translate("shell", "A trajectory for this robot, checked on the model first"),
                find_no_objection,
                lambda: bench.plan is not None,
            ),
            _Step(
                (self.play,),
                translate("shell", "Esc stops"),
                find_play_objection,
                lambda: bench.run is not None,
            ),
            _Step(
                (self.diagnose,),
                translate("shell", "Find out why model and machine differ"),
                find_diagnosis_objection,
                lambda: self._is_diagnosis_started,
            ),
        )

    def _use_simulator(self) -> None:
        self._is_device_chosen |= self._bench.use_simulator(self._bench.settings)

    def _connect(self) -> None:
        self._is_device_chosen = True
        self.panel_asked.emit("connection")

    def _load(self) -> None:
        self.panel_asked.emit("trajectory")
        robot = self._bench.robot
        self._bench.plan_trajectory(translate("shell", "example"), make_example(robot))

    def _diagnose(self) -> None:
        self._is_diagnosis_started = True
        # Showing the panel also creates it, if it does not exist yet.
        self.panel_asked.emit("gap")
        self._bench.diagnosis_asked.emit()


def _group_widgets(*parts: QWidget) -> QWidget:
    """Group widgets so that they stay together when a row breaks into several lines."""
    group = QWidget()
    make_row(*parts, on=group, margins=0, spacing=4)
    return group
