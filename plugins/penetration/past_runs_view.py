"""The latest runs in a table, and the details of the selected one."""

from collections.abc import Iterable
from datetime import datetime

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QPlainTextEdit, QSplitter, QWidget

from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.shell.language import translate
from rotemina.app.shell.report_files import RUN_REPORT, RUN_REPORT_TIP
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.table import Table
from rotemina.plugins.penetration import tr
from rotemina.plugins.penetration.past_runs import COLUMN_TIPS, COLUMNS, RunList, in_full, row

_NUMBERS = range(2, 7)


class LogView(QWidget):
    """A table beside the text of one run.

    Signals
    -------
    report_asked(PenetrationRun) : the report of the selected run is wanted.
    """

    report_asked = Signal(object)

    def __init__(self, path: str) -> None:
        super().__init__()
        self.list = RunList()
        self.table = Table(tr("Runs, latest first"), [tr(one) for one in COLUMNS], row_height=24)
        for column, tip in enumerate(COLUMN_TIPS):
            self.table.horizontalHeaderItem(column).setToolTip(plain_tip(tr(tip)))
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.setMinimumSize(200, 60)
        self.table.itemSelectionChanged.connect(self._show_chosen)
        self.text = QPlainTextEdit()
        self.text.setReadOnly(True)
        self.text.setAccessibleName(tr("Details of the selected run"))
        self.text.setToolTip(tr("Log of the selected run"))
        self.text.setPlaceholderText(tr("Select a run to see its details."))
        self.text.setMinimumWidth(160)
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(self.table)
        split.addWidget(self.text)
        split.setSizes([620, 300])
        split.setChildrenCollapsible(False)
        self.file = ElidedLabel()
        self.file.setProperty("quiet", True)
        self.file.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._path = path
        self.report = button(translate("shell", RUN_REPORT), self._ask_report)
        below = in_row((self.file, 1), self.report)
        in_column((split, 1), below, on=self, margins=0, spacing=3)
        self._fill()

    def take_file(self, runs: Iterable[PenetrationRun]) -> None:
        """Show the file's runs behind those of this start."""
        self.list.take_file(runs)
        self._fill()

    def take_latest(self, run: PenetrationRun | None) -> None:
        """Show a run that has just ended, if it is another."""
        if self.list.take_latest(run):
            self._fill()

    def _fill(self) -> None:
        now = datetime.now().astimezone()
        with QSignalBlocker(self.table):
            self.table.clearSelection()
        self.table.show_rows([row(run, now) for run in self.list.runs], numbers=_NUMBERS, tips=True)
        self.text.clear()
        self._allow_report()
        count, ours = len(self.list.runs), self.list.of_this_start
        self.file.show_text(
            tr("{count} runs, {ours} since the program start. Log file: {path}").format(
                count=count, ours=ours, path=self._path
            )
        )

    def _show_chosen(self) -> None:
        chosen = self._chosen
        self.text.setPlainText("" if chosen is None else in_full(chosen))
        self._allow_report()

    def _allow_report(self) -> None:
        none = tr("select a run") if self._chosen is None else None
        allow(self.report, none, translate("shell", RUN_REPORT_TIP))

    def _ask_report(self) -> None:
        if (chosen := self._chosen) is not None:
            self.report_asked.emit(chosen)

    @property
    def _chosen(self) -> PenetrationRun | None:
        rows = self.table.selectionModel().selectedRows()
        return self.list.runs[rows[0].row()] if rows else None
