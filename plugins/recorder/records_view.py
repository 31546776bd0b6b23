"""View of the library: open a record, export a section, make a trajectory, delete."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QLineEdit, QMenu, QToolButton, QWidget

from rotemina.app.errors import RecordingError
from rotemina.app.language import describe_error, format_file_size, translate
from rotemina.app.motion.recording import RECORDING_SUFFIX, Recording, exporting
from rotemina.app.records import LibraryEntry, RecordKind
from rotemina.app.shell.records import (
    NAME_COLUMN,
    NOTE_COLUMN,
    RUN_REPORT_LABEL,
    RecordTable,
    ask_file,
    ask_run_report,
    ask_save_path,
    describe_file_problem,
)
from rotemina.app.widgets.controls import ChangingButton, enable_unless, make_button
from rotemina.app.widgets.layout import InlineQuestion, make_column, make_row
from rotemina.app.widgets.style import OnStyleChange
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.recorder import mark, tr
from rotemina.plugins.recorder.words import SECTION_END, SECTION_START, parse_section
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_fixed
from rotemina.sim.records import Record

_NONE_SELECTED_TEXT = mark("choose one record in the table")
_ALREADY_RECORD_TEXT = mark("it is already a record; only recordings can be exported")


class RecordsView(QWidget):
    """Table of the records, with actions for the selected one.

    The widget ``unfinished`` is placed above the table. The panel lays out the widget ``filter``.

    Signals
    -------
    refresh_requested() : the operator wants the folders to be searched again.
    """

    refresh_requested = Signal()

    def __init__(self, workbench: Workbench, unfinished: QWidget) -> None:
        super().__init__()
        self._workbench = workbench
        self.table = RecordTable(workbench, multiple=True)
        self.filter = self.table.make_filter_row()
        self.table.selection_changed.connect(self._update_buttons)
        self.table.opened.connect(self._open_entry)
        self.table.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.question = InlineQuestion()
        self._make_buttons()
        self._lay_out(unfinished)
        self._update_buttons()
        workbench.replaying.changed.connect(self._update_buttons)

    @property
    def selected_entry(self) -> LibraryEntry | None:
        """The selected record, or None unless exactly one is selected."""
        selected = self.table.selected_entries
        return selected[0] if len(selected) == 1 else None

    def export_section(self, entry: LibraryEntry, target: Path) -> None:
        """Write the typed section of a recording as an ASCII record."""
        section = self._read_section(entry)
        if section is None:
            return

        def work() -> int:
            if target.exists() and target.samefile(entry.path):
                raise RecordingError(
                    tr("{target}: it is the recording itself; name another file").format(
                        target=target
                    )
                )
            recording = Recording.open(entry.path)
            begin_s, end_s = (recording.began_s + time_s for time_s in section)
            return exporting.export_record(recording, target, begin_s, end_s)

        def on_exported(rows: int) -> None:
            self._workbench.notify(
                Level.GOOD, tr("Exported {target}: {rows} rows").format(target=target, rows=rows)
            )

        activity = tr("Exporting {name} …").format(name=target.name)
        self._workbench.work(f"export {target}", activity, work, on_exported)

    def make_trajectory(self, entry: LibraryEntry) -> None:
        """Use the commands of a playback, or of the typed section, as the trajectory."""
        if entry.path.suffix != RECORDING_SUFFIX:
            self._workbench.load_entry(entry)
            return
        section = self._read_section(entry)
        if section is None:
            return
        robot, period_s = self._workbench.robot, self._workbench.session.setpoint_period_s

        def work() -> Record:
            recording = Recording.open(entry.path)
            begin_s, end_s = (recording.began_s + time_s for time_s in section)
            return exporting.make_trajectory(recording, begin_s, end_s, period_s, robot).commands

        def use_commands(commands: Record) -> None:
            self._workbench.plan_trajectory(tr("{stem} again").format(stem=entry.name), commands)

        activity = tr("Reading the commands of {name} …").format(name=entry.name)
        self._workbench.work("recorded trajectory", activity, work, use_commands)

    def _make_buttons(self) -> None:
        # No space is reserved for "Compare", because the fields of the section are then hidden.
        self.open = ChangingButton(tr("Replay"), run=lambda: self._with_selected(self._open_entry))
        self.export_button = make_button(tr("Export …"), self._ask_export_path)
        self.trajectory_button = make_button(
            tr("To trajectory"), lambda: self._with_selected(self.make_trajectory)
        )
        self.begin, self.end = _make_field(SECTION_START), _make_field(SECTION_END)
        self.begin_here = make_button(tr("▏Here"), lambda: self._use_replay_time(self.begin))
        self.end_here = make_button(tr("Here▕"), lambda: self._use_replay_time(self.end))
        self.more = QToolButton()
        self.more.setText(tr("More"))
        self.more.setToolTip(tr("Run report, change name or note, find or open a file, delete"))
        self.more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        # The tooltips say why an entry is disabled.
        menu.setToolTipsVisible(True)
        self.report = menu.addAction(translate("shell", RUN_REPORT_LABEL))
        menu.addSeparator()
        self.rename = menu.addAction(tr("Change name"))
        self.annotate = menu.addAction(tr("Change note"))
        self.find = menu.addAction(tr("Find file …"))
        menu.addSeparator()
        self.replay_other = menu.addAction(tr("Replay other file …"))
        self.refresh_action = menu.addAction(tr("Refresh"))
        menu.addSeparator()
        self.delete = menu.addAction(tr("Delete …"))
        self.report.triggered.connect(
            lambda: self._with_selected(lambda entry: ask_run_report(self, self._workbench, entry))
        )
        self.rename.triggered.connect(lambda: self.table.edit_cell(NAME_COLUMN))
        self.annotate.triggered.connect(lambda: self.table.edit_cell(NOTE_COLUMN))
        self.find.triggered.connect(self._ask_new_location)
        self.replay_other.triggered.connect(self._ask_replay_file)
        self.refresh_action.triggered.connect(self.refresh_requested.emit)
        self.delete.triggered.connect(self._ask_delete)
        self.more.setMenu(menu)
        self.table.customContextMenuRequested.connect(
            lambda position: menu.popup(self.table.viewport().mapToGlobal(position))
        )

    def _lay_out(self, unfinished: QWidget) -> None:
        self.section_fields = QWidget()
        # All of these fit next to a wide control dock.
        make_row(
            QLabel(tr("From")),
            self.begin,
            self.begin_here,
            QLabel(tr("to")),
            self.end,
            QLabel("s"),
            self.end_here,
            on=self.section_fields,
            margins=0,
            spacing=4,
        )
        buttons = self.open, self.export_button, self.trajectory_button, self.more
        bottom_row = make_row(self.section_fields, 1, *buttons, spacing=4)
        make_column(
            unfinished, self.question, (self.table, 1), bottom_row, on=self, margins=0, spacing=4
        )

    def _update_buttons(self) -> None:
        entry, selected = self.selected_entry, self.table.selected_entries
        use_objection = tr(_NONE_SELECTED_TEXT) if entry is None else None
        if entry is not None and not entry.is_usable:
            use_objection = describe_file_problem(entry)
        is_recording = entry is None or entry.path.suffix == RECORDING_SUFFIX
        # A section can be chosen only in a recording. A playback is used as a whole.
        self.section_fields.setVisible(is_recording)
        self.open.show_meaning(tr("Replay") if is_recording else tr("Compare"))
        tooltip = (
            tr("Display the recording instead of the machine")
            if is_recording
            else tr("Compare the record with the model in use")
        )
        enable_unless(self.open, use_objection, tooltip)
        export_objection = use_objection or (None if is_recording else tr(_ALREADY_RECORD_TEXT))
        tooltip = tr("Export the section as an ASCII record for comparison and diagnosis")
        enable_unless(self.export_button, export_objection, tooltip)
        tooltip = tr(
            "Use the commands of the section as a trajectory; every axis must be at "
            "rest at both ends"
        )
        enable_unless(self.trajectory_button, use_objection, tooltip)
        enable_unless(self.report, use_objection, "")
        replay_objection = (
            None
            if self._find_replay_time_s() is not None
            else tr("this recording is not displayed")
        )
        enable_unless(
            self.begin_here,
            replay_objection,
            tr("Start the section at the present time of the replay"),
        )
        enable_unless(
            self.end_here, replay_objection, tr("End the section at the present time of the replay")
        )
        selection_objection = None if entry is not None else tr(_NONE_SELECTED_TEXT)
        enable_unless(self.rename, selection_objection, "")
        enable_unless(self.annotate, selection_objection, "")
        moved_objection = None if entry is None or entry.missing else tr("its file has not moved")
        enable_unless(self.find, selection_objection or moved_objection, "")
        enable_unless(self.delete, None if selected else tr(_NONE_SELECTED_TEXT), "")

    def _find_replay_time_s(self) -> float | None:
        """Return the replay time of the selected recording, or None if it is not displayed."""
        paced, entry = self._workbench.replaying.paced, self.selected_entry
        if paced is None or entry is None or paced.replay.recording.path != entry.path:
            return None
        return paced.position_s

    def _use_replay_time(self, field: QLineEdit) -> None:
        time_s = self._find_replay_time_s()
        if time_s is not None:
            field.setText(format_fixed(time_s, 3))

    def _read_section(self, entry: LibraryEntry) -> tuple[float, float] | None:
        try:
            return parse_section(self.begin.text(), self.end.text(), entry.duration_s or 0.0)
        except InputError as error:
            self._workbench.notify(Level.WARNING, describe_error(error), about=error)
            return None

    def _with_selected(self, action: Callable[[LibraryEntry], None]) -> None:
        entry = self.selected_entry
        if entry is not None and entry.is_usable:
            action(entry)

    def _open_entry(self, entry: LibraryEntry) -> None:
        if not entry.is_usable:
            self._workbench.notify(
                Level.WARNING, f"{entry.name}: {describe_file_problem(entry)}", about=self
            )
        elif entry.path.suffix == RECORDING_SUFFIX:
            self._workbench.open_replay(entry.path)
        else:
            self._workbench.open_entry(entry)

    def _ask_export_path(self) -> None:
        def ask(entry: LibraryEntry) -> None:
            title, file_filter = tr("Export a record"), tr("Records (*.csv *.csv.gz)")
            name = f"{entry.path.stem}.csv"
            ask_save_path(
                self.window(),
                self._workbench,
                title,
                file_filter,
                name,
                lambda target: self.export_section(entry, target),
            )

        self._with_selected(ask)

    def _ask_replay_file(self) -> None:
        file_filter = tr("Recordings (*{suffix});;All files (*)").format(suffix=RECORDING_SUFFIX)
        ask_file(
            self.window(), self._workbench, tr("Replay"), file_filter, self._workbench.open_replay
        )

    def _ask_new_location(self) -> None:
        entry = self.selected_entry
        if entry is not None:
            title = tr("Where is {name}?").format(name=entry.path.name)
            file_filter = f"*{entry.path.suffix} (*{entry.path.suffix})"
            library = self._workbench.library
            ask_file(
                self.window(),
                self._workbench,
                title,
                file_filter,
                lambda path: library.set_path(entry, path),
            )

    def _ask_delete(self) -> None:
        """Ask whether to delete. Of files in other folders, only the entries are removed."""
        entries = self.table.selected_entries
        if not entries:
            return
        deletable_entries = [
            entry for entry in entries if entry.kind is not RecordKind.FILE and not entry.missing
        ]
        names = ", ".join(f'"{entry.name}"' for entry in entries[:3])
        if len(entries) > 3:
            names = tr("{names} and {n} more").format(names=names, n=len(entries) - 3)
        text = tr(
            "Delete {names}? This permanently deletes {size} from the disk. Files in "
            "other folders stay; only their entries are removed."
        ).format(names=names, size=format_file_size(sum(entry.size for entry in deletable_entries)))
        delete = self._workbench.library.delete
        self.question.ask(text, tr("Delete"), lambda: delete(entries))


def _fit_width(field: QLineEdit, text: str) -> None:
    text_width = field.fontMetrics().horizontalAdvance(text)
    # Space for the frame and the cursor is added.
    field.setFixedWidth(max(60, text_width + 28))


def _make_field(end_marker: str) -> QLineEdit:
    field = QLineEdit()
    name = tr(end_marker)
    field.setPlaceholderText(name)
    OnStyleChange(field, lambda: _fit_width(field, name))
    field.setAccessibleName(
        tr("{end} of the section in seconds").format(end=name[:1].upper() + name[1:])
    )
    field.setToolTip(
        tr("Seconds from the start of the recording; empty: its {end}").format(end=name)
    )
    return field
