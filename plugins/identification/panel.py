"""The identification page: one axis of a record, one pair of taps, five views."""

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication, QResizeEvent
from PySide6.QtWidgets import QPlainTextEdit, QScrollArea, QSplitter, QWidget

from rotemina.app.files import write_text
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.column_mapping import ask_columns
from rotemina.app.shell.engine_words import error_text
from rotemina.app.shell.file_dialog import ask_file, ask_where
from rotemina.app.shell.language import marked
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Run, Workbench
from rotemina.app.widgets.controls import allow, named
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.scroll_areas import scrolled
from rotemina.app.widgets.table import Table
from rotemina.app.widgets.when_seen import WhenSeen
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.chart import Chart
from rotemina.plugins.identification.controls import Controls
from rotemina.plugins.identification.excitation import VIEWS, steady
from rotemina.plugins.identification.excite_view import ExciteView
from rotemina.plugins.identification.export import as_csv, as_text
from rotemina.plugins.identification.filled_template import localized
from rotemina.plugins.identification.findings import Findings, answered
from rotemina.plugins.identification.health_card import keep_card
from rotemina.plugins.identification.record_query import Question
from rotemina.plugins.identification.views import LOOKS, View
from rotemina.sim.errors import InputError
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record

EMPTY = mark("Excite an axis, play a trajectory or open a record to identify the machine.")
RECORDS = mark("Records (*.csv *.txt *.dat *.gz);;All files (*)")
CHARTS = 3
# Shares of sheet and charts: an operator's own stay until another number of charts is shown.
WIDTHS = ([920, 0, 0, 0], [420, 500, 0, 0], [420, 250, 250, 0], [280, 260, 190, 190])
ONE_LINE, TWO_LINES = 29, 47  # heights of the notices; more is a turn of the wheel away
MARGIN = 20
EXCITE_WIDTH = 272  # px
HEIGHT = 240  # with two lines of notices, so that the window does not jump when they come


class IdentificationPanel(Panel):
    """The record that was last played or opened, looked at tap by tap."""

    title = marked("panels", "Identification")
    area = Area.BOTTOM
    order = 30
    help_page = "identification.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.controls = Controls()
        self.excite = ExciteView(workbench)
        self.summary = plain_text(tr(EMPTY), quiet=False, wrap=True)
        self.notices = _notices()
        self.charts = tuple(Chart(workbench.theme) for _ in range(CHARTS))
        self.sheet = Table(tr("Figures"), choose=False)
        self.findings: Findings | None = None
        self._name = ""
        self._question: Question | None = None
        self._known: dict[View, Findings] = {}
        self._lay_out()
        self._look_when_seen = WhenSeen(self, self._look)
        self._draw_when_seen = WhenSeen(self, self._draw)
        self._connect()
        offer_in_palette(self.excite.play)
        offer_in_palette(
            self.controls.open,
            self.controls.copy,
            self.controls.save,
            self.excite.stop,
            safe_while_hidden=True,
        )
        self._use_theme(workbench.theme)
        self._show(None)
        if workbench.run is not None:
            self._take_run(workbench.run)

    def _lay_out(self) -> None:
        side = QWidget()
        in_column(self.summary, (self.sheet, 1), on=side, margins=0, spacing=2)
        self._split = QSplitter(Qt.Orientation.Horizontal)
        self._split.addWidget(side)
        for chart in self.charts:
            self._split.addWidget(chart)
        looks = in_column(self.notices, (self._split, 1), spacing=4)
        self._exciting = _scrolled(self.excite)
        self._exciting.hide()
        row = in_row(self._exciting, (looks, 1))
        in_column(self.controls, (row, 1), on=self, margins=(10, 6, 10, 6), spacing=4)
        self.setMinimumHeight(HEIGHT)

    def _connect(self) -> None:
        self.controls.excite.toggled.connect(self._show_exciting)
        self.controls.open.clicked.connect(self._ask_record)
        self.controls.copy.clicked.connect(self._copy)
        self.controls.save.clicked.connect(self._ask_save)
        self.controls.keep.clicked.connect(self.keep_card)
        self.controls.asked.connect(self._ask)
        self.controls.view_changed.connect(self._look)
        self.workbench.run_changed.connect(self._take_run)
        self.workbench.theme_changed.connect(self._use_theme)

    # --- the record -------------------------------------------------------------------------------

    def take_record(self, name: str, record: Record) -> None:
        """Look at a record."""
        self._name = name
        self.controls.offer(record)
        self._ask()

    def open_record(self, path: Path, columns: str | None = None) -> None:
        """Read a record for this page alone; the model need not be able to follow it."""

        def work() -> Record | str:
            try:
                return read_record(path, columns=columns, robot=self.workbench.robot)
            except InputError as error:
                return error_text(error)

        def done(answer: Record | str) -> None:
            if isinstance(answer, str):
                self._say([answer])
            else:
                self.take_record(path.name, answer)

        self.workbench.read_file("identification record", path.name, work, done)

    def _take_run(self, run: Run) -> None:
        """Look at a run; at one of this page's own excitations from where it says most."""
        motion = self.excite.played(run)
        if motion is None:
            self.take_record(run.name, run.record)
            return
        record = steady(run.record, motion) if run.completed else run.record
        self.controls.offer(record)
        self.controls.look_at(motion.request.axis, VIEWS[motion.request.wave])
        self.take_record(run.name, record)

    def _ask_record(self) -> None:
        title = tr("Open record")
        kinds = tr(RECORDS)

        def use(path: Path) -> None:
            ask_columns(path, self.workbench, self, self.open_record)

        ask_file(self, self.workbench, title, kinds, use)

    # --- the question and its answer --------------------------------------------------------------

    def _ask(self) -> None:
        """Forget what was found: it answers another question."""
        self._known.clear()
        self._question = self.controls.question(
            self._name, self.workbench.robot, self.workbench.settings.folder
        )
        self._look_when_seen()

    def _look(self) -> None:
        question, view = self._question, self.controls.shown
        if question is None:
            self._show(None)
            if self._name:
                axis = self.controls.axis.currentText()
                text = tr("{record}: axis {axis} lacks an input or an output.")
                self._say([text.format(record=self._name, axis=axis)])
            return
        if view in self._known:
            self._show(self._known[view])
            return
        self._keep_in_grey()
        self.summary.setText(tr("{record}: computing …").format(record=question.name))
        self.workbench.work(
            "identification",
            tr("Identification of {record} …").format(record=question.name),
            lambda: self._answer(question, view),
            lambda findings: self._receive(view, findings),
            lambda: self._show(None),
        )

    def _answer(self, question: Question, view: View) -> Findings:
        """Run in the background; what nobody asks any more is not worked out."""
        if question is not self._question:
            return Findings(question)
        return answered(LOOKS[view], question)

    def _receive(self, view: View, findings: Findings) -> None:
        """Keep an answer, unless another question was asked meanwhile."""
        if findings.question is not self._question:
            return
        self._known[view] = findings
        if view is self.controls.shown:
            self._show(findings)

    def _keep_in_grey(self) -> None:
        """Leave the last curves until the next answer; nothing is laid out twice."""
        self.findings = None
        self._allow()
        self.sheet.show_rows(())
        for chart in self.charts:
            chart.plot.set_stale(True)

    def _show(self, findings: Findings | None) -> None:
        self.findings = findings
        self._draw_when_seen()

    def _draw(self) -> None:
        findings = self.findings
        pictures = findings.pictures if findings is not None else ()
        if len(pictures) != sum(not chart.isHidden() for chart in self.charts):
            self._split.setSizes(WIDTHS[len(pictures)])
        for number, chart in enumerate(self.charts):
            chart.setVisible(number < len(pictures))
            if number < len(pictures):
                chart.plot.set_stale(False)
                chart.show_picture(pictures[number])
        self.sheet.set_head(list(map(localized, findings.head)) if findings else ())
        self.sheet.show_rows(
            [list(map(localized, row)) for row in findings.rows] if findings else ()
        )
        self._say(findings.notices if findings is not None else ())
        self._allow()
        if findings is not None:
            record = findings.question.record
            text = tr("{record}: {time:.3f} s, {n} samples")
            self.summary.setText(
                text.format(
                    record=findings.question.name, time=record.duration_s, n=len(record.time_s)
                )
            )

    def _allow(self) -> None:
        """Allow what needs findings."""
        none = None if self.findings is not None else tr("there are no figures yet")
        card = (
            None
            if self.findings is None or self.findings.columns
            else tr("these figures are not a health card")
        )
        allow(self.controls.copy, none, tr("Copy the figures as text"))
        allow(self.controls.save, none, tr("Write the figures into a file"))
        tip = tr("Store this health card with the earlier ones of the axis")
        allow(self.controls.keep, none or card, tip)

    def _show_exciting(self, shown: bool) -> None:
        self._exciting.setVisible(shown)
        self._size_notices()

    def _say(self, notices: list[str] | tuple[str, ...]) -> None:
        text = "\n".join(map(localized, notices))
        self.notices.setPlainText(text)
        self.notices.setToolTip(text)
        self.notices.setVisible(bool(text))
        self._size_notices()

    def _size_notices(self) -> None:
        text = self.notices.toPlainText()
        room = self.width() - 2 * MARGIN - (0 if self._exciting.isHidden() else EXCITE_WIDTH)
        fits = self.notices.fontMetrics().horizontalAdvance(text) < room
        self.notices.setFixedHeight(ONE_LINE if "\n" not in text and fits else TWO_LINES)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Give the notices the lines that they need at the new width."""
        super().resizeEvent(event)
        self._size_notices()

    # --- results out ------------------------------------------------------------------------------

    def _copy(self) -> None:
        if self.findings is not None:
            QGuiApplication.clipboard().setText(as_text(self.findings, self.controls.shown))

    def keep_card(self) -> None:
        """Keep the health card in sight behind the earlier ones of its axis."""
        findings = self.findings
        if findings is None or not findings.columns or self.controls.shown is not View.HEALTH:
            return
        self.workbench.work(
            "health card",
            tr("Storing the health card …"),
            lambda: keep_card(findings.question),
            lambda _: self._kept(findings.question),
        )

    def _kept(self, question: Question) -> None:
        """Look again: what was kept is the last card now."""
        text = tr("Stored the health card of {axis}")
        self.workbench.notify(Level.GOOD, text.format(axis=question.axis))
        self._known.pop(View.HEALTH, None)
        if question is self._question and self.controls.shown is View.HEALTH:
            self._look()

    def _ask_save(self) -> None:
        if self.findings is None:
            return
        title, kinds = tr("Save results"), tr("Tables (*.csv)")
        # What is in sight now, whatever comes in while the dialog is open.
        text = as_csv(self.findings, self.controls.shown)
        ask_where(
            self,
            self.workbench,
            title,
            kinds,
            "identification.csv",
            lambda path: self.save_text(path, text),
        )

    def save_text(self, path: Path, text: str) -> None:
        """Write results to a file."""
        self.workbench.write_file("identification results", path, lambda: write_text(path, text))

    def _use_theme(self, theme: Theme) -> None:
        self.notices.setStyleSheet(f"color: {theme.warning};")
        for chart in self.charts:
            chart.set_theme(theme)


def _scrolled(section: QWidget) -> QScrollArea:
    scroll = scrolled(section)
    scroll.setFixedWidth(EXCITE_WIDTH)
    return scroll


def _notices() -> QPlainTextEdit:
    notices = named(QPlainTextEdit(), tr("Limits of this record"))
    notices.setReadOnly(True)
    return notices
