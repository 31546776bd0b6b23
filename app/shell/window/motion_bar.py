"""The header: the machine, its state with a button that offers a remedy, chips, stop buttons."""

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

from rotemina.app.language import format_duration, format_file_size, translate, translate_message
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.window.header_row import HeaderRow
from rotemina.app.shell.window.helping_button import RemedyButton
from rotemina.app.shell.window.machine_badge import MachineBadge
from rotemina.app.shell.window.model_chip import ModelChip
from rotemina.app.shell.window.stop_controls import EmergencyButton, StopButton
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.text import ElidedLabel
from rotemina.app.workbench import (
    Level,
    PhaseLabel,
    StateTone,
    Workbench,
    capitalise,
    describe_movers,
    set_tone,
)


class StateView(QWidget):
    """View of the state in a word, with its reason and a button that offers a remedy."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.phase, self.reason_label = PhaseLabel(), ElidedLabel()
        self.reason_label.setProperty("quiet", True)
        self.remedy_button = RemedyButton(workbench)
        texts = QVBoxLayout()
        texts.setSpacing(2)
        texts.addWidget(self.phase, 0, Qt.AlignmentFlag.AlignLeft)
        texts.addWidget(self.reason_label)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addLayout(texts, 1)
        row.addWidget(self.remedy_button)

    def show_reason(self, visible: bool) -> None:
        """Show or hide the line below the state."""
        self.reason_label.setVisible(visible)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        display = self._workbench.describe(state)
        self.phase.show_phase(display.headword, display.tone)
        self.reason_label.show_text(display.reason)
        self.remedy_button.show_remedy(display.remedy)


class OwnerChip(QLabel):
    """Chip that shows who moves axes: operator, joystick, playback …; grey if nobody does."""

    def __init__(self) -> None:
        super().__init__()
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setAccessibleName(translate("shell", "Who moves the machine"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self._shown_owners = ""
        self._show("", "")

    def refresh(self, state: SessionState) -> None:
        """Show who moves axes."""
        owners = " + ".join(dict.fromkeys(map(translate_message, state.owners.values())))
        if owners != self._shown_owners:
            self._show(owners, describe_movers(state))

    def _show(self, owners: str, movers: str) -> None:
        self._shown_owners = owners
        self.setText(capitalise(owners) if owners else translate("shell", "No one is driving"))
        set_tone(self, StateTone.BUSY if owners else StateTone.QUIET)
        self.setToolTip(
            make_tooltip(
                translate("shell", "Who moves the machine: each moving axis has one owner"),
                movers or translate("shell", "Nobody at present."),
            )
        )


class RecordingChip(QLabel):
    """Chip with the duration and size of the recording, or a failure of the disk.

    Signals
    -------
    running(bool) : whether a recording is running.
    """

    running = Signal(bool)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._operation = workbench.operation
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setAccessibleName(translate("shell", "Recording"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self, StateTone.BUSY)
        workbench.refreshed.connect(lambda _: self.refresh())

    def refresh(self) -> None:
        """Show the state of the recording."""
        recorder = self._operation.recording
        self.running.emit(recorder is not None)
        if recorder is None:
            return
        writer = recorder.writer
        if writer.failure is not None:
            set_tone(self, StateTone.DANGER)
            self.setText(translate("shell", "● Not recording: disk"))
            self.setToolTip(make_tooltip(f"{writer.path}: {writer.failure}"))
            return
        set_tone(self, StateTone.BUSY)
        elapsed_s = self._operation.clock() - writer.began_s
        self.setText(
            translate("shell", "● {time}  {size}").format(
                time=format_duration(elapsed_s), size=format_file_size(writer.bytes_written)
            )
        )
        self.setToolTip(
            make_tooltip(
                translate("shell", "Time and size of the running recording"), str(writer.path)
            )
        )


class WarningsChip(QToolButton):
    """Chip that counts the warnings and errors since the log was last opened."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        # The style sheet draws it like the model chip.
        self.setObjectName("model")
        self.setToolTip(
            make_tooltip(
                translate("shell", "Warnings and errors since the log was opened (Ctrl+L)")
            )
        )
        self._count = 0
        workbench.notice_posted.connect(self._count_notice)
        self.clicked.connect(self._reset_count)
        self._show()

    def _count_notice(self, level: Level, _text: str) -> None:
        if level in (Level.WARNING, Level.ERROR):
            self._count += 1
            self._show()

    def _reset_count(self) -> None:
        self._count = 0
        self._show()

    def _show(self) -> None:
        self.setText(translate("shell", "Warnings {n}").format(n=self._count))


class MotionBar(QToolBar):
    """The header; it can be neither moved nor hidden.

    Signals
    -------
    log_requested() : the user asked to see the log.
    machine_changed() : the window now controls a different machine.
    """

    log_requested = Signal()
    machine_changed = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(translate("shell", "Motion"))
        self.setObjectName("motion")
        self.setMovable(False)
        # The stop button must always be visible.
        self.toggleViewAction().setVisible(False)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self.badge, self.state = MachineBadge(workbench), StateView(workbench)
        self.phase, self.reason_label, self.remedy_button = (
            self.state.phase,
            self.state.reason_label,
            self.state.remedy_button,
        )
        self.owner, self.model = OwnerChip(), ModelChip(workbench)
        self.recording, self.events = RecordingChip(workbench), WarningsChip(workbench)
        self.events.clicked.connect(self.log_requested)
        self.emergency, self.stop = EmergencyButton(workbench), StopButton(workbench)
        chips = (self.owner, self.model, self.recording, self.events)
        # The chips that are hidden first come first. The owner and the warnings lead, because the
        # state also names the owner, and the panel Events lists the warnings.
        hiding_order = (self.owner, self.events, self.model, self.recording)
        stops = self.emergency, self.stop
        self.row = HeaderRow(self.badge, self.state, chips, hiding_order, stops)
        self.row.reason_visibility_changed.connect(self.state.show_reason)
        self.recording.running.connect(
            lambda is_running: self.row.set_chip_wanted(self.recording, wanted=is_running)
        )
        self.recording.refresh()
        self.addWidget(self.row)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        self.state.refresh(state)
        reason = self.reason_label.text() if self.reason_label.isHidden() else ""
        tooltip = make_tooltip(reason) if reason else ""
        if tooltip != self.state.toolTip():
            self.state.setToolTip(tooltip)
        self.emergency.refresh(state)
        self.owner.refresh(state)
        self.model.refresh(state)
        has_machine_changed = self.badge.refresh(state)
        if has_machine_changed:
            self.machine_changed.emit()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Remove the margins, which Qt restores with each new style sheet."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.StyleChange:
            self.layout().setContentsMargins(0, 0, 0, 0)
