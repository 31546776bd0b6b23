"""Comparison of model and machine over a run: figures of each tap, and traces of the chosen one."""

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QPushButton, QSplitter, QWidget

from rotemina.app.display_units import label
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.gap_words import RUN, size
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.plot import LINES, SignalPlot
from rotemina.app.shell.report_files import RUN_REPORT, RUN_REPORT_TIP, ask_run_report
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Run, Workbench
from rotemina.app.widgets.controls import allow
from rotemina.app.widgets.labels import legend, plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.table import Table
from rotemina.app.widgets.when_seen import WhenSeen
from rotemina.plugins.comparison import mark, tr
from rotemina.sim.comparison.comparison import TapComparison
from rotemina.sim.comparison.gap import GapFigure, gap_text
from rotemina.sim.comparison.table import HEAD, cells
from rotemina.sim.quantities import scale_of
from rotemina.sim.records.record import Tap

EMPTY = mark("Play a trajectory or open a record of the real machine to compare it with the model.")
COLUMNS = (
    mark("signal"),
    RUN,
    mark("without offset"),
    mark("nominal"),
    mark("noise floor"),
    mark("rel. error"),
    mark("delay"),
)


class ComparisonPanel(Panel):
    """The last run: the real record beside the model's answer to the same commands."""

    title = marked("panels", "Comparison of model and machine")
    area = Area.BOTTOM
    order = 20
    help_page = "comparison.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.open = QPushButton(tr("Open record …"))
        self.open.setToolTip(tr("Compare a record of the real machine with the model (Ctrl+O)"))
        self.open.clicked.connect(lambda: self.main_window.ask_record())
        self.save = QPushButton(tr("Save record …"))
        self.save.clicked.connect(lambda: self.main_window.ask_save())
        self.report = QPushButton(translate("shell", RUN_REPORT))
        self.report.clicked.connect(lambda: ask_run_report(self, workbench))
        self._allow(tr("no record is open; play a trajectory or open one"))
        self.summary = plain_text(tr(EMPTY), quiet=False, wrap=True)
        self.table = Table(
            tr("Signals and their gaps"),
            [translate("shell" if name is RUN else "comparison", name) for name in COLUMNS],
            row_height=24,
        )
        self.table.itemSelectionChanged.connect(self._draw)
        self.signals, self.gap = SignalPlot(workbench.theme), SignalPlot(workbench.theme)
        self.signals.add_curve("model", LINES["model"])
        self.signals.add_curve("real", LINES["measured"])
        self.gap.add_curve("gap", LINES["gap"])
        self.signals_title, self.gap_title = QLabel(), QLabel()
        self.gap.setXLink(self.signals)
        self.signals.show_times(True)
        self.gap.show_times(True)
        self._lay_out()
        offer_in_palette(self.open, self.save, self.report, safe_while_hidden=True)
        self._show_gaps = WhenSeen(self, self._fill)
        workbench.run_changed.connect(self._show_run)
        workbench.theme_changed.connect(self._use_theme)

    def _lay_out(self) -> None:
        buttons = in_row(self.open, self.save, self.report, (self.summary, 1))
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(self.table)
        split.addWidget(_titled(self.signals_title, self.signals))
        split.addWidget(_titled(self.gap_title, self.gap))
        split.setSizes([620, 220, 220])
        in_column(buttons, (split, 1), on=self, margins=(10, 8, 10, 8))

    def _show_run(self, run: Run) -> None:
        record = run.record
        state = "" if run.completed else tr(", stopped early")
        self.summary.setText(
            tr("{name}: {duration:.3f} s, {n} samples{state}").format(
                name=run.name, duration=record.duration_s, n=len(record.time_s), state=state
            )
            + (f"  ·  {run.model_id}" if run.model_id else "")
        )
        self._allow(None)
        self._show_gaps()

    def _allow(self, why_not: str | None) -> None:
        """Allow what needs a record."""
        allow(self.save, why_not, tr("Save the current record to a file (Ctrl+S)"))
        allow(self.report, why_not, translate("shell", RUN_REPORT_TIP))

    def _fill(self) -> None:
        run = self.workbench.run
        if run is None:
            return
        self.table.show_rows(
            [_row(tap, run.gaps[tap.axis, Tap(tap.tap)]) for tap in run.comparison.taps]
        )
        worst = _worst(run.comparison.taps)
        self.table.selectRow(worst)
        self.table.scrollToItem(self.table.item(worst, 0))
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
        scale = scale_of(tap.unit, float(abs(real).max()))
        gap = scale_of(tap.unit, tap.peak)
        self.signals.show_signal("real", time_s, scale(real))
        self.signals.show_signal("model", time_s, scale(model))
        self.gap.show_signal("gap", time_s, gap(real - model))
        self.signals.set_time(0.0, max(record.duration_s, 1e-9))
        named = ((tr("real"), "real"), (tr("model in use"), "model"))
        self.signals_title.setText(
            f"{escape(label(tap.axis))} {tap.tap} [{scale.symbol}]: "
            f"{legend(self.workbench.theme, named)}"
        )
        self.gap_title.setText(tr("real − model [{symbol}]").format(symbol=gap.symbol))
        self.signals.enableAutoRange(axis="y")
        self.gap.enableAutoRange(axis="y")

    def _use_theme(self, theme: Theme) -> None:
        self.signals.set_theme(theme)
        self.gap.set_theme(theme)
        self._draw()


def _worst(taps: Sequence[TapComparison]) -> int:
    """Return the tap whose gap is the largest share of its range: the one to look at first."""
    shares = [tap.share_of_range or 0.0 for tap in taps]
    return shares.index(max(shares))


def _titled(title: QLabel, plot: SignalPlot) -> QWidget:
    box = QWidget()
    in_column(title, (plot, 1), on=box, margins=(4, 0, 0, 0), spacing=2)
    return box


def _row(tap: TapComparison, figure: GapFigure | None) -> list[str]:
    named = dict(zip(HEAD, cells(tap), strict=True))
    beside = (figure.without_offset, figure.nominal) if figure is not None else (None, None)
    return [
        f"{label(tap.axis)} {tap.tap}",
        size(figure, tap.unit),
        *(gap_text(one, tap.unit) for one in beside),
        *(named[column] for column in COLUMNS[-3:]),
    ]
