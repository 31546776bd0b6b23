"""The library of records: open, export a section, make a trajectory, delete."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QLineEdit, QMenu, QToolButton, QWidget

from rotemina.app.display_units import size_text
from rotemina.app.motion.recording import exporting
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import SUFFIX
from rotemina.app.records.entry import Entry, Kind
from rotemina.app.shell.engine_words import error_text
from rotemina.app.shell.file_dialog import ask_file, ask_where
from rotemina.app.shell.language import translate
from rotemina.app.shell.record_table import RecordTable
from rotemina.app.shell.record_words import NAME, NOTE, state_text
from rotemina.app.shell.report_files import RUN_REPORT, ask_run_report
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.inline_question import Question
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.when_dressed import WhenDressed
from rotemina.plugins.recorder import mark, tr
from rotemina.plugins.recorder.words import BEGIN, END, span
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import fixed
from rotemina.sim.records.record import Record

_NONE = mark("choose one record in the table")
_NO_STRETCH = mark("it is already a record; only recordings can be exported")


class RecordsView(QWidget):
    """Table, with what was ``unfinished`` over it, and what can be done with the chosen record.

    ``filter`` stands elsewhere.

    Signals
    -------
    looked_for() : the folders are to be looked into again.
    """

    looked_for = Signal()

    def __init__(self, workbench: Workbench, unfinished: QWidget) -> None:
        super().__init__()
        self._workbench = workbench
        self.table = RecordTable(workbench, multiple=True)
        self.filter = self.table.filter_row()
        self.table.chosen_changed.connect(self._allow)
        self.table.opened.connect(self._open)
        self.table.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.question = Question()
        self._make_buttons()
        self._lay_out(unfinished)
        self._allow()
        workbench.replaying.changed.connect(self._allow)

    @property
    def chosen(self) -> Entry | None:
        """The record of the chosen row; None if there are several, or none."""
        chosen = self.table.chosen
        return chosen[0] if len(chosen) == 1 else None

    # --- what comes of one ------------------------------------------------------------------------

    def export(self, one: Entry, target: Path) -> None:
        """Write the stretch that is typed as an ASCII record."""
        stretch = self._stretch(one)
        if stretch is None:
            return

        def work() -> int:
            if target.exists() and target.samefile(one.path):
                raise RecordingError(
                    tr("{target}: it is the recording itself; name another file").format(
                        target=target
                    )
                )
            recording = Recording.open(one.path)
            begin_s, end_s = (recording.began_s + at_s for at_s in stretch)
            return exporting.export(recording, target, begin_s, end_s)

        def done(rows: int) -> None:
            self._workbench.notify(
                Level.GOOD, tr("Exported {target}: {rows} rows").format(target=target, rows=rows)
            )

        doing = tr("Exporting {name} …").format(name=target.name)
        self._workbench.work(f"export {target}", doing, work, done)

    def take_in_hand(self, one: Entry) -> None:
        """Make the commands of a playback, or of the stretch that is typed, the trajectory."""
        if one.path.suffix != SUFFIX:
            self._workbench.load_entry(one)
            return
        stretch = self._stretch(one)
        if stretch is None:
            return
        robot, period_s = self._workbench.robot, self._workbench.session.setpoint_period_s

        def work() -> Record:
            recording = Recording.open(one.path)
            begin_s, end_s = (recording.began_s + at_s for at_s in stretch)
            return exporting.trajectory(recording, begin_s, end_s, period_s, robot).commands

        def done(commands: Record) -> None:
            self._workbench.plan_trajectory(tr("{stem} again").format(stem=one.name), commands)

        doing = tr("Reading the commands of {name} …").format(name=one.name)
        self._workbench.work("recorded trajectory", doing, work, done)

    # --- parts ------------------------------------------------------------------------------------

    def _make_buttons(self) -> None:
        # Without room for "Compare", which it says while the fields of the section are hidden.
        self.open = ChangingButton(tr("Replay"), run=lambda: self._with_chosen(self._open))
        self.to_record = button(tr("Export …"), self._ask_export)
        self.to_trajectory = button(
            tr("To trajectory"), lambda: self._with_chosen(self.take_in_hand)
        )
        self.begin, self.end = _field(BEGIN), _field(END)
        self.begin_here = button(tr("▏Here"), lambda: self._here(self.begin))
        self.end_here = button(tr("Here▕"), lambda: self._here(self.end))
        self.more = QToolButton()
        self.more.setText(tr("More"))
        self.more.setToolTip(tr("Run report, change name or note, find or open a file, delete"))
        self.more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        menu.setToolTipsVisible(True)  # which say why an entry cannot be chosen
        self.report = menu.addAction(translate("shell", RUN_REPORT))
        menu.addSeparator()
        self.rename = menu.addAction(tr("Change name"))
        self.annotate = menu.addAction(tr("Change note"))
        self.find = menu.addAction(tr("Find file …"))
        menu.addSeparator()
        self.other = menu.addAction(tr("Replay other file …"))
        self.again = menu.addAction(tr("Refresh"))
        menu.addSeparator()
        self.delete = menu.addAction(tr("Delete …"))
        self.report.triggered.connect(
            lambda: self._with_chosen(lambda one: ask_run_report(self, self._workbench, one))
        )
        self.rename.triggered.connect(lambda: self.table.rename(NAME))
        self.annotate.triggered.connect(lambda: self.table.rename(NOTE))
        self.find.triggered.connect(self._ask_where_it_is)
        self.other.triggered.connect(self._ask_other)
        self.again.triggered.connect(self.looked_for.emit)
        self.delete.triggered.connect(self._ask_delete)
        self.more.setMenu(menu)
        self.table.customContextMenuRequested.connect(
            lambda at: menu.popup(self.table.viewport().mapToGlobal(at))
        )

    def _lay_out(self, unfinished: QWidget) -> None:
        self.stretch = QWidget()
        # All of them fit beside the control dock, where that is wide.
        in_row(
            QLabel(tr("From")),
            self.begin,
            self.begin_here,
            QLabel(tr("to")),
            self.end,
            QLabel("s"),
            self.end_here,
            on=self.stretch,
            margins=0,
            spacing=4,
        )
        buttons = self.open, self.to_record, self.to_trajectory, self.more
        below = in_row(self.stretch, 1, *buttons, spacing=4)
        in_column(unfinished, self.question, (self.table, 1), below, on=self, margins=0, spacing=4)

    def _allow(self) -> None:
        chosen, several = self.chosen, self.table.chosen
        why_not = tr(_NONE) if chosen is None else None
        if chosen is not None and not chosen.usable:
            why_not = state_text(chosen)
        replayed = chosen is None or chosen.path.suffix == SUFFIX
        self.stretch.setVisible(replayed)  # a playback is taken as a whole
        self.open.show_meaning(tr("Replay") if replayed else tr("Compare"))
        tip = (
            tr("Display the recording instead of the machine")
            if replayed
            else tr("Compare the record with the model in use")
        )
        allow(self.open, why_not, tip)
        whole = why_not or (None if replayed else tr(_NO_STRETCH))
        tip = tr("Export the section as an ASCII record for comparison and diagnosis")
        allow(self.to_record, whole, tip)
        tip = tr(
            "Use the commands of the section as a trajectory; every axis must be at "
            "rest at both ends"
        )
        allow(self.to_trajectory, why_not, tip)
        allow(self.report, why_not, "")
        here = None if self._shown_s() is not None else tr("this recording is not displayed")
        allow(self.begin_here, here, tr("Start the section at the present time of the replay"))
        allow(self.end_here, here, tr("End the section at the present time of the replay"))
        none = None if chosen is not None else tr(_NONE)
        allow(self.rename, none, "")
        allow(self.annotate, none, "")
        there = None if chosen is None or chosen.missing else tr("its file is where it was")
        allow(self.find, none or there, "")
        allow(self.delete, None if several else tr(_NONE), "")

    def _shown_s(self) -> float | None:
        """Return where the replay of the chosen recording is."""
        paced, chosen = self._workbench.replaying.paced, self.chosen
        if paced is None or chosen is None or paced.replay.recording.path != chosen.path:
            return None
        return paced.at_s

    def _here(self, field: QLineEdit) -> None:
        at_s = self._shown_s()
        if at_s is not None:
            field.setText(fixed(at_s, 3))

    def _stretch(self, one: Entry) -> tuple[float, float] | None:
        try:
            return span(self.begin.text(), self.end.text(), one.duration_s or 0.0)
        except InputError as error:
            self._workbench.notify(Level.WARNING, error_text(error), about=error)
            return None

    # --- dialogs ----------------------------------------------------------------------------------

    def _with_chosen(self, use: Callable[[Entry], None]) -> None:
        chosen = self.chosen
        if chosen is not None and chosen.usable:
            use(chosen)

    def _open(self, one: Entry) -> None:
        if not one.usable:
            self._workbench.notify(Level.WARNING, f"{one.name}: {state_text(one)}", about=self)
        elif one.path.suffix == SUFFIX:
            self._workbench.open_replay(one.path)
        else:
            self._workbench.open_entry(one)

    def _ask_export(self) -> None:
        def ask(one: Entry) -> None:
            title, kinds = tr("Export a record"), tr("Records (*.csv *.csv.gz)")
            name = f"{one.path.stem}.csv"
            ask_where(
                self.window(), self._workbench, title, kinds, name, lambda to: self.export(one, to)
            )

        self._with_chosen(ask)

    def _ask_other(self) -> None:
        kinds = tr("Recordings (*{suffix});;All files (*)").format(suffix=SUFFIX)
        ask_file(self.window(), self._workbench, tr("Replay"), kinds, self._workbench.open_replay)

    def _ask_where_it_is(self) -> None:
        one = self.chosen
        if one is not None:
            title = tr("Where is {name}?").format(name=one.path.name)
            kinds = f"*{one.path.suffix} (*{one.path.suffix})"
            library = self._workbench.library
            ask_file(
                self.window(), self._workbench, title, kinds, lambda to: library.found_at(one, to)
            )

    def _ask_delete(self) -> None:
        """Ask whether to delete; files of other folders are only forgotten."""
        chosen = self.table.chosen
        if not chosen:
            return
        own = [one for one in chosen if one.kind is not Kind.FILE and not one.missing]
        names = ", ".join(f'"{one.name}"' for one in chosen[:3])
        if len(chosen) > 3:
            names = tr("{names} and {n} more").format(names=names, n=len(chosen) - 3)
        text = tr(
            "Delete {names}? This permanently deletes {size} from the disk. Files in "
            "other folders stay; only their entries are removed."
        ).format(names=names, size=size_text(sum(one.size for one in own)))
        delete = self._workbench.library.delete
        self.question.ask(text, tr("Delete"), lambda: delete(chosen))


def _fit(field: QLineEdit, text: str) -> None:
    room = field.fontMetrics().horizontalAdvance(text)
    field.setFixedWidth(max(60, room + 28))  # the frame and the cursor


def _field(end: str) -> QLineEdit:
    field = QLineEdit()
    what = tr(end)
    field.setPlaceholderText(what)
    WhenDressed(field, lambda: _fit(field, what))
    field.setAccessibleName(
        tr("{end} of the section in seconds").format(end=what[:1].upper() + what[1:])
    )
    field.setToolTip(
        tr("Seconds from the start of the recording; empty: its {end}").format(end=what)
    )
    return field
