"""Comparison of model and machine in one run: a table of all taps, and plots of one tap."""

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QPushButton, QSplitter, QWidget

from rotemina.app.language import get_axis_label, marked, translate
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.shell.records import (
    RUN_REPORT_LABEL,
    RUN_REPORT_TIP,
    ask_run_report,
)
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.widgets.drawing import LINE_STYLES, SignalPlot
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import OnVisible, Theme
from rotemina.app.widgets.text import TextTable, make_colour_legend, make_plain_label
from rotemina.app.workbench import RUN_GAP_LABEL, ComparedRun, Workbench, format_gap_size
from rotemina.plugins.comparison import mark, tr
from rotemina.sim.comparison import TABLE_HEAD, GapFigure, TapComparison, format_cells, format_gap
from rotemina.sim.records import Tap
from rotemina.sim.units import choose_scale

EMPTY_TEXT = mark(
    "Play a trajectory or open a record of the real machine to compare it with the model."
)
COLUMN_HEADINGS = (
    mark("signal"),
    RUN_GAP_LABEL,
    mark("without offset"),
    mark("nominal"),
    mark("noise floor"),
    mark("rel. error"),
    mark("delay"),
)


class ComparisonPanel(Panel):
    """Panel that compares the record of the last run with the model's response."""

    title = marked("panels", "Comparison of model and machine")
    area = PanelArea.BOTTOM
    order = 20
    help_page = "comparison.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.open = QPushButton(tr("Open record …"))
        self.open.setToolTip(tr("Compare a record of the real machine with the model (Ctrl+O)"))
        self.open.clicked.connect(lambda: self.main_window.ask_record())
        self.save = QPushButton(tr("Save record …"))
        self.save.clicked.connect(lambda: self.main_window.ask_save())
        self.report = QPushButton(translate("shell", RUN_REPORT_LABEL))
        self.report.clicked.connect(lambda: ask_run_report(self, workbench))
        self._update_buttons(tr("no record is open; play a trajectory or open one"))
        self.summary = make_plain_label(tr(EMPTY_TEXT), quiet=False, wrap=True)
        self.table = TextTable(
            tr("Signals and their gaps"),
            [
                translate("shell" if name is RUN_GAP_LABEL else "comparison", name)
                for name in COLUMN_HEADINGS
            ],
            row_height=24,
        )
        self.table.itemSelectionChanged.connect(self._draw)
        self.signals, self.gap = SignalPlot(workbench.theme), SignalPlot(workbench.theme)
        self.signals.add_curve("model", LINE_STYLES["model"])
        self.signals.add_curve("real", LINE_STYLES["measured"])
        self.gap.add_curve("gap", LINE_STYLES["gap"])
        self.signals_title, self.gap_title = QLabel(), QLabel()
        self.gap.setXLink(self.signals)
        self.signals.show_times(True)
        self.gap.show_times(True)
        self._lay_out()
        offer_in_palette(self.open, self.save, self.report, safe_while_hidden=True)
        self._fill_when_seen = OnVisible(self, self._fill_table)
        workbench.run_changed.connect(self._show_run)
        workbench.theme_changed.connect(self._use_theme)

    def _lay_out(self) -> None:
        buttons = make_row(self.open, self.save, self.report, (self.summary, 1))
        splitter = QSplitter(Qt.Orientation.Horizontal)
        splitter.addWidget(self.table)
        splitter.addWidget(_with_title(self.signals_title, self.signals))
        splitter.addWidget(_with_title(self.gap_title, self.gap))
        splitter.setSizes([620, 220, 220])
        make_column(buttons, (splitter, 1), on=self, margins=(10, 8, 10, 8))

    def _show_run(self, run: ComparedRun) -> None:
        record = run.record
        state = "" if run.completed else tr(", stopped early")
        self.summary.setText(
            tr("{name}: {duration:.3f} s, {n} samples{state}").format(
                name=run.name, duration=record.duration_s, n=len(record.time_s), state=state
            )
            + (f"  ·  {run.model_id}" if run.model_id else "")
        )
        self._update_buttons(None)
        self._fill_when_seen()

    def _update_buttons(self, objection: str | None) -> None:
        enable_unless(self.save, objection, tr("Save the current record to a file (Ctrl+S)"))
        enable_unless(self.report, objection, translate("shell", RUN_REPORT_TIP))

    def _fill_table(self) -> None:
        run = self.workbench.run
        if run is None:
            return
        self.table.show_rows(
            [_make_row(tap, run.gaps[tap.axis, Tap(tap.tap)]) for tap in run.comparison.taps]
        )
        worst_row = _find_worst_tap(run.comparison.taps)
        self.table.selectRow(worst_row)
        self.table.scrollToItem(self.table.item(worst_row, 0))
        self._draw()

    def _draw(self) -> None:
        run, row = self.workbench.run, self.table.currentRow()
        if run is None or not 0 <= row < len(run.comparison.taps):
            return
        tap = run.comparison.taps[row]
        record = run.record
        real = record.signal(tap.axis, Tap(tap.tap))
        model = run.comparison.response.signal(tap.axis, Tap(tap.tap))
        time_s = record.time_s - record.time_s[0]
        scale = choose_scale(tap.unit, float(abs(real).max()))
        gap_scale = choose_scale(tap.unit, tap.peak)
        self.signals.show_signal("real", time_s, scale(real))
        self.signals.show_signal("model", time_s, scale(model))
        self.gap.show_signal("gap", time_s, gap_scale(real - model))
        self.signals.set_time_span(0.0, max(record.duration_s, 1e-9))
        names_and_roles = ((tr("real"), "real"), (tr("model in use"), "model"))
        self.signals_title.setText(
            f"{escape(get_axis_label(tap.axis))} {tap.tap} [{scale.symbol}]: "
            f"{make_colour_legend(self.workbench.theme, names_and_roles)}"
        )
        self.gap_title.setText(tr("real − model [{symbol}]").format(symbol=gap_scale.symbol))
        self.signals.enableAutoRange(axis="y")
        self.gap.enableAutoRange(axis="y")

    def _use_theme(self, theme: Theme) -> None:
        self.signals.set_theme(theme)
        self.gap.set_theme(theme)
        self._draw()


def _find_worst_tap(taps: Sequence[TapComparison]) -> int:
    """Return the index of the tap whose gap is largest relative to its range."""
    relative_gaps = [tap.share_of_range or 0.0 for tap in taps]
    return relative_gaps.index(max(relative_gaps))


def _with_title(title: QLabel, plot: SignalPlot) -> QWidget:
    box = QWidget()
    make_column(title, (plot, 1), on=box, margins=(4, 0, 0, 0), spacing=2)
    return box


def _make_row(tap: TapComparison, figure: GapFigure | None) -> list[str]:
    cells_by_heading = dict(zip(TABLE_HEAD, format_cells(tap), strict=True))
    gap_sizes = (figure.without_offset, figure.nominal) if figure is not None else (None, None)
    return [
        f"{get_axis_label(tap.axis)} {tap.tap}",
        format_gap_size(figure, tap.unit),
        *(format_gap(gap_size, tap.unit) for gap_size in gap_sizes),
        *(cells_by_heading[column] for column in COLUMN_HEADINGS[-3:]),
    ]
