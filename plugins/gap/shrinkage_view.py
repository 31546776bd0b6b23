"""How far the gap of an axis shrinks: bars, and the gap before and after over time."""

from math import isfinite

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QSplitter, QVBoxLayout, QWidget

from rotemina.app.display import label
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.theme import Theme
from rotemina.plugins.gap.answer import Answer
from rotemina.plugins.gap.bars import Bar, Bars
from rotemina.plugins.gap.trace_view import TraceView
from rotemina.plugins.gap.words import effect_title
from rotemina.sim.gap.diagnosis import Shrinkage
from rotemina.sim.gap.report.quantities import amount, percent, percents

TIP = marked(
    "gap",
    "Rms of the gap on data that no fit has seen: as the model is, with its own parameters "
    "re-tuned, then with one effect after the other. No model gets below the noise floor; the "
    "black box is what no explanation can be expected to beat by far.",
)


class ShrinkageView(QSplitter):
    """The waterfall on the left, the gap of one record on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.PlainText)
        self.title.setToolTip(translate("gap", TIP))
        self.bars = Bars(theme)
        self.traces = TraceView(theme)
        left = QWidget()
        column = QVBoxLayout(left)
        column.setContentsMargins(4, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.title)
        column.addWidget(self.bars, 1)
        self.addWidget(left)
        self.addWidget(self.traces)
        self.setSizes([470, 470])

    def show_axis(self, answer: Answer, axis: str) -> None:
        """Show how far the gap of an axis shrinks."""
        told = answer.diagnosis.axes[axis].shrinkage
        self._show_bars(told[0] if told else None, answer)
        own = answer.traces[axis]
        wanted = [bool(told) and trace.tap is told[0].tap for trace in own]
        self.traces.show_traces(
            [(f"{answer.names[trace.number]}: {trace.tap}", trace) for trace in own],
            wanted.index(True) if any(wanted) else 0,
        )

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self.bars.set_theme(theme)
        self.traces.set_theme(theme)

    def _show_bars(self, told: Shrinkage | None, answer: Answer) -> None:
        if told is None:
            self.title.setText(translate("gap", "No gap to close was found on this axis."))
            self.bars.show_bars((), ())
            return
        unit = answer.unit(told.axis, told.tap)
        sizes = [
            (translate("gap", "nominal"), told.raw, "command"),
            (translate("gap", "re-tuned"), told.retuned, "command"),
        ]
        sizes += [(f"+ {effect_title(step.effect)}", step.rms, "model") for step in told.steps]
        sizes.append((translate("gap", "corrected"), told.corrected, "model"))
        lines = [(translate("gap", "floor"), told.floor, "good")]
        if told.ceiling is not None:
            lines.append((translate("gap", "black box"), told.ceiling, "warning"))
        self.title.setText(
            translate(
                "gap", "{axis} {tap}, rms on unseen data: closed {share} ({interval})"
            ).format(
                axis=label(told.axis),
                tap=told.tap,
                share=percent(told.closed),
                interval=percents(told.closed_interval),
            )
        )
        self.bars.show_bars(_bars(sizes, unit), _bars(lines, unit))


def _bars(sizes: list[tuple[str, float, str]], unit: str) -> list[Bar]:
    return [
        Bar(name, size, amount(size, unit), role) for name, size, role in sizes if isfinite(size)
    ]
