"""How far the gap of an axis shrinks: bars, and the gap before and after over time."""

from collections.abc import Sequence
from math import isfinite
from typing import NamedTuple

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QSplitter, QWidget

from rotemina.app.display_units import label
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer_quality import change
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.trace_view import TraceView
from rotemina.plugins.gap.words import effect_title
from rotemina.sim.gap.diagnosis import Shrinkage
from rotemina.sim.quantities import amount, percent, percents

TIP = mark(
    "Rms of the gap on validation data: with the original model, with its own "
    "parameters re-tuned, then with one effect after the other. No model gets "
    "below the noise floor; the black-box model shows about how far any "
    "explanation can get."
)

_SHORT = 0.1  # of the nominal gap's bar


_ROW = 24  # at most, high
_GAP = 6
_ROOM = 8  # beside texts


class Bar(NamedTuple):
    """A size (above 0), its name and how it is written; ``role`` is a colour of the theme."""

    name: str
    size: float
    text: str
    role: str


class Bars(QWidget):
    """Bars one below the other; ``lines`` stand upright across all of them."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.bars: tuple[Bar, ...] = ()
        self.lines: tuple[Bar, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the room in which everything can be read."""
        return QSize(360, _ROW * (len(self.bars) + 1))

    def show_bars(self, bars: Sequence[Bar], lines: Sequence[Bar]) -> None:
        """Draw bars and lines in place of the last."""
        self.bars, self.lines = tuple(bars), tuple(lines)
        told = [f"{bar.name} {bar.text}" for bar in (*bars, *lines)]
        self.setAccessibleName(tr("Gap: {bars}").format(bars=", ".join(told)))
        self.setToolTip(plain_tip(*told))
        self.update()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw names on the left, bars with their texts, and lines with theirs below."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.surface))
        if not self.bars:
            return
        metrics = self.fontMetrics()
        left = max(metrics.horizontalAdvance(bar.name) for bar in self.bars) + _ROOM
        right = max(metrics.horizontalAdvance(bar.text) for bar in self.bars) + 2 * _ROOM
        width = max(self.width() - left - right, 20)
        height = min((self.height() - metrics.height() - _GAP) / len(self.bars), _ROW)
        high = max((bar.size for bar in (*self.bars, *self.lines)), default=0.0) or 1.0
        for row, bar in enumerate(self.bars):
            place = QRectF(left, row * height + 2, bar.size / high * width, height - 4)
            self._draw_bar(painter, bar, place, left)
        bottom = height * len(self.bars)
        at = left
        for line in self.lines:
            x = left + line.size / high * width
            painter.setPen(QPen(QColor(getattr(self._theme, line.role)), 2, Qt.PenStyle.DashLine))
            painter.drawLine(round(x), 0, round(x), round(bottom))
            text = f"┆ {line.name} {line.text}"
            painter.drawText(round(at), round(bottom + metrics.ascent() + 2), text)
            at += metrics.horizontalAdvance(text) + 2 * _ROOM

    def _draw_bar(self, painter: QPainter, bar: Bar, place: QRectF, left: float) -> None:
        painter.fillRect(place, QColor(getattr(self._theme, bar.role)))
        painter.setPen(QColor(self._theme.text))
        across = Qt.AlignmentFlag.AlignVCenter
        name = QRectF(0, place.top(), left - _ROOM, place.height())
        painter.drawText(name, across | Qt.AlignmentFlag.AlignRight, bar.name)
        behind = QRectF(place.right() + _ROOM, place.top(), 400, place.height())
        painter.drawText(behind, across | Qt.AlignmentFlag.AlignLeft, bar.text)


class ShrinkageView(QSplitter):
    """The waterfall on the left, the gap of one record on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self.title = plain_text(quiet=False)
        self.title.setToolTip(tr(TIP))
        self.bars = Bars(theme)
        self.traces = TraceView(theme)
        left = QWidget()
        in_column(self.title, (self.bars, 1), on=left, margins=(4, 0, 0, 0), spacing=2)
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
            self.title.setText(tr("This axis has no gap to close."))
            self.bars.show_bars((), ())
            return
        unit = answer.unit(told.axis, told.tap)
        sizes = [(tr("nominal"), told.raw, "command"), (tr("re-tuned"), told.retuned, "command")]
        sizes += [(f"+ {effect_title(step.effect)}", step.rms, "model") for step in told.steps]
        sizes.append((tr("corrected"), told.corrected, "model"))
        lines = [(tr("floor"), told.floor, "good")]
        if told.ceiling is not None:
            lines.append((tr("black box"), told.ceiling, "warning"))
        self.title.setText(
            tr("{axis} {tap}, rms on unseen data: closed {share} ({interval})").format(
                axis=label(told.axis),
                tap=told.tap,
                share=percent(told.closed),
                interval=percents(told.closed_interval),
            )
        )
        self.bars.show_bars(_bars(sizes, unit, told.raw), _bars(lines, unit))


def _bars(sizes: list[tuple[str, float, str]], unit: str, raw: float | None = None) -> list[Bar]:
    """Return bars with their figures; one too short to read says how many times it shrank."""
    made = []
    for name, size, role in sizes:
        if isfinite(size):
            text = amount(size, unit)
            if raw is not None and 0.0 < size < _SHORT * raw:
                text = f"{text}, {change(raw / size)}"
            made.append(Bar(name, size, text, role))
    return made
