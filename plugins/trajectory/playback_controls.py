"""The controls of a playback: play, pause, continue, step through it, and at which pace."""

from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QProgressBar, QPushButton, QWidget

from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.retiming import FASTEST, SLOWEST
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.state_words import describe_moved
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import allow, fill, named
from rotemina.app.widgets.layouts import in_row
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.trajectory import mark, tr

STEPS = (1, 10, 100, 1000)  # rows
_EMPTY = mark("no trajectory is loaded")
_FORBIDDEN = mark("the dry run found a problem")


def against_playing(workbench: Workbench, session: SessionState) -> str | None:
    """Return why the plan cannot be played, paused or resumed now; None: it can."""
    playback = workbench.playback.state
    changing = workbench.against_toggling(playback)
    if playback.phase is PlaybackPhase.PLAYING:
        return changing
    missing = None if playback.phase is PlaybackPhase.PAUSED else _missing(workbench)
    missing = missing or workbench.at_rest.against_another
    if missing is None and session.locked is None and session.activity is not DeviceState.IDLE:
        return tr("the axes are still moving")
    return missing or session.locked or changing


def _missing(workbench: Workbench) -> str | None:
    """Return what is wrong with the plan in hand, or None."""
    plan = workbench.plan
    if workbench.planning:
        return tr("the dry run of {name} is under way").format(name=workbench.planning)
    if plan is None or not plan.dry_run.allowed:
        return tr(_EMPTY if plan is None else _FORBIDDEN)
    return plan.refusal or None


def waiting_words(workbench: Workbench) -> str:
    """Return what the button that plays waits for; empty while it waits for nothing."""
    if workbench.planning:
        return tr("Dry run of {name} …").format(name=workbench.planning)
    return workbench.at_rest.words


class PlayButton(ChangingButton):
    """Plays, pauses or resumes the loaded trajectory, as it says."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Play"), tr("Pause"), tr("Resume"), run=workbench.toggle_playback)
        self._workbench = workbench
        self.setProperty("primary", True)

    def refresh(self, session: SessionState) -> None:
        """Show what the next press does, or why it can do nothing now."""
        self.show_meaning(play_word(self._workbench.playback.state))
        tip = tr("Play, pause or resume (Ctrl+P); the axes first move to the first row")
        allow(self, against_playing(self._workbench, session), tip)


def play_word(playback: PlaybackState) -> str:
    """Return what the one button of a playback does now."""
    if playback.pausing or playback.phase is PlaybackPhase.PAUSED:
        return tr("Resume")
    return tr("Pause") if playback.phase is PlaybackPhase.PLAYING else tr("Play")


class Transport(QWidget):
    """Buttons and progress; what they ask for goes through the workbench."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.play = PlayButton(workbench)
        self.end = QPushButton(tr("End"))
        self.end.clicked.connect(workbench.end_playback)
        self.back, self.forward = QPushButton(tr("◂ Step")), QPushButton(tr("Step ▸"))
        self.back.clicked.connect(lambda: self._step(-1))
        self.forward.clicked.connect(lambda: self._step(1))
        self.rows = QComboBox()
        self.rows.setAccessibleName(tr("Rows of a step"))
        self.rows.setToolTip(tr("Rows of the trajectory per step, 1 to 1000"))
        for rows in STEPS:
            self.rows.addItem(
                tr("1 row") if rows == 1 else tr("{rows} rows").format(rows=rows), rows
            )
        self.speed = named(QDoubleSpinBox(), tr("Speed factor"))
        self.speed.setRange(SLOWEST, FASTEST)
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
            ).format(slowest=SLOWEST, fastest=FASTEST)
        )
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setFormat("")
        self._lay_out()

    def refresh(self, session: SessionState) -> None:
        """Show what may be done now, and how far the playback is."""
        state = self._workbench.playback.state
        missing = _missing(self._workbench)
        playing = state.phase is PlaybackPhase.PLAYING
        paused = state.phase is PlaybackPhase.PAUSED
        self.play.refresh(session)
        allow(
            self.end,
            None if playing or paused else tr("nothing is playing"),
            tr("Stop; the next playback starts from the beginning"),
        )
        still = tr("a trajectory is playing") if playing else missing or session.locked
        if paused and session.locked is None:
            still = describe_moved(self._workbench.robot, state) or None
        tip = tr("Move to the next rows at the speed of the axes and stop there")
        allow(self.forward, still, tip)
        allow(self.back, still or (None if paused else tr("nothing is paused")), tip)
        self._show_progress(state)

    def show_plan(self) -> None:
        """Begin again with another trajectory, at its own pace."""
        self.speed.setValue(1.0)

    def _lay_out(self) -> None:
        buttons = self.play, self.end, self.speed, self.back, self.forward, self.rows
        in_row(*buttons, (self.progress, 1), on=self, margins=0)

    def _set_pace(self, pace: float) -> None:
        self._workbench.pace = pace

    def _step(self, sign: int) -> None:
        self._workbench.step_playback(sign * int(self.rows.currentData()))

    def _show_progress(self, state: PlaybackState) -> None:
        if state.phase is PlaybackPhase.IDLE:
            fill(self.progress, 0)
            self.progress.setFormat(waiting_words(self._workbench))
            return
        share = state.path_s / state.duration_s if state.duration_s else 0.0
        fill(self.progress, round(1000 * share))
        left_s = (state.duration_s - state.path_s) / state.speed
        row = (
            tr("row {row} of {rows}").format(row=state.row + 1, rows=state.rows)
            if state.row >= 0
            else tr("before its first row")
        )
        paused = tr("paused, ") if state.phase is PlaybackPhase.PAUSED else ""
        self.progress.setFormat(
            tr("{paused}{row}, {left_s:.1f} s left").format(paused=paused, row=row, left_s=left_s)
        )
