"""A cell for each diagnosed axis: how large its gap was, and how large it is with the causes in."""

from math import ceil

from PySide6.QtCore import QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QAbstractButton, QButtonGroup, QSizePolicy, QWidget

from rotemina.app.display_units import label
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.layouts import in_grid
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.words import AXIS_VERDICTS
from rotemina.sim.comparison.gap import gap_text
from rotemina.sim.gap.diagnosis import AxisDiagnosis, Shrinkage, Verdict
from rotemina.sim.records.record import Tap

WIDTH, HEIGHT = 220, 96
SPACING = 8
_MARGIN, _LINE = 10, 20
_BAR = 14  # px, high
_MARKS = {
    Verdict.NONE: ("–", "quiet"),
    Verdict.EXPLAINED: ("✓", "good"),
    Verdict.PARTLY: ("◐", "accent"),
    Verdict.UNKNOWN: ("?", "warning"),
    Verdict.INSUFFICIENT: ("?", "warning"),
}


class AxisCell(QAbstractButton):
    """Name and verdict, the gap before and after in figures, and both as bars from zero.

    The nominal gap is an outline of the whole width, the corrected one is filled; an upright
    mark is the noise floor, below which no model gets.
    """

    def __init__(self, one: AxisDiagnosis, unit: str, theme: Theme) -> None:
        super().__init__()
        self.axis, self.theme = one.axis, theme
        self._verdict = one.verdict
        self.told: Shrinkage | None = one.shrinkage[0] if one.shrinkage else None
        self.figures = self._figures(unit)
        self.setCheckable(True)
        self.setMinimumWidth(WIDTH)
        self.setFixedHeight(HEIGHT)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.setText(label(one.axis))
        verdict = tr(AXIS_VERDICTS[one.verdict])
        self.setAccessibleName(f"{self.text()}: {verdict}. {self.figures}")
        floor = self.told and tr("Noise floor {floor}").format(
            floor=gap_text(self.told.floor, unit)
        )
        self.setToolTip(
            plain_tip(f"{self.text()}: {verdict}", self.figures, floor or "", _unseen(self.told))
        )

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the room in which all of it is read."""
        return QSize(WIDTH, HEIGHT)

    def bars(self) -> tuple[QRectF, QRectF, float]:
        """Return where the nominal and the corrected bar are, and where the floor's mark is."""
        whole = QRectF(_MARGIN, HEIGHT - _MARGIN - _BAR - 4, self.width() - 2 * _MARGIN, _BAR)
        if self.told is None:
            return whole, QRectF(), 0.0
        high = max(self.told.raw, self.told.corrected, self.told.floor) or 1.0
        before, after = QRectF(whole), QRectF(whole)
        before.setWidth(max(whole.width() * self.told.raw / high, 1.0))
        after.setWidth(max(whole.width() * self.told.corrected / high, 1.0))
        return before, after, whole.left() + whole.width() * self.told.floor / high

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the cell; the chosen one has a frame of two pixels."""
        painter, theme = QPainter(self), self.theme
        edge = theme.accent if self.isChecked() or self.hasFocus() else theme.line
        width = 2 if self.isChecked() else 1
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(QColor(theme.raised))
        painter.setPen(QPen(QColor(edge), width))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 4, 4)
        line = QRect(_MARGIN, 6, self.width() - 2 * _MARGIN, _LINE)
        font = self.font()
        font.setBold(True)
        painter.setFont(font)
        self._write(painter, line, self.text(), theme.text, Qt.AlignmentFlag.AlignLeft)
        mark, role = _MARKS[self._verdict]
        self._write(painter, line, mark, getattr(theme, role), Qt.AlignmentFlag.AlignRight)
        font.setBold(False)
        painter.setFont(font)
        line.translate(0, _LINE)
        self._write(painter, line, self.figures, theme.text, Qt.AlignmentFlag.AlignLeft)
        if self.told is not None:
            self._draw_bars(painter)

    def _draw_bars(self, painter: QPainter) -> None:
        before, after, floor = self.bars()
        theme = self.theme
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(theme.command), 1))
        painter.drawRect(before)
        painter.fillRect(after, QColor(theme.model))
        painter.setPen(QPen(QColor(theme.text), 2))
        painter.drawLine(
            round(floor), round(before.top()) - 3, round(floor), round(before.bottom()) + 3
        )

    def _write(
        self, painter: QPainter, line: QRect, text: str, colour: str, side: Qt.AlignmentFlag
    ) -> None:
        painter.setPen(QColor(colour))
        cut = painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, line.width())
        painter.drawText(line, int(side | Qt.AlignmentFlag.AlignVCenter), cut)

    def _figures(self, unit: str) -> str:
        if self.told is None:
            return tr(AXIS_VERDICTS[self._verdict])
        before, after = (gap_text(size, unit) for size in (self.told.raw, self.told.corrected))
        return f"{before} → {after}"


class AxisCells(QWidget):
    """All cells, side by side as far as they fit; one is chosen by click, arrow or Tab.

    Signals
    -------
    chosen(str) : the axis.
    """

    chosen = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.cells: tuple[AxisCell, ...] = ()
        self._columns = 0
        self._group = QButtonGroup(self)
        self._grid = in_grid(on=self, margins=0)
        self._grid.setSpacing(SPACING)
        self.setAccessibleName(tr("Axis"))
        self._group.buttonToggled.connect(
            lambda cell, on: self.chosen.emit(cell.axis) if on else None
        )

    @property
    def current(self) -> str | None:
        """The axis of which the page speaks."""
        cell = self._group.checkedButton()
        return cell.axis if isinstance(cell, AxisCell) else None

    def show_answer(self, answer: Answer) -> None:
        """Show the axes of an answer, the one with most to say chosen."""
        for cell in self.cells:
            self._group.removeButton(cell)
            self._grid.removeWidget(cell)
            cell.hide()
            cell.deleteLater()
        found = answer.diagnosis.axes.values()
        self.cells = tuple(
            AxisCell(one, answer.unit(one.axis, _tap(one)), self._theme) for one in found
        )
        for cell in self.cells:
            self._group.addButton(cell)
        self._columns = 0
        self._place()
        self.choose(answer.first_axis)

    def choose(self, axis: str) -> None:
        """Let the page speak of another axis."""
        for cell in self.cells:
            if cell.axis == axis:
                cell.setChecked(True)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        for cell in self.cells:
            cell.theme = theme
            cell.update()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for the height of the rows at this width, and for no width of many cells."""
        rows = ceil(len(self.cells) / self._columns) if self._columns else 0
        return QSize(WIDTH, max(rows * (HEIGHT + SPACING) - SPACING, 0))

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Place the cells again."""
        super().resizeEvent(event)
        self._place()

    def _place(self) -> None:
        columns = columns_for(len(self.cells), self.width())
        if columns == self._columns:
            return
        self._columns = columns
        for number, cell in enumerate(self.cells):
            self._grid.addWidget(cell, number // columns, number % columns)
        for column in range(self._grid.columnCount()):
            self._grid.setColumnStretch(column, 1 if column < columns else 0)
        self.updateGeometry()


def columns_for(count: int, width: int) -> int:
    """Return how many cells stand side by side: as few rows as fit, all about as long."""
    fitting = max((width + SPACING) // (WIDTH + SPACING), 1)
    rows = max(ceil(count / fitting), 1)
    return max(ceil(count / rows), 1)


def _tap(one: AxisDiagnosis) -> Tap:
    return one.shrinkage[0].tap if one.shrinkage else Tap.MEAS


def _unseen(told: Shrinkage | None) -> str:
    if told is None:
        return ""
    return tr("Nominal → corrected, on validation data")
