"""Controls of a playback: play, pause, resume, step by rows, and change the speed factor."""

from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QProgressBar, QPushButton, QWidget

from rotemina.app.motion.playback import (
    MAX_SPEED_RATIO,
    MIN_SPEED_RATIO,
    PlaybackPhase,
    PlaybackState,
)
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    ChangingButton,
    enable_unless,
    name_widget,
    set_bar_value,
)
from rotemina.app.widgets.layout import make_row
from rotemina.app.workbench import Workbench, describe_moved
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.trajectory import mark, tr

STEP_ROWS = (1, 10, 100, 1000)
_NO_TRAJECTORY = mark("no trajectory is loaded")
_DRY_RUN_PROBLEM = mark("the dry run found a problem")


def find_play_objection(workbench: Workbench, session: SessionState) -> str | None:
    """Return why the plan cannot be played, paused or resumed now, or None if it can."""
    playback = workbench.playback.state
    toggle_objection = workbench.find_toggle_objection(playback)
    if playback.phase is PlaybackPhase.PLAYING:
        return toggle_objection
    plan_objection = (
        None if playback.phase is PlaybackPhase.PAUSED else _find_plan_objection(workbench)
    )
    plan_objection = plan_objection or workbench.at_rest.objection
    if (
        plan_objection is None
        and session.lock_reason is None
        and session.activity is not DeviceState.IDLE
    ):
        return tr("the axes are still moving")
    return plan_objection or session.lock_reason or toggle_objection


def _find_plan_objection(workbench: Workbench) -> str | None:
    plan = workbench.plan
    if workbench.planning:
        return tr("the dry run of {name} is under way").format(name=workbench.planning)
    if plan is None or not plan.dry_run.allowed:
        return tr(_NO_TRAJECTORY if plan is None else _DRY_RUN_PROBLEM)
    return plan.refusal or None


def describe_waiting(workbench: Workbench) -> str:
    """Return a text about what a requested playback is waiting for, or an empty text."""
    if workbench.planning:
        return tr("Dry run of {name} …").format(name=workbench.planning)
    return workbench.at_rest.waiting_text


class PlayButton(ChangingButton):
    """Button that plays, pauses or resumes the loaded trajectory, depending on its label."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Play"), tr("Pause"), tr("Resume"), run=workbench.toggle_playback)
        self._workbench = workbench
        self.setProperty("primary", True)

    def refresh(self, session: SessionState) -> None:
        """Show what the next press does, or why the button is unavailable."""
        self.show_meaning(label_play_button(self._workbench.playback.state))
        tooltip = tr("Play, pause or resume (Ctrl+P); the axes first move to the first row")
        enable_unless(self, find_play_objection(self._workbench, session), tooltip)


def label_play_button(playback: PlaybackState) -> str:
    """Return the label of the play button, which says what a press does now."""
    if playback.pausing or playback.phase is PlaybackPhase.PAUSED:
        return tr("Resume")
    return tr("Pause") if playback.phase is PlaybackPhase.PLAYING else tr("Play")


class PlaybackControls(QWidget):
    """Buttons and progress of a playback. The workbench carries out the requests."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.play = PlayButton(workbench)
        self.end = QPushButton(tr("End"))
        self.end.clicked.connect(workbench.end_playback)
        self.back, self.forward = QPushButton(tr("◂ Step")), QPushButton(tr("Step ▸"))
        self.back.clicked.connect(lambda: self._step_rows(-1))
        self.forward.clicked.connect(lambda: self._step_rows(1))
        self.rows = QComboBox()
        self.rows.setAccessibleName(tr("Rows of a step"))
        self.rows.setToolTip(tr("Rows of the trajectory per step, 1 to 1000"))
        for rows in STEP_ROWS:
            self.rows.addItem(
                tr("1 row") if rows == 1 else tr("{rows} rows").format(rows=rows), rows
            )
        self.speed = name_widget(QDoubleSpinBox(), tr("Speed factor"))
        self.speed.setRange(MIN_SPEED_RATIO, MAX_SPEED_RATIO)
        self.speed.setDecimals(2)
        self.speed.setSingleStep(0.05)
        self.speed.setValue(1.0)
        self.speed.setSuffix(" ×")
        self.speed.valueChanged.connect(self._set_pace)
        self.speed.setToolTip(
            tr(
                "Speed of the playback, {slowest:g} to {fastest:g} times that of the "
                "trajectory; a higher one is checked against all limits first. A change "
                "during a pause applies from there on"
            ).format(slowest=MIN_SPEED_RATIO, fastest=MAX_SPEED_RATIO)
        )
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setFormat("")
        self._lay_out()

    def refresh(self, session: SessionState) -> None:
        """Enable the available buttons and show the progress of the playback."""
        state = self._workbench.playback.state
        plan_objection = _find_plan_objection(self._workbench)
        is_playing = state.phase is PlaybackPhase.PLAYING
        is_paused = state.phase is PlaybackPhase.PAUSED
        self.play.refresh(session)
        enable_unless(
            self.end,
            None if is_playing or is_paused else tr("nothing is playing"),
            tr("Stop; the next playback starts from the beginning"),
        )
        step_objection = (
            tr("a trajectory is playing") if is_playing else plan_objection or session.lock_reason
        )
        if is_paused and session.lock_reason is None:
            step_objection = describe_moved(self._workbench.robot, state) or None
        tooltip = tr("Move to the next rows at the speed of the axes and stop there")
        enable_unless(self.forward, step_objection, tooltip)
        enable_unless(
            self.back, step_objection or (None if is_paused else tr("nothing is paused")), tooltip
        )
        self._show_progress(state)

    def reset_pace(self) -> None:
        """Reset the speed factor to 1 for another trajectory."""
        self.speed.setValue(1.0)

    def _lay_out(self) -> None:
        buttons = self.play, self.end, self.speed, self.back, self.forward, self.rows
        make_row(*buttons, (self.progress, 1), on=self, margins=0)

    def _set_pace(self, pace: float) -> None:
        self._workbench.pace = pace

    def _step_rows(self, sign: int) -> None:
        self._workbench.step_playback(sign * int(self.rows.currentData()))

    def _show_progress(self, state: PlaybackState) -> None:
        if state.phase is PlaybackPhase.IDLE:
            set_bar_value(self.progress, 0)
            self.progress.setFormat(describe_waiting(self._workbench))
            return
        completed_fraction = state.path_s / state.duration_s if state.duration_s else 0.0
        set_bar_value(self.progress, round(1000 * completed_fraction))
        remaining_s = (state.duration_s - state.path_s) / state.speed
        row = (
            tr("row {row} of {rows}").format(row=state.row + 1, rows=state.rows)
            if state.row >= 0
            else tr("before its first row")
        )
        paused_text = tr("paused, ") if state.phase is PlaybackPhase.PAUSED else ""
        self.progress.setFormat(
            tr("{paused}{row}, {left_s:.1f} s left").format(
                paused=paused_text, row=row, left_s=remaining_s
            )
        )
