"""Controls of the running recording: start, end, state and remarks."""

import time
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QLabel, QLineEdit, QPushButton, QWidget

from rotemina.app.language import format_duration, format_file_size
from rotemina.app.motion.recording import UNFINISHED_SUFFIX
from rotemina.app.motion.state import MAX_LABEL_LENGTH, RunLabels
from rotemina.app.widgets.controls import ChangingButton, enable_unless, name_widget
from rotemina.app.widgets.layout import (
    make_column,
    make_grid,
    make_row,
)
from rotemina.app.widgets.text import ElidedLabel, make_plain_label
from rotemina.app.workbench import BackgroundWorker, Level, Workbench, measure_free_bytes
from rotemina.plugins.recorder import tr

AT_START_SETTING = "recorder.at_start"
_SPACE_CHECK_PERIOD_S = 5.0
# Settings of the window layout are not recorded, because they say nothing about a session.
_WINDOW_LAYOUT_PREFIX = "window."
# Ending a recording needs free disk space equal to its size, plus this reserve.
_MIN_SPARE_BYTES = 500_000_000
# Before this time, the data rate of a recording is not representative.
_MIN_TIME_FOR_RATE_S = 5.0


def format_free_space(free: int | None, written: int, elapsed_s: float) -> str:
    """Return the free disk space as text, and for how long it will last."""
    if free is None:
        return tr("unknown")
    if elapsed_s < _MIN_TIME_FOR_RATE_S or written <= 0:
        return format_file_size(free)
    # Ending the recording writes all data a second time.
    remaining_s = max(free - written, 0) / (2.0 * written / elapsed_s)
    hours = remaining_s / 3600.0
    remaining_text = (
        tr("{n:.0f} days").format(n=hours / 24.0)
        if hours > 72.0
        else tr("{hours:.1f} h").format(hours=hours)
    )
    return tr("{size}, for {left}").format(size=format_file_size(free), left=remaining_text)


def find_space_warning(free: int | None, written: int) -> str | None:
    """Return a warning with a remedy if the disk space is too small, or None."""
    if free is None or free > written + _MIN_SPARE_BYTES:
        return None
    return tr(
        "Only {free} are free, but ending the recording needs {size}. Free disk "
        "space; the motion continues in any case."
    ).format(free=format_file_size(free), size=format_file_size(written))


class RunLabelFields(QWidget):
    """Fields for run, operator and sample.

    A text is used when Enter is pressed or the field is left.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._library = workbench.library
        self.run, self.operator, self.sample = QLineEdit(), QLineEdit(), QLineEdit()
        fields_by_name = {
            tr("Run"): self.run,
            tr("Operator"): self.operator,
            tr("Sample"): self.sample,
        }
        grid = make_grid(on=self, margins=0, spacing=(10, 2))
        for row, (name, field) in enumerate(fields_by_name.items()):
            title = QLabel(name)
            title.setProperty("quiet", True)
            title.setBuddy(field)
            field.setAccessibleName(name)
            field.setMaxLength(MAX_LABEL_LENGTH)
            field.setToolTip(tr("Stored with every playback and recording from now on"))
            field.editingFinished.connect(self._use_labels)
            grid.addWidget(title, row, 0)
            grid.addWidget(field, row, 1)
        self._library.labels_changed.connect(self._show_labels)
        self._show_labels()

    def _use_labels(self) -> None:
        texts = (field.text() for field in (self.run, self.operator, self.sample))
        self._library.use_labels(RunLabels.from_text(*texts))

    def _show_labels(self) -> None:
        labels = self._library.labels
        self.run.setText(labels.run)
        self.operator.setText(labels.operator)
        self.sample.setText(labels.sample)


class RecordingSection(QWidget):
    """Section with record button, elapsed time, file, size, free space and remarks.

    Signals
    -------
    changed() : a recording has started or ended, or an attempt to do so has failed.
    """

    changed = Signal()

    def __init__(self, workbench: Workbench, background: BackgroundWorker) -> None:
        super().__init__()
        self._workbench, self._background = workbench, background
        self._operation = workbench.operation
        self._activity_text = ""
        self._part_path: Path | None = None
        self._free_bytes: int | None = None
        self._last_space_check_s: float | None = None
        self._is_checking_space = False
        self._is_start_pending = workbench.settings.get(AT_START_SETTING, False)
        self._make_widgets()
        self._lay_out()

    def _make_widgets(self) -> None:
        self.record = ChangingButton(
            tr("● Record"), tr("■ End recording"), tr("Starting …"), run=self.toggle
        )
        self.record.setMinimumHeight(32)
        self.elapsed_label = name_widget(QLabel("–"), tr("Time since the recording began"))
        self.elapsed_label.setProperty("readout", True)
        self.file_label, self.size, self.free_label = ElidedLabel(), ElidedLabel(), ElidedLabel()
        self.complaint = make_plain_label(quiet=False, wrap=True)
        self.complaint.setProperty("bad", True)
        self.complaint.hide()
        self.labels = RunLabelFields(self._workbench)
        self.note_field = QLineEdit()
        self.note_field.setPlaceholderText(tr("remark"))
        self.note_field.setAccessibleName(tr("Remark for the recording"))
        self.note_field.setToolTip(
            tr("Enter writes the remark into the recording with the present time")
        )
        # Enabled as soon as a recording runs.
        self.note_field.setEnabled(False)
        self.note_field.returnPressed.connect(self.write_remark)
        self.note_field.textEdited.connect(lambda _: self.refresh())
        self.note_button = QPushButton(tr("Note"))
        self.note_button.setToolTip(tr("Write the remark into the recording"))
        self.note_button.clicked.connect(self.write_remark)
        self.at_start = QCheckBox(tr("Record from program start"))
        self.at_start.setToolTip(tr("Start a recording whenever the program starts"))
        with QSignalBlocker(self.at_start):
            self.at_start.setChecked(self._is_start_pending)
        self.at_start.toggled.connect(lambda on: self._workbench.settings.set(AT_START_SETTING, on))
        self.folder = QLineEdit(str(self._operation.recordings))
        self.folder.setReadOnly(True)
        self.folder.setCursorPosition(0)
        self.folder.setAccessibleName(tr("Folder of recordings"))
        self.folder.setToolTip(tr("Folder of the recordings; select the text to copy it"))

    def _lay_out(self) -> None:
        top = make_row((self.record, 1), self.elapsed_label)
        file_grid = make_grid(spacing=(10, 2), stretched=1)
        values_by_name = {
            tr("File"): self.file_label,
            tr("Size"): self.size,
            tr("Free"): self.free_label,
        }
        for row, (name, value) in enumerate(values_by_name.items()):
            title = QLabel(name)
            title.setProperty("quiet", True)
            value.setAccessibleName(tr("Recording: {what}").format(what=name.lower()))
            file_grid.addWidget(title, row, 0)
            file_grid.addWidget(value, row, 1)
        remark = make_row((self.note_field, 1), self.note_button)
        parts = top, self.complaint, remark, self.labels, file_grid, self.at_start, self.folder, 1
        make_column(*parts, on=self, margins=(0, 0, 8, 0), spacing=5)

    @property
    def busy(self) -> bool:
        """Whether a recording is just being started or ended."""
        return bool(self._activity_text)

    @property
    def own_paths(self) -> frozenset[Path]:
        """The files into which this program is recording."""
        return frozenset() if self._part_path is None else frozenset({self._part_path})

    def toggle(self) -> None:
        """Start a recording, or end the running one."""
        if self._activity_text:
            text = tr("The recording is just being started or ended; wait, then press again.")
            self._workbench.notify(Level.INFO, text, about=self)
        elif self._operation.recording is None:
            self._start_recording()
        else:
            self._end_recording()

    def write_remark(self) -> None:
        """Write the typed remark into the recording."""
        recorder, text = self._operation.recording, self.note_field.text().strip()
        if recorder is None or not text:
            reason = tr("type a remark first") if recorder else tr("nothing is being recorded")
            notice = tr("Nothing was noted: {why}.").format(why=reason)
            self._workbench.notify(Level.INFO, notice, about=self)
            return
        recorder.record_note(text)
        self.note_field.clear()

    def refresh(self) -> None:
        """Show the state of the recording. If so configured, start one after the program start."""
        if self._is_start_pending:
            self._is_start_pending = False
            if self._operation.recording is None:
                self._start_recording()
        self._check_space()
        recorder = self._operation.recording
        is_recording = recorder is not None and not self._activity_text
        label = tr("■ End recording") if is_recording else tr("● Record")
        self.record.show_meaning(self._activity_text or label)
        tooltip = (
            tr("End the recording and save it in one file")
            if is_recording
            else tr("Record all signals and events from now on")
        )
        enable_unless(
            self.record,
            tr("wait until the running task has finished") if self._activity_text else None,
            tooltip,
        )
        recording_objection = None if is_recording else tr("nothing is being recorded")
        enable_unless(
            self.note_field,
            recording_objection,
            tr("Enter writes the remark into the recording with the present time"),
        )
        text_objection = None if self.note_field.text().strip() else tr("type a remark first")
        tooltip = tr("Write the remark into the recording with the present time")
        enable_unless(self.note_button, recording_objection or text_objection, tooltip)
        if recorder is None:
            self._show_values("–", "–", "–", format_free_space(self._free_bytes, 0, 0.0), None)
            return
        writer = recorder.writer
        self._part_path = writer.path.with_name(f"{writer.path.name}{UNFINISHED_SUFFIX}")
        elapsed_s, written = self._operation.clock() - writer.began_s, writer.bytes_written
        failure = writer.failure
        self._show_values(
            format_duration(elapsed_s),
            writer.path.name,
            format_file_size(written),
            format_free_space(self._free_bytes, written, elapsed_s),
            find_space_warning(self._free_bytes, written)
            if failure is None
            else tr(
                "The recording has failed: {failure}. Free disk space; the motion continues."
            ).format(failure=failure),
        )

    def _start_recording(self) -> None:
        self._activity_text = tr("Starting …")
        settings = self._workbench.settings.values
        recorded_settings = {
            key: value
            for key, value in settings.items()
            if not key.startswith(_WINDOW_LAYOUT_PREFIX)
        }
        self._workbench.work(
            "recording",
            tr("Starting the recording …"),
            lambda: self._operation.start_recording(recorded_settings),
            lambda _: self._on_finished(),
            self._on_finished,
        )

    def _end_recording(self) -> None:
        recorder = self._operation.recording
        if recorder is None:
            text = tr("The recording has ended already.")
            self._workbench.notify(Level.INFO, text, about=self)
            return
        self._activity_text = tr("Ending …")
        size = format_file_size(recorder.writer.bytes_written)
        self._workbench.work(
            "recording",
            tr("Ending the recording: {size} are being merged …").format(size=size),
            self._operation.stop_recording,
            self._on_saved,
            self._on_finished,
        )

    def _on_saved(self, path: Path) -> None:
        self._workbench.notify(Level.GOOD, tr("Saved the recording {path}").format(path=path))
        self._on_finished()

    def _on_finished(self) -> None:
        self._activity_text, self._part_path, self._last_space_check_s = "", None, None
        self.refresh()
        self.changed.emit()

    def _show_values(
        self, elapsed: str, file: str, size: str, free_space: str, complaint: str | None
    ) -> None:
        if elapsed != self.elapsed_label.text():
            self.elapsed_label.setText(elapsed)
        self.file_label.show_text(file)
        self.size.show_text(size)
        self.free_label.show_text(free_space)
        self.complaint.setText(complaint or "")
        self.complaint.setVisible(complaint is not None)

    def _check_space(self) -> None:
        """Check the free space from time to time, in the background because a disk may hang."""
        now_s = time.monotonic()
        is_due = (
            self._last_space_check_s is None
            or now_s - self._last_space_check_s > _SPACE_CHECK_PERIOD_S
        )
        if self._is_checking_space or not is_due or not self.isVisible():
            return
        self._is_checking_space, self._last_space_check_s = True, now_s
        folder = self._operation.recordings
        self._background.run(
            "room",
            lambda: measure_free_bytes(folder),
            self._on_space_checked,
            lambda _: self._on_space_checked(None),
        )

    def _on_space_checked(self, free: int | None) -> None:
        self._is_checking_space, self._free_bytes = False, free
