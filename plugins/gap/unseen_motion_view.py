"""How far the gap shrinks on a new motion: figures with intervals, and the gap over time."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QSplitter, QStackedWidget, QWidget

from rotemina.app.display_units import label
from rotemina.app.shell.gap_words import RUN
from rotemina.app.shell.language import translate
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.labels import hint, plain_text
from rotemina.app.widgets.layouts import in_column
from rotemina.app.widgets.table import Table
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer_quality import change
from rotemina.plugins.gap.trace_view import TraceView
from rotemina.plugins.gap.unseen_motion_reduction import SAME, Proof, Shrunk
from rotemina.plugins.gap.verdict_advice import NO_PROOF
from rotemina.sim.comparison.gap import gap_text
from rotemina.sim.quantities import rounded

HEAD = (
    mark("record"),
    mark("axis, signal"),
    mark("nominal"),
    mark("corrected"),
    mark("unseen motion"),
    "95 %",
    mark("floor"),
)

_MOST = 20  # records that are shown


class ProofView(QStackedWidget):
    """Figures on the left, the chosen gap on the right; before there are any, what to do."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.proof: Proof | None = None
        self.proofs: list[Proof] = []  # of the answer in sight, the newest first
        self._theme = theme
        self.title = plain_text(quiet=False)
        self.title.setToolTip(
            tr(
                "Rms of measurement minus model, including offset, during motion and 0.5 s "
                "after it; intervals by block bootstrap"
            )
        )
        self.table = Table(
            tr("How far the gap shrinks on the new motion"), [tr(text) for text in HEAD]
        )
        self.table.currentCellChanged.connect(lambda row, *_: self._choose(row))
        self.traces = TraceView(theme)
        left = QWidget()
        in_column(self.title, (self.table, 1), on=left, margins=0, spacing=2)
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(left)
        split.addWidget(self.traces)
        split.setSizes([580, 400])
        self.addWidget(hint(tr(NO_PROOF)))
        self.addWidget(split)

    def show_proof(self, proof: Proof | None) -> None:
        """Add what was worked out of a record; None: there is nothing yet."""
        self.proof = proof
        if proof is None:
            self.proofs.clear()
        else:
            others = [one for one in self.proofs if one.name != proof.name]
            self.proofs = [proof, *others][:_MOST]
        self._show()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self._show()
        self.traces.set_theme(theme)

    def _show(self) -> None:
        rows = [(proof.name, one) for proof in self.proofs for one in proof.shrunk]
        self.setCurrentIndex(1 if rows else 0)
        self.title.setText(translate("shell", RUN) if rows else "")
        worse = QColor(self._theme.danger_text)
        self.table.show_rows(
            [_row(name, one) for name, one in rows],
            [worse if one.worse else None for _, one in rows],
        )
        self.traces.show_traces(
            [(f"{name}: {label(one.trace.axis)} {one.trace.tap}", one.trace) for name, one in rows]
        )

    def _choose(self, row: int) -> None:
        if 0 <= row < self.table.rowCount():
            self.traces.choose(row)


def _row(name: str, one: Shrunk) -> tuple[str, ...]:
    trace = one.trace
    low, high = one.interval
    return (
        name,
        f"{label(trace.axis)} {trace.tap}",
        gap_text(one.before, trace.unit),
        gap_text(one.after, trace.unit),
        _better_or_worse(one),
        f"{rounded(low, 3)} … {rounded(high, 3)}",
        gap_text(trace.floor, trace.unit),
    )


def _better_or_worse(one: Shrunk) -> str:
    if one.worse:
        return tr("worse: {change}").format(change=change(one.times))
    if one.trace.changed and one.times > 1.0 / SAME:
        return tr("better: {change}").format(change=change(one.times))
    return tr("about the same")
