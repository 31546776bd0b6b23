"""Table of the latest runs, and the details of the selected one."""

from collections.abc import Iterable
from datetime import datetime

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QPlainTextEdit, QSplitter, QWidget

from rotemina.app.language import translate
from rotemina.app.motion.penetration import PenetrationRun
from rotemina.app.shell.records import RUN_REPORT_LABEL, RUN_REPORT_TIP
from rotemina.app.widgets.controls import (
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import ElidedLabel, TextTable
from rotemina.plugins.penetration import tr
from rotemina.plugins.penetration.past_runs import (
    COLUMN_TIPS,
    COLUMN_TITLES,
    PastRunList,
    describe_run,
    make_run_row,
)

_NUMBER_COLUMNS = range(2, 7)


class PastRunsView(QWidget):
    """Table of runs next to the details of the selected one.

    Signals
    -------
    report_asked(PenetrationRun) : the operator wants a report of the selected run.
    """

    report_asked = Signal(object)

    def __init__(self, path: str) -> None:
        super().__init__()
        self.run_list = PastRunList()
        self.table = TextTable(
            tr("Runs, latest first"), [tr(title) for title in COLUMN_TITLES], row_height=24
        )
        for column, tooltip in enumerate(COLUMN_TIPS):
            self.table.horizontalHeaderItem(column).setToolTip(make_tooltip(tr(tooltip)))
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.setMinimumSize(200, 60)
        self.table.itemSelectionChanged.connect(self._show_selected)
        self.text = QPlainTextEdit()
        self.text.setReadOnly(True)
        self.text.setAccessibleName(tr("Details of the selected run"))
        self.text.setToolTip(tr("Log of the selected run"))
        self.text.setPlaceholderText(tr("Select a run to see its details."))
        self.text.setMinimumWidth(160)
        splitter = QSplitter(Qt.Orientation.Horizontal)
        splitter.addWidget(self.table)
        splitter.addWidget(self.text)
        splitter.setSizes([620, 300])
        splitter.setChildrenCollapsible(False)
        self.file_label = ElidedLabel()
        self.file_label.setProperty("quiet", True)
        self.file_label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._path = path
        self.report = make_button(translate("shell", RUN_REPORT_LABEL), self._ask_report)
        bottom_row = make_row((self.file_label, 1), self.report)
        make_column((splitter, 1), bottom_row, on=self, margins=0, spacing=3)
        self._fill_table()

    def add_logged(self, runs: Iterable[PenetrationRun]) -> None:
        """Show the runs of the log file below the runs since the program start."""
        self.run_list.add_logged(runs)
        self._fill_table()

    def add_latest(self, run: PenetrationRun | None) -> None:
        """Show a run that has just ended, unless it is already in the table."""
        if self.run_list.add_latest(run):
            self._fill_table()

    def _fill_table(self) -> None:
        now = datetime.now().astimezone()
        with QSignalBlocker(self.table):
            self.table.clearSelection()
        self.table.show_rows(
            [make_run_row(run, now) for run in self.run_list.runs],
            numeric_columns=_NUMBER_COLUMNS,
            tips=True,
        )
        self.text.clear()
        self._update_report_button()
        count, new_count = len(self.run_list.runs), self.run_list.new_run_count
        self.file_label.show_text(
            tr("{count} runs, {ours} since the program start. Log file: {path}").format(
                count=count, ours=new_count, path=self._path
            )
        )

    def _show_selected(self) -> None:
        run = self._selected_run
        self.text.setPlainText("" if run is None else describe_run(run))
        self._update_report_button()

    def _update_report_button(self) -> None:
        objection = tr("select a run") if self._selected_run is None else None
        enable_unless(self.report, objection, translate("shell", RUN_REPORT_TIP))

    def _ask_report(self) -> None:
        if (run := self._selected_run) is not None:
            self.report_asked.emit(run)

    @property
    def _selected_run(self) -> PenetrationRun | None:
        rows = self.table.selectionModel().selectedRows()
        return self.run_list.runs[rows[0].row()] if rows else None
