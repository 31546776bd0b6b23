"""The controls of a playback: play, pause, continue, step through it, and at which pace."""

from PySide6.QtWidgets import (
    QComboBox,
    QDoubleSpinBox,
    QProgressBar,
    QPushButton,
    QWidget,
)

from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.retiming import FASTEST, SLOWEST
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, fill
from rotemina.app.widgets.layouts import in_row
from rotemina.drivers.samples import DeviceState

STEPS = (1, 10, 100, 1000)  # rows
_EMPTY = marked("trajectory", "no trajectory is loaded")
_FORBIDDEN = marked("trajectory", "the dry run found an objection")


def against_playing(workbench: Workbench, session: SessionState) -> str | None:
    """Return why the plan in hand cannot be played, or gone on with, now; None: it can."""
    paused = workbench.playback.state.phase is PlaybackPhase.PAUSED
    missing = None if paused else _missing(workbench)
    if missing is None and session.locked is None and session.activity is not DeviceState.IDLE:
        return translate("trajectory", "the axes are still moving")
    return missing or session.locked


def _missing(workbench: Workbench) -> str | None:
    """Return what is wrong with the plan in hand, or None."""
    plan = workbench.plan
    if plan is None or not plan.dry_run.allowed:
        return translate("trajectory", _EMPTY if plan is None else _FORBIDDEN)
    return plan.refusal or None


def play_word(phase: PlaybackPhase) -> str:
    """Return what the one button of a playback does now."""
    words = {
        PlaybackPhase.PLAYING: translate("trajectory", "Pause"),
        PlaybackPhase.PAUSED: translate("trajectory", "Resume"),
    }
    return words.get(phase, translate("trajectory", "Play"))


class Transport(QWidget):
    """Buttons and progress; what they ask for goes through the workbench."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.play = QPushButton(translate("trajectory", "Play"))
        self.play.setProperty("primary", True)
        self.play.clicked.connect(workbench.toggle_playback)
        self.end = QPushButton(translate("trajectory", "End"))
        self.end.clicked.connect(workbench.end_playback)
        self.back, self.forward = (
            QPushButton(translate("trajectory", "◂ Step")),
            QPushButton(translate("trajectory", "Step ▸")),
        )
        self.back.clicked.connect(lambda: self._step(-1))
        self.forward.clicked.connect(lambda: self._step(1))
        self.rows = QComboBox()
        self.rows.setAccessibleName(translate("trajectory", "Rows of a step"))
        self.rows.setToolTip(translate("trajectory", "Rows of the trajectory per step, 1 to 1000"))
        for rows in STEPS:
            self.rows.addItem(
                translate("trajectory", "1 row")
                if rows == 1
                else translate("trajectory", "{rows} rows").format(rows=rows),
                rows,
            )
        self.speed = QDoubleSpinBox()
        self.speed.setRange(SLOWEST, FASTEST)
        self.speed.setDecimals(2)
        self.speed.setSingleStep(0.05)
        self.speed.setValue(1.0)
        self.speed.setSuffix(" ×")
        self.speed.setAccessibleName(translate("trajectory", "Speed factor"))
        self.speed.valueChanged.connect(self._set_pace)
        self.speed.setToolTip(
            translate(
                "trajectory",
                "Speed of the playback, {slowest:g} to {fastest:g} times that of the "
                "trajectory; a higher one is checked against all limits first. A change "
                "during a pause applies from there on",
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
        self.play.setText(play_word(state.phase))
        why = None if playing else against_playing(self._workbench, session)
        tip = translate(
            "trajectory", "Play, pause or resume (Ctrl+P); the axes first move to the first row"
        )
        allow(self.play, why, tip)
        allow(
            self.end,
            None if playing or paused else translate("trajectory", "nothing is playing"),
            translate("trajectory", "Stop; the next playback starts from the beginning"),
        )
        still = (
            translate("trajectory", "a trajectory is playing")
            if playing
            else missing or session.locked
        )
        if paused and session.locked is None:
            still = None
        tip = translate(
            "trajectory", "Move to the next rows at the speed of the axes and stop there"
        )
        allow(self.forward, still, tip)
        allow(
            self.back,
            still or (None if paused else translate("trajectory", "nothing is paused")),
            tip,
        )
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
            self.progress.setFormat("")
            return
        share = state.path_s / state.duration_s if state.duration_s else 0.0
        fill(self.progress, round(1000 * share))
        left_s = (state.duration_s - state.path_s) / state.speed
        row = (
            translate("trajectory", "row {row} of {rows}").format(
                row=state.row + 1, rows=state.rows
            )
            if state.row >= 0
            else translate("trajectory", "before its first row")
        )
        paused = translate("trajectory", "paused, ") if state.phase is PlaybackPhase.PAUSED else ""
        self.progress.setFormat(
            translate("trajectory", "{paused}{row}, {left_s:.1f} s left").format(
                paused=paused, row=row, left_s=left_s
            )
        )
