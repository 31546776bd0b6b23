"""The running recording: start, end, state, remarks."""

import time
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QLabel, QLineEdit, QPushButton, QWidget

from rotemina.app.display_units import duration_text, size_text
from rotemina.app.motion.recording.recovery import UNFINISHED
from rotemina.app.motion.run_labels import MOST_LETTERS, RunLabels
from rotemina.app.shell.background import Background
from rotemina.app.shell.record_library import free_bytes
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import allow, named
from rotemina.app.widgets.labels import ElidedLabel, plain_text
from rotemina.app.widgets.layouts import in_column, in_grid, in_row
from rotemina.plugins.recorder import tr

AT_START = "recorder.at_start"
_LOOK_S = 5.0  # between looks at how much room there is
_SCREEN = "window."  # preferences of the screen tell nothing about a session


# Ending a recording takes as much room again as it has used.
_SPARE_BYTES = 500_000_000
_STEADY_S = 5.0  # of a recording, from which on its rate says something


def room_text(free: int | None, written: int, since_s: float) -> str:
    """Return how much room is left, and for how long it lasts."""
    if free is None:
        return tr("unknown")
    if since_s < _STEADY_S or written <= 0:
        return size_text(free)
    lasts_s = max(free - written, 0) / (2.0 * written / since_s)
    hours = lasts_s / 3600.0
    left = (
        tr("{n:.0f} days").format(n=hours / 24.0)
        if hours > 72.0
        else tr("{hours:.1f} h").format(hours=hours)
    )
    return tr("{size}, for {left}").format(size=size_text(free), left=left)


def scarce(free: int | None, written: int) -> str | None:
    """Return the remedy for too little disk space, or None."""
    if free is None or free > written + _SPARE_BYTES:
        return None
    return tr(
        "Only {free} are free, but ending the recording needs {size}. Free disk "
        "space; the motion continues in any case."
    ).format(free=size_text(free), size=size_text(written))


class LabelFields(QWidget):
    """Three fields, one below the other; what is typed counts from Enter or the next field on."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._library = workbench.library
        self.run, self.operator, self.sample = QLineEdit(), QLineEdit(), QLineEdit()
        named = {tr("Run"): self.run, tr("Operator"): self.operator, tr("Sample"): self.sample}
        grid = in_grid(on=self, margins=0, spacing=(10, 2))
        for row, (name, field) in enumerate(named.items()):
            title = QLabel(name)
            title.setProperty("quiet", True)
            title.setBuddy(field)
            field.setAccessibleName(name)
            field.setMaxLength(MOST_LETTERS)
            field.setToolTip(tr("Stored with every playback and recording from now on"))
            field.editingFinished.connect(self._use)
            grid.addWidget(title, row, 0)
            grid.addWidget(field, row, 1)
        self._library.labels_changed.connect(self._show)
        self._show()

    def _use(self) -> None:
        typed = (field.text() for field in (self.run, self.operator, self.sample))
        self._library.use_labels(RunLabels.typed(*typed))

    def _show(self) -> None:
        labels = self._library.labels
        self.run.setText(labels.run)
        self.operator.setText(labels.operator)
        self.sample.setText(labels.sample)


class RecordingSection(QWidget):
    """Record button, elapsed time, file, size, free room, and a field for remarks.

    Signals
    -------
    changed() : a recording has begun or ended, or could not.
    """

    changed = Signal()

    def __init__(self, workbench: Workbench, background: Background) -> None:
        super().__init__()
        self._workbench, self._background = workbench, background
        self._operation = workbench.operation
        self._doing = ""
        self._part: Path | None = None
        self._free: int | None = None
        self._looked_s: float | None = None
        self._looking = False
        self._wanted = workbench.settings.get(AT_START, False)
        self._make_widgets()
        self._lay_out()

    def _make_widgets(self) -> None:
        self.record = ChangingButton(
            tr("● Record"), tr("■ End recording"), tr("Starting …"), run=self.toggle
        )
        self.record.setMinimumHeight(32)
        self.elapsed = named(QLabel("–"), tr("Time since the recording began"))
        self.elapsed.setProperty("readout", True)
        self.file, self.size, self.room = ElidedLabel(), ElidedLabel(), ElidedLabel()
        self.complaint = plain_text(quiet=False, wrap=True)
        self.complaint.setProperty("bad", True)
        self.complaint.hide()
        self.labels = LabelFields(self._workbench)
        self.note = QLineEdit()
        self.note.setPlaceholderText(tr("remark"))
        self.note.setAccessibleName(tr("Remark for the recording"))
        self.note.setToolTip(tr("Enter writes the remark into the recording with the present time"))
        self.note.setEnabled(False)  # until something is recorded
        self.note.returnPressed.connect(self.remark)
        self.note.textEdited.connect(lambda _: self.refresh())
        self.keep = QPushButton(tr("Note"))
        self.keep.setToolTip(tr("Write the remark into the recording"))
        self.keep.clicked.connect(self.remark)
        self.at_start = QCheckBox(tr("Record from program start"))
        self.at_start.setToolTip(tr("Start a recording whenever the program starts"))
        with QSignalBlocker(self.at_start):
            self.at_start.setChecked(self._wanted)
        self.at_start.toggled.connect(lambda on: self._workbench.settings.set(AT_START, on))
        self.folder = QLineEdit(str(self._operation.recordings))
        self.folder.setReadOnly(True)
        self.folder.setCursorPosition(0)
        self.folder.setAccessibleName(tr("Folder of recordings"))
        self.folder.setToolTip(tr("Folder of the recordings; select the text to copy it"))

    def _lay_out(self) -> None:
        top = in_row((self.record, 1), self.elapsed)
        figures = in_grid(spacing=(10, 2), stretched=1)
        named = {tr("File"): self.file, tr("Size"): self.size, tr("Free"): self.room}
        for row, (name, value) in enumerate(named.items()):
            title = QLabel(name)
            title.setProperty("quiet", True)
            value.setAccessibleName(tr("Recording: {what}").format(what=name.lower()))
            figures.addWidget(title, row, 0)
            figures.addWidget(value, row, 1)
        remark = in_row((self.note, 1), self.keep)
        parts = top, self.complaint, remark, self.labels, figures, self.at_start, self.folder, 1
        in_column(*parts, on=self, margins=(0, 0, 8, 0), spacing=5)

    @property
    def busy(self) -> bool:
        """Whether a recording is just begun or ended."""
        return bool(self._doing)

    @property
    def own(self) -> frozenset[Path]:
        """What this program records into."""
        return frozenset() if self._part is None else frozenset({self._part})

    # --- what is asked for ------------------------------------------------------------------------

    def toggle(self) -> None:
        """Begin a recording, or end the one that runs."""
        if self._doing:
            text = tr("The recording is just being started or ended; wait, then press again.")
            self._workbench.notify(Level.INFO, text, about=self)
        elif self._operation.recording is None:
            self._begin()
        else:
            self._end()

    def remark(self) -> None:
        """Put what was typed into the recording."""
        recorder, text = self._operation.recording, self.note.text().strip()
        if recorder is None or not text:
            why = tr("type a remark first") if recorder else tr("nothing is being recorded")
            told = tr("Nothing was noted: {why}.").format(why=why)
            self._workbench.notify(Level.INFO, told, about=self)
            return
        recorder.note(text)
        self.note.clear()

    def refresh(self) -> None:
        """Show how the recording stands; begin it where that is wanted of every start."""
        if self._wanted:
            self._wanted = False
            if self._operation.recording is None:
                self._begin()
        self._look()
        recorder = self._operation.recording
        running = recorder is not None and not self._doing
        words = tr("■ End recording") if running else tr("● Record")
        self.record.show_meaning(self._doing or words)
        tip = (
            tr("End the recording and save it in one file")
            if running
            else tr("Record all signals and events from now on")
        )
        allow(self.record, tr("wait for the running work") if self._doing else None, tip)
        why_not = None if running else tr("nothing is being recorded")
        allow(
            self.note,
            why_not,
            tr("Enter writes the remark into the recording with the present time"),
        )
        empty = None if self.note.text().strip() else tr("type a remark first")
        tip = tr("Write the remark into the recording with the present time")
        allow(self.keep, why_not or empty, tip)
        if recorder is None:
            self._show("–", "–", "–", room_text(self._free, 0, 0.0), None)
            return
        writer = recorder.writer
        self._part = writer.path.with_name(f"{writer.path.name}{UNFINISHED}")
        since_s, written = self._operation.clock() - writer.began_s, writer.bytes_written
        failure = writer.failure
        self._show(
            duration_text(since_s),
            writer.path.name,
            size_text(written),
            room_text(self._free, written, since_s),
            scarce(self._free, written)
            if failure is None
            else tr(
                "The recording has failed: {failure}. Free disk space; the motion continues."
            ).format(failure=failure),
        )

    # --- inside -----------------------------------------------------------------------------------

    def _begin(self) -> None:
        self._doing = tr("Starting …")
        preferences = self._workbench.settings.values
        told = {key: each for key, each in preferences.items() if not key.startswith(_SCREEN)}
        self._workbench.work(
            "recording",
            tr("Starting the recording …"),
            lambda: self._operation.start_recording(told),
            lambda _: self._settle(),
            self._settle,
        )

    def _end(self) -> None:
        recorder = self._operation.recording
        if recorder is None:
            text = tr("The recording has ended already.")
            self._workbench.notify(Level.INFO, text, about=self)
            return
        self._doing = tr("Ending …")
        size = size_text(recorder.writer.bytes_written)
        self._workbench.work(
            "recording",
            tr("Ending the recording: {size} are being merged …").format(size=size),
            self._operation.stop_recording,
            self._kept,
            self._settle,
        )

    def _kept(self, path: Path) -> None:
        self._workbench.notify(Level.GOOD, tr("Saved the recording {path}").format(path=path))
        self._settle()

    def _settle(self) -> None:
        """Show how it stands once that was begun or ended."""
        self._doing, self._part, self._looked_s = "", None, None
        self.refresh()
        self.changed.emit()

    def _show(self, elapsed: str, file: str, size: str, room: str, complaint: str | None) -> None:
        if elapsed != self.elapsed.text():
            self.elapsed.setText(elapsed)
        self.file.show_text(file)
        self.size.show_text(size)
        self.room.show_text(room)
        self.complaint.setText(complaint or "")
        self.complaint.setVisible(complaint is not None)

    def _look(self) -> None:
        """Ask how much room there is, now and then and not on this thread: disks may hang."""
        now_s = time.monotonic()
        due = self._looked_s is None or now_s - self._looked_s > _LOOK_S
        if self._looking or not due or not self.isVisible():
            return
        self._looking, self._looked_s = True, now_s
        folder = self._operation.recordings
        self._background.run(
            "room", lambda: free_bytes(folder), self._take_room, lambda _: self._take_room(None)
        )

    def _take_room(self, free: int | None) -> None:
        self._looking, self._free = False, free
