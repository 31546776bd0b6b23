"""The Identification panel: five views of a pair of taps of one axis of a record."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication, QResizeEvent
from PySide6.QtWidgets import QPlainTextEdit, QScrollArea, QSplitter, QWidget

from rotemina.app.language import describe_error, marked
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.settings import write_text
from rotemina.app.shell.records import ask_columns, ask_file, ask_save_path
from rotemina.app.widgets.controls import enable_unless, name_widget
from rotemina.app.widgets.layout import make_column, make_row, make_scroll_area
from rotemina.app.widgets.style import OnVisible, Theme
from rotemina.app.widgets.text import TextTable, make_plain_label
from rotemina.app.workbench import (
    ComparedRun,
    Level,
    Workbench,
)
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.chart import PictureChart
from rotemina.plugins.identification.controls import IdentificationControls
from rotemina.plugins.identification.excitation import WAVE_VIEWS, trim_to_steady_state
from rotemina.plugins.identification.excite_view import ExcitationView
from rotemina.plugins.identification.export import to_csv, to_text
from rotemina.plugins.identification.findings import (
    AnalysisFindings,
    answer_question,
    translate_text,
)
from rotemina.plugins.identification.frequency import analyse_frequency_response
from rotemina.plugins.identification.health_card import compare_health_card, store_card
from rotemina.plugins.identification.hysteresis_loop import analyse_loop
from rotemina.plugins.identification.low_order_fit import fit_low_order_model
from rotemina.plugins.identification.record_query import AnalysisQuestion, AnalysisView
from rotemina.plugins.identification.staircase import analyse_steps
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, read_record

EMPTY_TEXT = mark("Excite an axis, play a trajectory or open a record to identify the machine.")
RECORD_FILTER = mark("Records (*.csv *.txt *.dat *.gz);;All files (*)")
CHART_COUNT = 3
# Widths of the table and the charts, by the number of charts. Widths that the operator has set are
# kept until that number changes.
SPLITTER_SIZES_PX = ([920, 0, 0, 0], [420, 500, 0, 0], [420, 250, 250, 0], [280, 260, 190, 190])
# Heights of the notices. Further lines are reached by scrolling.
ONE_LINE_HEIGHT_PX, TWO_LINES_HEIGHT_PX = 29, 47
NOTICE_MARGIN_PX = 20
EXCITE_WIDTH_PX = 272
# The panel has room for two lines of notices, so that it does not grow when they appear.
MIN_HEIGHT_PX = 240
ANALYSES: dict[AnalysisView, Callable[[AnalysisQuestion], AnalysisFindings]] = {
    AnalysisView.FREQUENCY: analyse_frequency_response,
    AnalysisView.LOOP: analyse_loop,
    AnalysisView.STEPS: analyse_steps,
    AnalysisView.MODEL: fit_low_order_model,
    AnalysisView.HEALTH: compare_health_card,
}


class IdentificationPanel(Panel):
    """Panel that analyses the latest record that was played or opened."""

    title = marked("panels", "Identification")
    area = PanelArea.BOTTOM
    order = 30
    help_page = "identification.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.controls = IdentificationControls()
        self.excite = ExcitationView(workbench)
        self.summary = make_plain_label(tr(EMPTY_TEXT), quiet=False, wrap=True)
        self.notices = _make_notices()
        self.charts = tuple(PictureChart(workbench.theme) for _ in range(CHART_COUNT))
        self.sheet = TextTable(tr("Figures"), selectable=False)
        self.findings: AnalysisFindings | None = None
        self._name = ""
        self._question: AnalysisQuestion | None = None
        self._findings_by_view: dict[AnalysisView, AnalysisFindings] = {}
        self._lay_out()
        self._analyse_when_seen = OnVisible(self, self._analyse)
        self._draw_when_seen = OnVisible(self, self._draw)
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
        left = QWidget()
        make_column(self.summary, (self.sheet, 1), on=left, margins=0, spacing=2)
        self._split = QSplitter(Qt.Orientation.Horizontal)
        self._split.addWidget(left)
        for chart in self.charts:
            self._split.addWidget(chart)
        results = make_column(self.notices, (self._split, 1), spacing=4)
        self._excite_scroll = _make_excite_scroll(self.excite)
        self._excite_scroll.hide()
        row = make_row(self._excite_scroll, (results, 1))
        make_column(self.controls, (row, 1), on=self, margins=(10, 6, 10, 6), spacing=4)
        self.setMinimumHeight(MIN_HEIGHT_PX)

    def _connect(self) -> None:
        self.controls.excite.toggled.connect(self._show_excitation)
        self.controls.open.clicked.connect(self._ask_record)
        self.controls.copy.clicked.connect(self._copy)
        self.controls.save.clicked.connect(self._ask_save)
        self.controls.keep.clicked.connect(self.store_card)
        self.controls.question_changed.connect(self._update_question)
        self.controls.view_changed.connect(self._analyse)
        self.workbench.run_changed.connect(self._take_run)
        self.workbench.theme_changed.connect(self._use_theme)

    def take_record(self, name: str, record: Record) -> None:
        """Analyse a record."""
        self._name = name
        self.controls.offer_record(record)
        self._update_question()

    def open_record(self, path: Path, columns: str | None = None) -> None:
        """Read a record for this panel only. The model need not be able to follow it."""

        def read_or_explain() -> Record | str:
            try:
                return read_record(path, columns=columns, robot=self.workbench.robot)
            except InputError as error:
                return describe_error(error)

        def on_read(record_or_error: Record | str) -> None:
            if isinstance(record_or_error, str):
                self._show_notices([record_or_error])
            else:
                self.take_record(path.name, record_or_error)

        self.workbench.read_file("identification record", path.name, read_or_explain, on_read)

    def _take_run(self, run: ComparedRun) -> None:
        """Analyse a run. For an excitation by this panel, choose the view that suits it."""
        motion = self.excite.find_played_motion(run)
        if motion is None:
            self.take_record(run.name, run.record)
            return
        record = trim_to_steady_state(run.record, motion) if run.completed else run.record
        self.controls.offer_record(record)
        self.controls.choose_view(motion.request.axis, WAVE_VIEWS[motion.request.wave])
        self.take_record(run.name, record)

    def _ask_record(self) -> None:
        title = tr("Open record")
        file_filter = tr(RECORD_FILTER)

        def open_with_columns(path: Path) -> None:
            ask_columns(path, self.workbench, self, self.open_record)

        ask_file(self, self.workbench, title, file_filter, open_with_columns)

    def _update_question(self) -> None:
        """Read the question from the controls, and discard the findings for the previous one."""
        self._findings_by_view.clear()
        self._question = self.controls.make_question(
            self._name, self.workbench.robot, self.workbench.settings.folder
        )
        self._analyse_when_seen()

    def _analyse(self) -> None:
        question, view = self._question, self.controls.current_view
        if question is None:
            self._show(None)
            if self._name:
                axis = self.controls.axis.currentText()
                text = tr("{record}: axis {axis} lacks an input or an output.")
                self._show_notices([text.format(record=self._name, axis=axis)])
            return
        if view in self._findings_by_view:
            self._show(self._findings_by_view[view])
            return
        self._grey_out()
        self.summary.setText(tr("{record}: computing …").format(record=question.name))
        self.workbench.work(
            "identification",
            tr("Identification of {record} …").format(record=question.name),
            lambda: self._compute_findings(question, view),
            lambda findings: self._on_findings(view, findings),
            lambda: self._show(None),
        )

    def _compute_findings(self, question: AnalysisQuestion, view: AnalysisView) -> AnalysisFindings:
        """Return findings. This runs in the background, and skips an outdated question."""
        if question is not self._question:
            return AnalysisFindings(question)
        return answer_question(ANALYSES[view], question)

    def _on_findings(self, view: AnalysisView, findings: AnalysisFindings) -> None:
        """Keep findings unless the question has changed in the meantime."""
        if findings.question is not self._question:
            return
        self._findings_by_view[view] = findings
        if view is self.controls.current_view:
            self._show(findings)

    def _grey_out(self) -> None:
        """Grey out the previous curves until new findings arrive, so that the layout is stable."""
        self.findings = None
        self._update_buttons()
        self.sheet.show_rows(())
        for chart in self.charts:
            chart.plot.set_stale(True)

    def _show(self, findings: AnalysisFindings | None) -> None:
        self.findings = findings
        self._draw_when_seen()

    def _draw(self) -> None:
        findings = self.findings
        pictures = findings.pictures if findings is not None else ()
        if len(pictures) != sum(not chart.isHidden() for chart in self.charts):
            self._split.setSizes(SPLITTER_SIZES_PX[len(pictures)])
        for index, chart in enumerate(self.charts):
            chart.setVisible(index < len(pictures))
            if index < len(pictures):
                chart.plot.set_stale(False)
                chart.show_picture(pictures[index])
        self.sheet.set_headers(list(map(translate_text, findings.head)) if findings else ())
        self.sheet.show_rows(
            [list(map(translate_text, row)) for row in findings.rows] if findings else ()
        )
        self._show_notices(findings.notices if findings is not None else ())
        self._update_buttons()
        if findings is not None:
            record = findings.question.record
            text = tr("{record}: {time:.3f} s, {n} samples")
            self.summary.setText(
                text.format(
                    record=findings.question.name, time=record.duration_s, n=len(record.time_s)
                )
            )

    def _update_buttons(self) -> None:
        no_findings_reason = None if self.findings is not None else tr("there are no figures yet")
        no_card_reason = (
            None
            if self.findings is None or self.findings.columns
            else tr("these figures are not a health card")
        )
        enable_unless(self.controls.copy, no_findings_reason, tr("Copy the figures as text"))
        enable_unless(self.controls.save, no_findings_reason, tr("Write the figures to a file"))
        tooltip = tr("Store this health card with the earlier ones of the axis")
        enable_unless(self.controls.keep, no_findings_reason or no_card_reason, tooltip)

    def _show_excitation(self, is_visible: bool) -> None:
        self._excite_scroll.setVisible(is_visible)
        self._size_notices()

    def _show_notices(self, notices: list[str] | tuple[str, ...]) -> None:
        text = "\n".join(map(translate_text, notices))
        self.notices.setPlainText(text)
        self.notices.setToolTip(text)
        self.notices.setVisible(bool(text))
        self._size_notices()

    def _size_notices(self) -> None:
        text = self.notices.toPlainText()
        available_width = (
            self.width()
            - 2 * NOTICE_MARGIN_PX
            - (0 if self._excite_scroll.isHidden() else EXCITE_WIDTH_PX)
        )
        fits = self.notices.fontMetrics().horizontalAdvance(text) < available_width
        self.notices.setFixedHeight(
            ONE_LINE_HEIGHT_PX if "\n" not in text and fits else TWO_LINES_HEIGHT_PX
        )

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the height of the notices to the new width."""
        super().resizeEvent(event)
        self._size_notices()

    def _copy(self) -> None:
        if self.findings is not None:
            QGuiApplication.clipboard().setText(to_text(self.findings, self.controls.current_view))

    def store_card(self) -> None:
        """Store the health card together with the earlier cards of its axis."""
        findings = self.findings
        if (
            findings is None
            or not findings.columns
            or self.controls.current_view is not AnalysisView.HEALTH
        ):
            return
        self.workbench.work(
            "health card",
            tr("Storing the health card …"),
            lambda: store_card(findings.question),
            lambda _: self._on_card_stored(findings.question),
        )

    def _on_card_stored(self, question: AnalysisQuestion) -> None:
        text = tr("Stored the health card of {axis}")
        self.workbench.notify(Level.GOOD, text.format(axis=question.axis))
        self._findings_by_view.pop(AnalysisView.HEALTH, None)
        if question is self._question and self.controls.current_view is AnalysisView.HEALTH:
            self._analyse()

    def _ask_save(self) -> None:
        if self.findings is None:
            return
        title, file_filter = tr("Save results"), tr("Tables (*.csv)")
        # The file gets the current findings, even if others arrive while the dialog is open.
        text = to_csv(self.findings, self.controls.current_view)
        ask_save_path(
            self,
            self.workbench,
            title,
            file_filter,
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


def _make_excite_scroll(section: QWidget) -> QScrollArea:
    scroll = make_scroll_area(section)
    scroll.setFixedWidth(EXCITE_WIDTH_PX)
    return scroll


def _make_notices() -> QPlainTextEdit:
    notices = name_widget(QPlainTextEdit(), tr("Limits of this record"))
    notices.setReadOnly(True)
    return notices
