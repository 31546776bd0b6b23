"""The banner over the panels while a recording is shown, with the controls of the replay."""

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, QSize
from PySide6.QtWidgets import QComboBox, QFrame, QPushButton, QWidget

from rotemina.app.display_units import duration_text
from rotemina.app.motion.recording.replay_pace import SPEEDS
from rotemina.app.motion.state import SessionState
from rotemina.app.recorded_events import timeline_events
from rotemina.app.shell.language import translate
from rotemina.app.shell.state_tone import PhaseLabel, Tone, set_tone
from rotemina.app.shell.timeline import Timeline
from rotemina.app.shell.window_state import WindowSnapshot, describe_state
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.flow_layout import FlowLayout
from rotemina.app.widgets.labels import ElidedLabel, LiveLabel
from rotemina.app.widgets.layouts import in_column
from rotemina.drivers.samples import DeviceState
from rotemina.sim.quantities import rounded


class _Title(ElidedLabel):
    """What is replayed: in a line of its own before it is cut."""

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for all of the text."""
        width = self.fontMetrics().horizontalAdvance(self.text())
        return QSize(width, super().sizeHint().height())


class ReplayBar(QFrame):
    """Says that this is not the machine; play, pause, speed, time, and the way back to live."""

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
        set_tone(self.machine, Tone.DANGER)
        self.live = QPushButton(translate("shell", "Back to live"))
        self.live.setProperty("primary", True)
        self.live.setToolTip(translate("shell", "Show the machine again and permit motion"))
        self.live.clicked.connect(workbench.replaying.end)
        self.play = QPushButton()
        self.play.setMinimumWidth(70)
        self.play.setToolTip(translate("shell", "Resume or pause the replay"))
        self.play.clicked.connect(self._toggle)
        self.speed = _speeds()
        self.speed.currentIndexChanged.connect(self._set_speed)
        self.timeline = Timeline(workbench.theme)
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
        workbench.replaying.changed.connect(self._begin)
        workbench.shown.connect(self._refresh)
        workbench.refreshed.connect(self._watch_machine)
        workbench.theme_changed.connect(self.timeline.use_theme)

    def _lay_out(self) -> None:
        head, foot = QWidget(), QWidget()
        for part, widgets in (
            (head, (self.title, self.phase, self.machine, self.live)),
            (foot, (self.play, self.speed, self.timeline, self.time)),
        ):
            row = FlowLayout(part)
            row.setContentsMargins(0, 0, 0, 0)
            row.setSpacing(6)
            for widget in widgets:
                row.addWidget(widget)
        in_column(head, foot, on=self, margins=(10, 4, 8, 4), spacing=2)

    def _begin(self) -> None:
        """Show the controls of another recording, or none."""
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
                paced.duration_s, timeline_events(paced.replay.events, recording.began_s)
            )
        with QSignalBlocker(self.speed):
            self.speed.setCurrentIndex(SPEEDS.index(paced.speed))
        self._refresh(paced.replay.snapshot())

    def _refresh(self, state: SessionState) -> None:
        paced = self._replaying.paced
        if paced is None:
            return
        # That it is a replay, in which nothing can be moved, is said already.
        recorded = WindowSnapshot(self._workbench.robot, replace(state, locked=None))
        display = describe_state(recorded)
        self.phase.show_word(display.headword, display.tone)
        self.play.setText(
            translate("shell", "Pause") if paced.playing else translate("shell", "Play")
        )
        if not self.timeline.isSliderDown():
            with QSignalBlocker(self.timeline):
                self.timeline.setValue(round(1000.0 * paced.at_s))
        at, whole = duration_text(paced.at_s, 1), duration_text(paced.duration_s, 1)
        self.time.setText(f"{at} / {whole}")

    def _watch_machine(self, state: SessionState) -> None:
        at_rest = state.activity in (DeviceState.IDLE, DeviceState.CLOSED)
        self.machine.setVisible(not at_rest)

    def _toggle(self) -> None:
        paced = self._replaying.paced
        if paced is None:
            return
        if paced.playing:
            paced.pause()
        else:
            paced.play()

    def _set_speed(self) -> None:
        if self._replaying.paced is not None:
            self._replaying.paced.speed = self.speed.currentData()

    def _seek(self, at_s: float) -> None:
        if self._replaying.paced is not None:
            self._replaying.paced.seek(at_s)


def _speeds() -> QComboBox:
    box = QComboBox()
    box.setAccessibleName(translate("shell", "Speed of the replay"))
    box.setToolTip(translate("shell", "Replay speed as a multiple of real time"))
    for speed in SPEEDS:
        box.addItem(f"{rounded(speed, 6)} ×", speed)
    return box
