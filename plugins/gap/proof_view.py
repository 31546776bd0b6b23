"""How far the gap shrinks on a new motion: figures with intervals, and the gap over time."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QLabel, QSplitter, QStackedWidget, QVBoxLayout, QWidget

from rotemina.app.display import label
from rotemina.app.shell.gap_words import RUN
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.theme import Theme
from rotemina.plugins.gap.advice import NO_PROOF
from rotemina.plugins.gap.headline import change
from rotemina.plugins.gap.hint import hint
from rotemina.plugins.gap.proof import Proof, Shrunk
from rotemina.plugins.gap.table import Table
from rotemina.plugins.gap.trace_view import TraceView
from rotemina.sim.comparison.gap import gap_text

HEAD = (
    marked("gap", "axis, tap"),
    marked("gap", "nominal"),
    marked("gap", "with what was found"),
    marked("gap", "change"),
    "95 %",
    marked("gap", "floor"),
)


class ProofView(QStackedWidget):
    """Figures on the left, the chosen gap on the right; before there are any, what to do."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.proof: Proof | None = None
        self._theme = theme
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.PlainText)
        self.title.setToolTip(
            translate(
                "gap",
                "Rms of what was measured less what the model says, its offset included, over "
                "what moves and 0.5 s after; intervals by drawing blocks of the record anew",
            )
        )
        self.table = Table(translate("gap", "How far the gap shrinks on the new motion"), HEAD)
        self.table.currentCellChanged.connect(lambda row, *_: self._choose(row))
        self.traces = TraceView(theme)
        left = QWidget()
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.title)
        column.addWidget(self.table, 1)
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(left)
        split.addWidget(self.traces)
        split.setSizes([520, 420])
        self.addWidget(hint(translate("gap", NO_PROOF)))
        self.addWidget(split)

    def show_proof(self, proof: Proof | None) -> None:
        """Show what was worked out, or what to do where there is nothing yet."""
        self.proof = proof
        self.setCurrentIndex(0 if proof is None else 1)
        shrunk = () if proof is None else proof.shrunk
        self.title.setText("" if proof is None else f"{proof.name}: {translate('shell', RUN)}")
        worse = QColor(self._theme.danger_text)
        self.table.show_rows(
            [_row(one) for one in shrunk], [worse if one.worse else None for one in shrunk]
        )
        self.traces.show_traces(
            [(f"{label(one.trace.axis)} {one.trace.tap}", one.trace) for one in shrunk]
        )
        if shrunk:
            self.table.selectRow(0)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.show_proof(self.proof)
        self.traces.set_theme(theme)

    def _choose(self, row: int) -> None:
        if self.proof is not None and 0 <= row < len(self.proof.shrunk):
            self.traces.choose(row)


def _row(one: Shrunk) -> tuple[str, ...]:
    trace = one.trace
    low, high = one.interval
    return (
        f"{label(trace.axis)} {trace.tap}",
        gap_text(one.before, trace.unit),
        gap_text(one.after, trace.unit),
        change(one.times),
        f"{low:.3g} … {high:.3g}",
        gap_text(trace.floor, trace.unit),
    )
