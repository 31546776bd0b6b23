"""Cards of the diagnosed axes, with the gaps of the nominal and of the corrected model."""

from math import ceil

from PySide6.QtCore import QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QAbstractButton, QButtonGroup, QSizePolicy, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.layout import make_grid
from rotemina.app.widgets.style import Theme
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.words import AXIS_VERDICTS
from rotemina.sim.comparison import format_gap
from rotemina.sim.gap.result import (
    AxisDiagnosis,
    GapShrinkage,
    GapVerdict,
)
from rotemina.sim.records import Tap

CARD_WIDTH_PX, CARD_HEIGHT_PX = 220, 96
CARD_SPACING_PX = 8
_MARGIN_PX, _LINE_HEIGHT_PX = 10, 20
_BAR_HEIGHT_PX = 14
# The symbol of each verdict, and its colour role in the theme.
_VERDICT_SYMBOLS = {
    GapVerdict.NONE: ("–", "quiet"),
    GapVerdict.EXPLAINED: ("✓", "good"),
    GapVerdict.PARTLY: ("◐", "accent"),
    GapVerdict.UNKNOWN: ("?", "warning"),
    GapVerdict.INSUFFICIENT: ("?", "warning"),
    GapVerdict.FAILED: ("✗", "danger_text"),
}


class AxisCard(QAbstractButton):
    """Card with the name and verdict of an axis, and its gap before and after the correction.

    The gap of the nominal model is drawn as an outlined bar, and the gap of the corrected model as
    a filled bar. A vertical line marks the noise floor, below which no model can reduce the gap.
    """

    def __init__(self, diagnosis: AxisDiagnosis, unit: str, theme: Theme) -> None:
        super().__init__()
        self.axis, self.theme = diagnosis.axis, theme
        self._verdict = diagnosis.verdict
        # An axis has one shrinkage for each tap with a gap; the card shows the first.
        self.shrinkage: GapShrinkage | None = (
            diagnosis.shrinkage[0] if diagnosis.shrinkage else None
        )
        self.figures = self._format_figures(unit)
        self.setCheckable(True)
        self.setMinimumWidth(CARD_WIDTH_PX)
        self.setFixedHeight(CARD_HEIGHT_PX)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.setText(get_axis_label(diagnosis.axis))
        verdict = tr(AXIS_VERDICTS[diagnosis.verdict])
        self.setAccessibleName(f"{self.text()}: {verdict}. {self.figures}")
        floor = self.shrinkage and tr("Noise floor {floor}").format(
            floor=format_gap(self.shrinkage.floor, unit)
        )
        self.setToolTip(
            make_tooltip(
                f"{self.text()}: {verdict}", self.figures, floor or "", _make_legend(self.shrinkage)
            )
        )

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size at which all texts can be read."""
        return QSize(CARD_WIDTH_PX, CARD_HEIGHT_PX)

    def compute_bars(self) -> tuple[QRectF, QRectF, float]:
        """Return the nominal bar, the corrected bar, and the x position of the noise-floor line."""
        full_bar = QRectF(
            _MARGIN_PX,
            CARD_HEIGHT_PX - _MARGIN_PX - _BAR_HEIGHT_PX - 4,
            self.width() - 2 * _MARGIN_PX,
            _BAR_HEIGHT_PX,
        )
        if self.shrinkage is None:
            return full_bar, QRectF(), 0.0
        largest = max(self.shrinkage.raw, self.shrinkage.corrected, self.shrinkage.floor) or 1.0
        nominal_bar, corrected_bar = QRectF(full_bar), QRectF(full_bar)
        nominal_bar.setWidth(max(full_bar.width() * self.shrinkage.raw / largest, 1.0))
        corrected_bar.setWidth(max(full_bar.width() * self.shrinkage.corrected / largest, 1.0))
        floor_x = full_bar.left() + full_bar.width() * self.shrinkage.floor / largest
        return nominal_bar, corrected_bar, floor_x

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the card. The chosen card has a frame of two pixels."""
        painter, theme = QPainter(self), self.theme
        frame_colour = theme.accent if self.isChecked() or self.hasFocus() else theme.line
        frame_width = 2 if self.isChecked() else 1
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(QColor(theme.raised))
        painter.setPen(QPen(QColor(frame_colour), frame_width))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 4, 4)
        line = QRect(_MARGIN_PX, 6, self.width() - 2 * _MARGIN_PX, _LINE_HEIGHT_PX)
        font = self.font()
        font.setBold(True)
        painter.setFont(font)
        self._draw_text(painter, line, self.text(), theme.text, Qt.AlignmentFlag.AlignLeft)
        symbol, role = _VERDICT_SYMBOLS[self._verdict]
        self._draw_text(painter, line, symbol, getattr(theme, role), Qt.AlignmentFlag.AlignRight)
        font.setBold(False)
        painter.setFont(font)
        line.translate(0, _LINE_HEIGHT_PX)
        self._draw_text(painter, line, self.figures, theme.text, Qt.AlignmentFlag.AlignLeft)
        if self.shrinkage is not None:
            self._draw_bars(painter)

    def _draw_bars(self, painter: QPainter) -> None:
        nominal_bar, corrected_bar, floor_x = self.compute_bars()
        theme = self.theme
        # As in the other views of the gap, the colours are those of a command and of a model.
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(theme.command), 1))
        painter.drawRect(nominal_bar)
        painter.fillRect(corrected_bar, QColor(theme.model))
        painter.setPen(QPen(QColor(theme.text), 2))
        painter.drawLine(
            round(floor_x),
            round(nominal_bar.top()) - 3,
            round(floor_x),
            round(nominal_bar.bottom()) + 3,
        )

    def _draw_text(
        self, painter: QPainter, line: QRect, text: str, colour: str, side: Qt.AlignmentFlag
    ) -> None:
        painter.setPen(QColor(colour))
        elided_text = painter.fontMetrics().elidedText(
            text, Qt.TextElideMode.ElideRight, line.width()
        )
        painter.drawText(line, int(side | Qt.AlignmentFlag.AlignVCenter), elided_text)

    def _format_figures(self, unit: str) -> str:
        if self.shrinkage is None:
            return tr(AXIS_VERDICTS[self._verdict])
        nominal_text, corrected_text = (
            format_gap(gap, unit) for gap in (self.shrinkage.raw, self.shrinkage.corrected)
        )
        return f"{nominal_text} → {corrected_text}"


class AxisCards(QWidget):
    """Grid of all cards. The operator chooses one by a click, an arrow key or Tab.

    Signals
    -------
    chosen(str) : an axis was chosen.
    """

    chosen = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.cards: tuple[AxisCard, ...] = ()
        self._columns = 0
        self._group = QButtonGroup(self)
        self._grid = make_grid(on=self, margins=0)
        self._grid.setSpacing(CARD_SPACING_PX)
        self.setAccessibleName(tr("Axis"))
        self._group.buttonToggled.connect(
            lambda card, is_checked: self.chosen.emit(card.axis) if is_checked else None
        )

    @property
    def current(self) -> str | None:
        """The chosen axis, or None."""
        card = self._group.checkedButton()
        return card.axis if isinstance(card, AxisCard) else None

    def show_answer(self, answer: DiagnosisAnswer) -> None:
        """Show the axes of an answer and choose the most important one."""
        for card in self.cards:
            self._group.removeButton(card)
            self._grid.removeWidget(card)
            card.hide()
            card.deleteLater()
        diagnoses = answer.diagnosis.axes.values()
        self.cards = tuple(
            AxisCard(diagnosis, answer.unit(diagnosis.axis, _find_tap(diagnosis)), self._theme)
            for diagnosis in diagnoses
        )
        for card in self.cards:
            self._group.addButton(card)
        self._columns = 0
        self._arrange()
        self.choose(answer.first_axis)

    def choose(self, axis: str) -> None:
        """Choose an axis."""
        for card in self.cards:
            if card.axis == axis:
                card.setChecked(True)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        for card in self.cards:
            card.theme = theme
            card.update()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the width of one card, and the height of all rows at the current width."""
        rows = ceil(len(self.cards) / self._columns) if self._columns else 0
        return QSize(
            CARD_WIDTH_PX, max(rows * (CARD_HEIGHT_PX + CARD_SPACING_PX) - CARD_SPACING_PX, 0)
        )

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Arrange the cards for the new width."""
        super().resizeEvent(event)
        self._arrange()

    def _arrange(self) -> None:
        columns = compute_columns(len(self.cards), self.width())
        if columns == self._columns:
            return
        self._columns = columns
        for index, card in enumerate(self.cards):
            self._grid.addWidget(card, index // columns, index % columns)
        for column in range(self._grid.columnCount()):
            self._grid.setColumnStretch(column, 1 if column < columns else 0)
        self.updateGeometry()


def compute_columns(count: int, width: int) -> int:
    """Return the number of columns that gives the fewest rows, filled about equally.

    ``width`` is the available width in pixels.
    """
    max_columns = max((width + CARD_SPACING_PX) // (CARD_WIDTH_PX + CARD_SPACING_PX), 1)
    rows = max(ceil(count / max_columns), 1)
    return max(ceil(count / rows), 1)


def _find_tap(diagnosis: AxisDiagnosis) -> Tap:
    """Return the tap whose gap the card shows."""
    return diagnosis.shrinkage[0].tap if diagnosis.shrinkage else Tap.MEAS


def _make_legend(shrinkage: GapShrinkage | None) -> str:
    if shrinkage is None:
        return ""
    return tr("Nominal → corrected, on validation data")
