"""View of how far the gap of an axis shrinks: a bar chart, and the gap over time."""

from collections.abc import Sequence
from math import isfinite
from typing import NamedTuple

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QSplitter, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.layout import make_column
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_plain_label
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer.answer_quality import describe_change
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.trace_view import TraceView
from rotemina.plugins.gap.answer.words import effect_title
from rotemina.sim.gap.result import GapShrinkage
from rotemina.sim.units import (
    format_percent,
    format_percent_interval,
    format_quantity,
)

WATERFALL_TOOLTIP = mark(
    "Rms of the gap on validation data: with the original model, with its own "
    "parameters re-tuned, then with one effect after the other. No model gets "
    "below the noise floor; the black-box model shows about how far any "
    "explanation can get."
)

# If a bar is shorter than this fraction of the nominal bar, it also shows the factor by which the
# gap has shrunk.
_MAX_SHORT_BAR_RATIO = 0.1

_MAX_ROW_HEIGHT_PX = 24
_LINE_TEXT_GAP_PX = 6
_TEXT_MARGIN_PX = 8


class GapBar(NamedTuple):
    """Bar of the chart, with its size (positive) also as text, and its colour role in the theme."""

    name: str
    size: float
    text: str
    role: str


class GapBarChart(QWidget):
    """Chart of horizontal bars. ``lines`` are vertical lines across all of them."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.bars: tuple[GapBar, ...] = ()
        self.lines: tuple[GapBar, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size at which all texts can be read."""
        return QSize(360, _MAX_ROW_HEIGHT_PX * (len(self.bars) + 1))

    def show_bars(self, bars: Sequence[GapBar], lines: Sequence[GapBar]) -> None:
        """Replace the bars and lines."""
        self.bars, self.lines = tuple(bars), tuple(lines)
        texts = [f"{bar.name} {bar.text}" for bar in (*bars, *lines)]
        self.setAccessibleName(tr("Gap: {bars}").format(bars=", ".join(texts)))
        self.setToolTip(make_tooltip(*texts))
        self.update()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the names at the left, the bars with their sizes, and the line texts below."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.surface))
        if not self.bars:
            return
        metrics = self.fontMetrics()
        left = max(metrics.horizontalAdvance(bar.name) for bar in self.bars) + _TEXT_MARGIN_PX
        right = max(metrics.horizontalAdvance(bar.text) for bar in self.bars) + 2 * _TEXT_MARGIN_PX
        width = max(self.width() - left - right, 20)
        height = min(
            (self.height() - metrics.height() - _LINE_TEXT_GAP_PX) / len(self.bars),
            _MAX_ROW_HEIGHT_PX,
        )
        largest = max((bar.size for bar in (*self.bars, *self.lines)), default=0.0) or 1.0
        for row, bar in enumerate(self.bars):
            bar_rect = QRectF(left, row * height + 2, bar.size / largest * width, height - 4)
            self._draw_bar(painter, bar, bar_rect, left)
        bottom = height * len(self.bars)
        text_x = left
        for line in self.lines:
            x = left + line.size / largest * width
            painter.setPen(QPen(QColor(getattr(self._theme, line.role)), 2, Qt.PenStyle.DashLine))
            painter.drawLine(round(x), 0, round(x), round(bottom))
            text = f"┆ {line.name} {line.text}"
            painter.drawText(round(text_x), round(bottom + metrics.ascent() + 2), text)
            text_x += metrics.horizontalAdvance(text) + 2 * _TEXT_MARGIN_PX

    def _draw_bar(self, painter: QPainter, bar: GapBar, bar_rect: QRectF, left: float) -> None:
        painter.fillRect(bar_rect, QColor(getattr(self._theme, bar.role)))
        painter.setPen(QColor(self._theme.text))
        vertical = Qt.AlignmentFlag.AlignVCenter
        name_rect = QRectF(0, bar_rect.top(), left - _TEXT_MARGIN_PX, bar_rect.height())
        painter.drawText(name_rect, vertical | Qt.AlignmentFlag.AlignRight, bar.name)
        text_rect = QRectF(
            bar_rect.right() + _TEXT_MARGIN_PX, bar_rect.top(), 400, bar_rect.height()
        )
        painter.drawText(text_rect, vertical | Qt.AlignmentFlag.AlignLeft, bar.text)


class ShrinkageView(QSplitter):
    """View with the bar chart on the left and the gap of one record on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self.title = make_plain_label(quiet=False)
        self.title.setToolTip(tr(WATERFALL_TOOLTIP))
        self.bars = GapBarChart(theme)
        self.traces = TraceView(theme)
        left = QWidget()
        make_column(self.title, (self.bars, 1), on=left, margins=(4, 0, 0, 0), spacing=2)
        self.addWidget(left)
        self.addWidget(self.traces)
        self.setSizes([470, 470])

    def show_axis(self, answer: DiagnosisAnswer, axis: str) -> None:
        """Show how far the gap of an axis shrinks."""
        shrinkages = answer.diagnosis.axes[axis].shrinkage
        self._show_bars(shrinkages[0] if shrinkages else None, answer)
        traces = answer.traces[axis]
        is_shrinkage_tap = [bool(shrinkages) and trace.tap is shrinkages[0].tap for trace in traces]
        self.traces.show_traces(
            [(f"{answer.names[trace.number]}: {trace.tap}", trace) for trace in traces],
            is_shrinkage_tap.index(True) if any(is_shrinkage_tap) else 0,
        )

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self.bars.set_theme(theme)
        self.traces.set_theme(theme)

    def _show_bars(self, shrinkage: GapShrinkage | None, answer: DiagnosisAnswer) -> None:
        if shrinkage is None:
            self.title.setText(tr("This axis has no gap to close."))
            self.bars.show_bars((), ())
            return
        unit = answer.unit(shrinkage.axis, shrinkage.tap)
        sizes = [
            (tr("nominal"), shrinkage.raw, "command"),
            (tr("re-tuned"), shrinkage.retuned, "command"),
        ]
        sizes += [(f"+ {effect_title(step.effect)}", step.rms, "model") for step in shrinkage.steps]
        sizes.append((tr("corrected"), shrinkage.corrected, "model"))
        lines = [(tr("floor"), shrinkage.floor, "good")]
        if shrinkage.ceiling is not None:
            lines.append((tr("black box"), shrinkage.ceiling, "warning"))
        self.title.setText(
            tr("{axis} {tap}, rms on unseen data: closed {share} ({interval})").format(
                axis=get_axis_label(shrinkage.axis),
                tap=shrinkage.tap,
                share=format_percent(shrinkage.closed),
                interval=format_percent_interval(shrinkage.closed_interval),
            )
        )
        self.bars.show_bars(_make_bars(sizes, unit, shrinkage.raw), _make_bars(lines, unit))


def _make_bars(
    sizes: list[tuple[str, float, str]], unit: str, nominal: float | None = None
) -> list[GapBar]:
    """Return bars from tuples of name, size (SI) and colour role; omit sizes that are not finite.

    With the ``nominal`` size, a very short bar also shows the factor by which the gap has shrunk.
    """
    bars = []
    for name, size, role in sizes:
        if isfinite(size):
            text = format_quantity(size, unit)
            if nominal is not None and 0.0 < size < _MAX_SHORT_BAR_RATIO * nominal:
                text = f"{text}, {describe_change(nominal / size)}"
            bars.append(GapBar(name, size, text, role))
    return bars
