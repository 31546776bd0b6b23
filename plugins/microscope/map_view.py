"""The map from above: reach, trail, places, the tip; click to choose, wheel to zoom."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF, QWheelEvent
from PySide6.QtWidgets import QApplication, QSizePolicy, QWidget

from rotemina.app.motion.penetration.cell_list import Outcome
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.tip_frame import TipFrame, draw_scale, forbidden
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.tip_map import MapPlace, PlaceKind
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.kinematics.workspace import Box

_HIT = 9.0  # px from a place
_MARGIN, _LEAST_M = 0.15, 2e-5  # about what is shown: a share of it, and m
_STEP = 1.25  # of the wheel
_NEAREST_M, _LABELS = 2e-6, 12  # least width; from so many places on, names are left out
_SIGNS = {Outcome.DONE: "✓", Outcome.FAILED: "✕", Outcome.SKIPPED: "–"}


class MapView(QWidget):
    """Places of the tip from above, x to the right and y upwards.

    Signals
    -------
    chosen(object, float, float) : a place, or None, was clicked at x and y, m.
    """

    chosen = Signal(object, float, float)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._reach: Box | None = None
        self._zone: KeepOutZone | None = None
        self._trail: FloatArray = np.empty((0, 3))
        self._places: Sequence[MapPlace] = ()
        self._tip: FloatArray | None = None
        self._goal: MapPlace | None = None
        self._middle, self._span_m = np.zeros(3), 1e-3
        self._pressed: QPointF | None = None  # where the left button went down
        self._dragged = False
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setCursor(Qt.CursorShape.CrossCursor)
        self.setAccessibleName(tr("Map of the tip"))
        self.setToolTip(
            plain_tip(
                tr(
                    "Where the tip has been, from above. ◆: saved positions; circles: cells of the "
                    "list. Red is forbidden, the frame is what the axes can reach."
                ),
                tr("Click to choose a place; nothing moves. Wheel: zoom. Drag: move the map."),
            )
        )

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for a square."""
        return QSize(230, 230)

    def heightForWidth(self, width: int) -> int:  # noqa: N802 (Qt's name)
        """Be square."""
        return width

    # --- what is shown ----------------------------------------------------------------------------

    def show_places(self, places: Sequence[MapPlace], goal: MapPlace | None) -> None:
        """Show places, and the one that is chosen."""
        if (places, goal) != (self._places, self._goal):
            self._places, self._goal = places, goal
            self.update()

    def show_tip(
        self, tip: FloatArray | None, trail: FloatArray, reach: Box, zone: KeepOutZone | None
    ) -> None:
        """Show where the tip is and was, what it can reach, and what is forbidden."""
        same = tip is self._tip or (
            tip is not None and self._tip is not None and np.array_equal(tip, self._tip)
        )
        if same and len(trail) == len(self._trail) and zone is self._zone:
            return
        self._tip, self._trail, self._reach, self._zone = tip, trail, reach, zone
        self.update()

    def fit(self, *, whole: bool) -> None:
        """Show all of the reach, or all of trail and places."""
        places = np.array([one.tip_m for one in self._places]).reshape(-1, 3)
        own = [self._trail, places, *([] if self._tip is None else [self._tip[None]])]
        seen = np.vstack(own)
        if self._reach is not None and (whole or not len(seen)):
            seen = np.vstack([self._reach.low, self._reach.high])
        if len(seen):
            low, high = seen.min(axis=0), seen.max(axis=0)
            self._middle = 0.5 * (low + high)
            span = float((high - low)[:2].max())
            self._span_m = max((1.0 + 2.0 * _MARGIN) * span, _LEAST_M)
            self.update()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    # --- mouse ------------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin a click or a drag."""
        if event.button() is Qt.MouseButton.LeftButton:
            self._pressed, self._dragged = event.position(), False

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Move the map along with the mouse."""
        if self._pressed is None:
            return
        away = event.position() - self._pressed
        if self._dragged or away.manhattanLength() >= QApplication.startDragDistance():
            scale = self._frame().scale
            self._middle = self._middle - np.array([away.x(), -away.y(), 0.0]) / scale
            self._pressed, self._dragged = event.position(), True
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Choose what was clicked."""
        pressed, self._pressed = self._pressed, None
        if pressed is not None and not self._dragged:
            x, y = self._frame().place(event.position())
            self.chosen.emit(self._place_at(event.position()), x, y)

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Come nearer or go farther; what is under the mouse stays there."""
        turns = event.angleDelta().y() / 120.0
        widest = 4.0 * self._span_of_reach()
        span = float(np.clip(self._span_m * _STEP**-turns, _NEAREST_M, widest))
        x, y = self._frame().place(event.position())
        under = np.array([x, y, self._middle[2]])
        self._middle = under + (self._middle - under) * (span / self._span_m)
        self._span_m = span
        self.update()
        event.accept()

    def _span_of_reach(self) -> float:
        reach = self._reach
        return 1.0 if reach is None else float((reach.high - reach.low)[:2].max())

    def _place_at(self, point: QPointF) -> MapPlace | None:
        """Return the nearest place that is hit."""
        frame = self._frame()
        near = [
            (away, number)
            for number, one in enumerate(self._places)
            if (away := (frame.point(np.array(one.tip_m)) - point).manhattanLength()) <= _HIT
        ]
        return self._places[min(near)[1]] if near else None

    # --- painting ---------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw all of it."""
        theme, frame = self._theme, self._frame()
        painter = QPainter(self)
        painter.setFont(self.font())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), QColor(theme.surface))
        if self._zone is not None:
            red = QColor(theme.danger)
            red.setAlpha(60)
            painter.fillPath(forbidden(self._zone, frame), red)
        if self._reach is not None:
            painter.setPen(QPen(QColor(theme.line), 1.0))
            ends = (frame.point(self._reach.low), frame.point(self._reach.high))
            painter.drawRect(QRectF(*ends).normalized())
        if len(self._trail):
            painter.setPen(QPen(QColor(theme.accent), 1.2))
            painter.drawPolyline(frame.points(self._trail))
        self._draw_places(painter, frame)
        if self._tip is not None:
            self._draw_way(painter, frame, self._tip)
        draw_scale(
            painter, QRectF(self.rect()).adjusted(4, 0, 0, 0), frame.scale, QColor(theme.text)
        )
        painter.end()

    def _draw_places(self, painter: QPainter, frame: TipFrame) -> None:
        theme = self._theme
        for one in self._places:
            at = frame.point(np.array(one.tip_m))
            painter.setPen(QPen(QColor(theme.text), 1.2))
            painter.setBrush(QColor(theme.surface))
            if one.kind is PlaceKind.CELL:
                painter.drawEllipse(at, 6.0, 6.0)
            else:
                corners = ((0, -5), (5, 0), (0, 5), (-5, 0))
                painter.drawPolygon(QPolygonF([at + QPointF(*corner) for corner in corners]))
            sign = _SIGNS.get(Outcome(one.outcome), "") if one.outcome else ""
            if len(self._places) <= _LABELS or one == self._goal or sign:
                named = one.name if len(self._places) <= _LABELS or one == self._goal else ""
                text = f"{named}{sign}"
                wide = painter.fontMetrics().horizontalAdvance(text)
                left = at.x() + 8.0 + wide > self.width()
                painter.drawText(at + QPointF(-8.0 - wide if left else 8.0, 4.0), text)

    def _draw_way(self, painter: QPainter, frame: TipFrame, tip: FloatArray) -> None:
        """Draw the tip, and the way to what is chosen."""
        theme, at = self._theme, frame.point(tip)
        if self._goal is not None:
            goal = frame.point(np.array(self._goal.tip_m))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(theme.warning), 1.0, Qt.PenStyle.DashLine))
            painter.drawLine(at, goal)
            painter.setPen(QPen(QColor(theme.warning), 2.0))
            painter.drawEllipse(goal, 9.0, 9.0)
        painter.setPen(QPen(QColor(theme.text), 1.5))
        painter.drawLine(at - QPointF(7.0, 0.0), at + QPointF(7.0, 0.0))
        painter.drawLine(at - QPointF(0.0, 7.0), at + QPointF(0.0, 7.0))

    def _frame(self) -> TipFrame:
        area = QRectF(self.rect())
        scale = max(min(area.width(), area.height()), 1.0) / self._span_m
        return TipFrame(area, self._middle, scale, 1)
