"""The recordings of the folder: open one, export a stretch, make a trajectory of it."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFileDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.motion.recording import exporting
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.merging import SUFFIX
from rotemina.app.motion.recording.reading import Recording
from rotemina.app.shell.controls import allow, plain_tip
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.plugins.recorder.listing import Listed
from rotemina.plugins.recorder.words import BEGIN, COLUMNS, END, cells, span
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record

_WIDTHS = (150, 62, 66, 60, 76)  # of all columns but the last, px
_NONE = marked("recorder", "choose a recording in the table")


class RecordingsView(QWidget):
    """Table, with what was ``unfinished`` over it, and what can be done with the chosen recording.

    ``other`` and ``again`` are buttons that stand elsewhere.

    Signals
    -------
    looked_for() : the folder is to be looked into again.
    """

    looked_for = Signal()

    def __init__(self, workbench: Workbench, unfinished: QWidget) -> None:
        super().__init__()
        self._workbench = workbench
        self.recordings: tuple[Listed, ...] = ()
        self.table = _table()
        self.table.itemSelectionChanged.connect(self._allow)
        self.table.doubleClicked.connect(lambda _: self._open_chosen())
        self.table.activated.connect(lambda _: self._open_chosen())
        self._make_buttons()
        self._lay_out(unfinished)
        self._allow()
        workbench.replaying.changed.connect(self._allow)

    def show_recordings(self, recordings: tuple[Listed, ...]) -> None:
        """Show what the folder holds; what was chosen stays chosen."""
        chosen = self.chosen
        if recordings == self.recordings:
            return
        self.recordings = recordings
        self.table.clearSelection()
        self.table.setRowCount(len(recordings))
        for row, one in enumerate(recordings):
            for column, text in enumerate(cells(one)):
                item = QTableWidgetItem(text)
                item.setToolTip(plain_tip(str(one.path), one.problem))
                self.table.setItem(row, column, item)
            if chosen is not None and one.path == chosen.path:
                self.table.selectRow(row)
        self._allow()

    @property
    def chosen(self) -> Listed | None:
        """The recording of the chosen row."""
        rows = {index.row() for index in self.table.selectedIndexes()}
        return self.recordings[rows.pop()] if rows else None

    # --- what comes of one ------------------------------------------------------------------------

    def export(self, one: Listed, target: Path) -> None:
        """Write the stretch that is typed as an ASCII record."""
        stretch = self._stretch(one)
        if stretch is None:
            return

        def work() -> int:
            if target.exists() and target.samefile(one.path):
                raise RecordingError(
                    translate(
                        "recorder", "{target}: it is the recording itself; name another file"
                    ).format(target=target)
                )
            recording = Recording.open(one.path)
            begin_s, end_s = (recording.began_s + at_s for at_s in stretch)
            return exporting.export(recording, target, begin_s, end_s)

        def done(rows: int) -> None:
            self._workbench.notify(
                Level.GOOD,
                translate("recorder", "Exported {target}: {rows} rows").format(
                    target=target, rows=rows
                ),
            )

        doing = translate("recorder", "Exporting {name} …").format(name=target.name)
        self._workbench.work(f"export {target}", doing, work, done)

    def take_in_hand(self, one: Listed) -> None:
        """Make the commands of the stretch that is typed the trajectory in hand."""
        stretch = self._stretch(one)
        if stretch is None:
            return
        robot, period_s = self._workbench.robot, self._workbench.session.setpoint_period_s

        def work() -> Record:
            recording = Recording.open(one.path)
            begin_s, end_s = (recording.began_s + at_s for at_s in stretch)
            return exporting.trajectory(recording, begin_s, end_s, period_s, robot).commands

        def done(commands: Record) -> None:
            self._workbench.plan_trajectory(
                translate("recorder", "{stem} again").format(stem=one.path.stem), commands
            )

        doing = translate("recorder", "Reading the commands of {name} …").format(name=one.path.name)
        self._workbench.work("recorded trajectory", doing, work, done)

    # --- parts ------------------------------------------------------------------------------------

    def _make_buttons(self) -> None:
        self.open = _button(translate("recorder", "Replay"), self._open_chosen)
        self.other = _button(translate("recorder", "Other file …"), self._ask_other)
        self.other.setToolTip(translate("recorder", "Show a recording from another folder"))
        self.to_record = _button(translate("recorder", "Export …"), self._ask_export)
        self.to_trajectory = _button(
            translate("recorder", "To trajectory"), lambda: self._with_chosen(self.take_in_hand)
        )
        self.again = _button(translate("recorder", "Refresh"), self.looked_for.emit)
        self.again.setToolTip(translate("recorder", "Look into the folder again"))
        self.begin, self.end = _field(BEGIN), _field(END)
        self.begin_here = _button(translate("recorder", "▏Here"), lambda: self._here(self.begin))
        self.end_here = _button(translate("recorder", "Here▕"), lambda: self._here(self.end))

    def _lay_out(self, unfinished: QWidget) -> None:
        stretch = QHBoxLayout()
        stretch.addWidget(QLabel(translate("recorder", "From")))
        stretch.addWidget(self.begin)
        stretch.addWidget(self.begin_here)
        stretch.addWidget(QLabel(translate("recorder", "to")))
        stretch.addWidget(self.end)
        stretch.addWidget(QLabel("s"))
        stretch.addWidget(self.end_here)
        stretch.addStretch(1)
        stretch.addWidget(self.open)
        stretch.addWidget(self.to_record)
        stretch.addWidget(self.to_trajectory)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        column.addWidget(unfinished)
        column.addWidget(self.table, 1)
        column.addLayout(stretch)

    def _allow(self) -> None:
        chosen = self.chosen
        why_not = translate("recorder", _NONE) if chosen is None else chosen.problem or None
        allow(
            self.open, why_not, translate("recorder", "Show the recording in place of the machine")
        )
        tip = translate(
            "recorder", "Write the stretch as an ASCII record, to be compared and diagnosed"
        )
        allow(self.to_record, why_not, tip)
        tip = translate(
            "recorder",
            "Take the commands of the stretch in hand, to be played on the machine; every axis "
            "must stand at both ends",
        )
        allow(self.to_trajectory, why_not, tip)
        here = (
            None
            if self._shown_s() is not None
            else translate("recorder", "this recording is not shown")
        )
        allow(
            self.begin_here,
            here,
            translate("recorder", "Let the stretch begin where the replay is"),
        )
        allow(self.end_here, here, translate("recorder", "Let the stretch end where the replay is"))

    def _shown_s(self) -> float | None:
        """Return where the replay of the chosen recording is."""
        paced, chosen = self._workbench.replaying.paced, self.chosen
        if paced is None or chosen is None or paced.replay.recording.path != chosen.path:
            return None
        return paced.at_s

    def _here(self, field: QLineEdit) -> None:
        at_s = self._shown_s()
        if at_s is not None:
            field.setText(f"{at_s:.3f}")

    def _stretch(self, one: Listed) -> tuple[float, float] | None:
        try:
            return span(self.begin.text(), self.end.text(), one.duration_s)
        except InputError as error:
            self._workbench.notify(Level.WARNING, str(error), about=error)
            return None

    # --- dialogs ----------------------------------------------------------------------------------

    def _with_chosen(self, use: Callable[[Listed], None]) -> None:
        chosen = self.chosen
        if chosen is not None and not chosen.problem:
            use(chosen)

    def _open_chosen(self) -> None:
        self._with_chosen(lambda one: self._workbench.open_replay(one.path))

    def _ask_export(self) -> None:
        def ask(one: Listed) -> None:
            dialog = self._dialog(
                translate("recorder", "Export a record"),
                translate("recorder", "Records (*.csv *.csv.gz)"),
            )
            dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
            dialog.selectFile(f"{one.path.stem}.csv")
            dialog.fileSelected.connect(lambda name: self.export(one, Path(name)))
            dialog.show()

        self._with_chosen(ask)

    def _ask_other(self) -> None:
        dialog = self._dialog(
            translate("recorder", "Replay"),
            translate("recorder", "Recordings (*{suffix});;All files (*)").format(suffix=SUFFIX),
        )
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.fileSelected.connect(lambda name: self._workbench.open_replay(Path(name)))
        dialog.show()

    def _dialog(self, title: str, filters: str) -> QFileDialog:
        """Return a dialog beside which the window, and its stop button, can still be used."""
        settings = self._workbench.settings
        dialog = QFileDialog(self.window(), title, settings.get("files.folder", ""), filters)
        dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.fileSelected.connect(
            lambda name: settings.set("files.folder", str(Path(name).parent))
        )
        return dialog


def _button(text: str, run: Callable[[], object]) -> QPushButton:
    made = QPushButton(text)
    made.clicked.connect(lambda _: run())
    return made


def _field(end: str) -> QLineEdit:
    field = QLineEdit()
    what = translate("recorder", end)
    field.setPlaceholderText(what)
    room = field.fontMetrics().horizontalAdvance(what)
    field.setFixedWidth(max(60, room + 28))  # the frame and the cursor
    field.setAccessibleName(
        translate("recorder", "{end} of the stretch in seconds").format(
            end=what[:1].upper() + what[1:]
        )
    )
    field.setToolTip(
        translate("recorder", "Seconds from the begin of the recording; empty: its {end}").format(
            end=what
        )
    )
    return field


def _table() -> QTableWidget:
    table = QTableWidget(0, len(COLUMNS))
    table.setAccessibleName(translate("recorder", "Recordings, newest first"))
    table.setHorizontalHeaderLabels([translate("recorder", name) for name in COLUMNS])
    table.verticalHeader().hide()
    table.verticalHeader().setDefaultSectionSize(22)
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setTabKeyNavigation(False)
    table.setWordWrap(False)
    header = table.horizontalHeader()
    header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
    header.setStretchLastSection(True)
    for column, width in enumerate(_WIDTHS):
        table.setColumnWidth(column, max(width, header.sectionSizeHint(column)))
    return table
