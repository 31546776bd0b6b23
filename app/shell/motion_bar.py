"""The header: which machine, how it stands and what helps, chips, and the stops."""

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QToolBar,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.display_units import duration_text, size_text
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.header_row import HeaderRow
from rotemina.app.shell.helping_button import HelpingButton
from rotemina.app.shell.language import translate
from rotemina.app.shell.machine_badge import MachineBadge
from rotemina.app.shell.model_chip import ModelChip
from rotemina.app.shell.state_tone import PhaseLabel, Tone, set_tone
from rotemina.app.shell.state_words import describe_movers, sentence
from rotemina.app.shell.stop_controls import EmergencyButton, StopButton
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import ElidedLabel


class StateView(QWidget):
    """The state in a word, the reason below it, and the button that helps."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.phase, self.doing = PhaseLabel(), ElidedLabel()
        self.doing.setProperty("quiet", True)
        self.help = HelpingButton(workbench)
        words = QVBoxLayout()
        words.setSpacing(2)
        words.addWidget(self.phase, 0, Qt.AlignmentFlag.AlignLeft)
        words.addWidget(self.doing)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addLayout(words, 1)
        row.addWidget(self.help)

    def show_reason(self, visible: bool) -> None:
        """Show the line below the state, or only the state."""
        self.doing.setVisible(visible)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        display = self._workbench.describe(state)
        self.phase.show_word(display.headword, display.tone)
        self.doing.show_text(display.reason)
        self.help.show_remedy(display.remedy)


class OwnerChip(QLabel):
    """Who drives axes now: operator, joystick, playback, penetration …; quiet while nobody does."""

    def __init__(self) -> None:
        super().__init__()
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setAccessibleName(translate("shell", "Who moves the machine"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self._told = ""
        self._show("", "")

    def refresh(self, state: SessionState) -> None:
        """Show who drives."""
        owners = " + ".join(dict.fromkeys(map(spoken, state.owners.values())))
        if owners != self._told:
            self._show(owners, describe_movers(state))

    def _show(self, owners: str, axes: str) -> None:
        self._told = owners
        self.setText(sentence(owners) if owners else translate("shell", "No one is driving"))
        set_tone(self, Tone.BUSY if owners else Tone.QUIET)
        self.setToolTip(
            plain_tip(
                translate("shell", "Who moves the machine: each moving axis has one owner"),
                axes or translate("shell", "Nobody at present."),
            )
        )


class RecordingSign(QLabel):
    """For how long it is recorded and how much, or that the disk takes nothing.

    Signals
    -------
    running(bool) : whether there is a recording.
    """

    running = Signal(bool)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._operation = workbench.operation
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setAccessibleName(translate("shell", "Recording"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self, Tone.BUSY)
        workbench.refreshed.connect(lambda _: self.refresh())

    def refresh(self) -> None:
        """Show how the recording stands."""
        recorder = self._operation.recording
        self.running.emit(recorder is not None)
        if recorder is None:
            return
        writer = recorder.writer
        if writer.failure is not None:
            set_tone(self, Tone.DANGER)
            self.setText(translate("shell", "● Not recording: disk"))
            self.setToolTip(plain_tip(f"{writer.path}: {writer.failure}"))
            return
        set_tone(self, Tone.BUSY)
        since_s = self._operation.clock() - writer.began_s
        self.setText(
            translate("shell", "● {time}  {size}").format(
                time=duration_text(since_s), size=size_text(writer.bytes_written)
            )
        )
        self.setToolTip(
            plain_tip(
                translate("shell", "Time and size of the running recording"), str(writer.path)
            )
        )


class EventsChip(QToolButton):
    """How many warnings and errors came since the log was opened."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("model")  # a chip like that of the model
        self.setToolTip(
            plain_tip(translate("shell", "Warnings and errors since the log was opened (Ctrl+L)"))
        )
        self._count = 0
        workbench.noticed.connect(self._count_notice)
        self.clicked.connect(self._forget)
        self._show()

    def _count_notice(self, level: Level, _text: str) -> None:
        if level in (Level.WARNING, Level.ERROR):
            self._count += 1
            self._show()

    def _forget(self) -> None:
        self._count = 0
        self._show()

    def _show(self) -> None:
        self.setText(translate("shell", "Warnings {n}").format(n=self._count))


class MotionBar(QToolBar):
    """The header; it can neither be moved nor hidden.

    Signals
    -------
    events_asked() : the log is wanted.
    machine_changed() : another machine is driven from now on.
    """

    events_asked = Signal()
    machine_changed = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(translate("shell", "Motion"))
        self.setObjectName("motion")
        self.setMovable(False)
        self.toggleViewAction().setVisible(False)  # the stop button is always in sight
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self.badge, self.state = MachineBadge(workbench), StateView(workbench)
        self.phase, self.doing, self.help = self.state.phase, self.state.doing, self.state.help
        self.owner, self.model = OwnerChip(), ModelChip(workbench)
        self.recording, self.events = RecordingSign(workbench), EventsChip(workbench)
        self.events.clicked.connect(self.events_asked)
        self.emergency, self.stop = EmergencyButton(workbench), StopButton(workbench)
        chips = (self.owner, self.model, self.recording, self.events)
        # The state names who moves as well, and the panel of events lists what is counted.
        droppable = (self.owner, self.events, self.model, self.recording)
        stops = self.emergency, self.stop
        self.row = HeaderRow(self.badge, self.state, chips, droppable, stops)
        self.row.reason_shown.connect(self.state.show_reason)
        self.recording.running.connect(lambda on: self.row.fill(self.recording, full=on))
        self.recording.refresh()
        self.addWidget(self.row)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        self.state.refresh(state)
        reason = self.doing.text() if self.doing.isHidden() else ""
        tip = plain_tip(reason) if reason else ""
        if tip != self.state.toolTip():
            self.state.setToolTip(tip)
        self.emergency.refresh(state)
        self.owner.refresh(state)
        self.model.refresh(state)
        if self.badge.refresh(state):
            self.machine_changed.emit()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Keep the row at the edges: Qt's own margins come back with each style sheet."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.StyleChange:
            self.layout().setContentsMargins(0, 0, 0, 0)
