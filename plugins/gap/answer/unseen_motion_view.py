"""View of how far the gap shrinks on an unseen motion: a table, and the gap over time."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QSplitter, QStackedWidget, QWidget

from rotemina.app.language import get_axis_label, translate
from rotemina.app.widgets.layout import make_column
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import TextTable, make_hint, make_plain_label
from rotemina.app.workbench import RUN_GAP_LABEL
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer.answer_quality import describe_change
from rotemina.plugins.gap.answer.trace_view import TraceView
from rotemina.plugins.gap.answer.unseen_motion_reduction import (
    MIN_SAME_RATIO,
    GapReduction,
    UnseenMotionResult,
)
from rotemina.plugins.gap.answer.verdict_advice import NO_UNSEEN_MOTION
from rotemina.sim.comparison import format_gap
from rotemina.sim.messages import format_rounded

RESULT_HEADINGS = (
    mark("record"),
    mark("axis, signal"),
    mark("nominal"),
    mark("corrected"),
    mark("unseen motion"),
    "95 %",
    mark("floor"),
)

# The table shows the results of this many records. Older results are dropped.
_MAX_RECORDS = 20


class UnseenMotionView(QStackedWidget):
    """View with the table on the left and the chosen gap on the right, or a hint if it is empty."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.latest: UnseenMotionResult | None = None
        # Results for the current answer, newest first.
        self.results: list[UnseenMotionResult] = []
        self._theme = theme
        self.title = make_plain_label(quiet=False)
        self.title.setToolTip(
            tr(
                "Rms of measurement minus model, including offset, during motion and 0.5 s "
                "after it; intervals by block bootstrap"
            )
        )
        self.table = TextTable(
            tr("How far the gap shrinks on the new motion"), [tr(text) for text in RESULT_HEADINGS]
        )
        self.table.currentCellChanged.connect(lambda row, *_: self._choose(row))
        self.traces = TraceView(theme)
        left = QWidget()
        make_column(self.title, (self.table, 1), on=left, margins=0, spacing=2)
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(left)
        split.addWidget(self.traces)
        split.setSizes([580, 400])
        self.addWidget(make_hint(tr(NO_UNSEEN_MOTION)))
        self.addWidget(split)

    def show_result(self, proof: UnseenMotionResult | None) -> None:
        """Add the result of a record, or clear all results if it is None."""
        self.latest = proof
        if proof is None:
            self.results.clear()
        else:
            other_results = [result for result in self.results if result.name != proof.name]
            self.results = [proof, *other_results][:_MAX_RECORDS]
        self._refill()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self._refill()
        self.traces.set_theme(theme)

    def _refill(self) -> None:
        rows = [(proof.name, reduction) for proof in self.results for reduction in proof.reductions]
        self.setCurrentIndex(1 if rows else 0)
        self.title.setText(translate("shell", RUN_GAP_LABEL) if rows else "")
        worse_colour = QColor(self._theme.danger_text)
        self.table.show_rows(
            [_make_row(name, reduction) for name, reduction in rows],
            [worse_colour if reduction.is_worse else None for _, reduction in rows],
        )
        self.traces.show_traces(
            [
                (
                    f"{name}: {get_axis_label(reduction.trace.axis)} {reduction.trace.tap}",
                    reduction.trace,
                )
                for name, reduction in rows
            ]
        )

    def _choose(self, row: int) -> None:
        if 0 <= row < self.table.rowCount():
            self.traces.choose(row)


def _make_row(name: str, reduction: GapReduction) -> tuple[str, ...]:
    trace = reduction.trace
    low, high = reduction.interval
    return (
        name,
        f"{get_axis_label(trace.axis)} {trace.tap}",
        format_gap(reduction.before, trace.unit),
        format_gap(reduction.after, trace.unit),
        _describe_reduction(reduction),
        f"{format_rounded(low, 3)} … {format_rounded(high, 3)}",
        format_gap(trace.floor, trace.unit),
    )


def _describe_reduction(reduction: GapReduction) -> str:
    if reduction.is_worse:
        return tr("worse: {change}").format(change=describe_change(reduction.factor))
    if reduction.trace.is_corrected and reduction.factor > 1.0 / MIN_SAME_RATIO:
        return tr("better: {change}").format(change=describe_change(reduction.factor))
    return tr("about the same")
