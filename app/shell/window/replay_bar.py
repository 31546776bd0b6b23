"""The bar above the panels while a recording is shown, with the controls of the replay."""

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, QSize
from PySide6.QtWidgets import QComboBox, QFrame, QPushButton, QWidget

from rotemina.app.language import format_duration, translate
from rotemina.app.motion.recording import REPLAY_SPEEDS
from rotemina.app.motion.state import SessionState
from rotemina.app.records import make_timeline_events
from rotemina.app.shell.window.timeline import ReplayTimeline
from rotemina.app.widgets.layout import FlowLayout, make_column
from rotemina.app.widgets.text import ElidedLabel, LiveLabel
from rotemina.app.workbench import (
    PhaseLabel,
    StateTone,
    WindowSnapshot,
    Workbench,
    describe_state,
    set_tone,
)
from rotemina.drivers.contract import DeviceState
from rotemina.sim.messages import format_rounded


class _Title(ElidedLabel):
    """Title of the recording, which moves to a separate line before it is cut."""

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request the width of the whole text."""
        width = self.fontMetrics().horizontalAdvance(self.text())
        return QSize(width, super().sizeHint().height())


class ReplayBar(QFrame):
    """Bar that marks a replay, with its controls and a button to go back to live."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("replay")
        self._workbench = workbench
        self._replaying = workbench.replaying
        self.title = _Title()
        self.title.setProperty("heading", True)
        self.phase = PhaseLabel()
        self.phase.setAccessibleName(translate("shell", "Phase in the recording"))
        self.phase.setToolTip(
            translate(
                "shell", "State of the machine at that time; the tool bar shows the present state"
            )
        )
        self.machine = LiveLabel(translate("shell", "The machine is moving now"))
        set_tone(self.machine, StateTone.DANGER)
        self.live = QPushButton(translate("shell", "Back to live"))
        self.live.setProperty("primary", True)
        self.live.setToolTip(translate("shell", "Show the machine again and permit motion"))
        self.live.clicked.connect(workbench.replaying.end)
        self.play = QPushButton()
        self.play.setMinimumWidth(70)
        self.play.setToolTip(translate("shell", "Resume or pause the replay"))
        self.play.clicked.connect(self._toggle)
        self.speed = _make_speed_box()
        self.speed.currentIndexChanged.connect(self._set_speed)
        self.timeline = ReplayTimeline(workbench.theme)
        self.timeline.setToolTip(
            translate(
                "shell",
                "Time of the recording. Marks, by importance: faults; stops, refusals and "
                "warnings; others",
            )
        )
        self.timeline.valueChanged.connect(lambda value: self._seek(value / 1000.0))
        self.time = LiveLabel()
        self.time.setAccessibleName(translate("shell", "Time of the replay and its length"))
        self._lay_out()
        self.setVisible(False)
        workbench.replaying.changed.connect(self._show_recording)
        workbench.shown.connect(self._refresh)
        workbench.refreshed.connect(self._watch_machine)
        workbench.theme_changed.connect(self.timeline.use_theme)

    def _lay_out(self) -> None:
        upper, lower = QWidget(), QWidget()
        for part, widgets in (
            (upper, (self.title, self.phase, self.machine, self.live)),
            (lower, (self.play, self.speed, self.timeline, self.time)),
        ):
            row = FlowLayout(part)
            row.setContentsMargins(0, 0, 0, 0)
            row.setSpacing(6)
            for widget in widgets:
                row.addWidget(widget)
        make_column(upper, lower, on=self, margins=(10, 4, 8, 4), spacing=2)

    def _show_recording(self) -> None:
        paced = self._replaying.paced
        self.setVisible(paced is not None)
        if paced is None:
            return
        recording = paced.replay.recording
        self.title.show_text(
            translate("shell", "Replay, not the machine: {stem}").format(stem=recording.path.stem)
        )
        self.title.updateGeometry()
        with QSignalBlocker(self.timeline):
            self.timeline.show_recording(
                paced.duration_s, make_timeline_events(paced.replay.events, recording.began_s)
            )
        with QSignalBlocker(self.speed):
            self.speed.setCurrentIndex(REPLAY_SPEEDS.index(paced.speed))
        self._refresh(paced.replay.snapshot())

    def _refresh(self, state: SessionState) -> None:
        paced = self._replaying.paced
        if paced is None:
            return
        # The lock of the replay is not shown, because the title already says that this is a replay.
        snapshot = WindowSnapshot(self._workbench.robot, replace(state, lock_reason=None))
        display = describe_state(snapshot)
        self.phase.show_phase(display.headword, display.tone)
        self.play.setText(
            translate("shell", "Pause") if paced.is_playing else translate("shell", "Play")
        )
        if not self.timeline.isSliderDown():
            with QSignalBlocker(self.timeline):
                self.timeline.setValue(round(1000.0 * paced.position_s))
        position, duration = (
            format_duration(paced.position_s, 1),
            format_duration(paced.duration_s, 1),
        )
        self.time.setText(f"{position} / {duration}")

    def _watch_machine(self, state: SessionState) -> None:
        at_rest = state.activity in (DeviceState.IDLE, DeviceState.CLOSED)
        self.machine.setVisible(not at_rest)

    def _toggle(self) -> None:
        paced = self._replaying.paced
        if paced is None:
            return
        if paced.is_playing:
            paced.pause()
        else:
            paced.play()

    def _set_speed(self) -> None:
        if self._replaying.paced is not None:
            self._replaying.paced.speed = self.speed.currentData()

    def _seek(self, position_s: float) -> None:
        if self._replaying.paced is not None:
            self._replaying.paced.seek(position_s)


def _make_speed_box() -> QComboBox:
    speed_box = QComboBox()
    speed_box.setAccessibleName(translate("shell", "Speed of the replay"))
    speed_box.setToolTip(translate("shell", "Replay speed as a multiple of real time"))
    for speed in REPLAY_SPEEDS:
        speed_box.addItem(f"{format_rounded(speed, 6)} ×", speed)
    return speed_box
