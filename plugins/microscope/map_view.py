"""Map from above with reach, trail, places and tip: click to choose, turn the wheel to zoom."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF, QWheelEvent
from PySide6.QtWidgets import QApplication, QSizePolicy, QWidget

from rotemina.app.motion.penetration import CellOutcome
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.drawing import (
    TipProjection,
    draw_scale_bar,
    make_forbidden_area,
)
from rotemina.app.widgets.style import Theme
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.tip_map import MapPlace, PlaceKind
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import KeepOutZone, PositionBox

_HIT_RADIUS_PX = 9.0
# Margin on each side, relative to the width of the fitted contents.
_FIT_MARGIN_RATIO, _MIN_FIT_SPAN_M = 0.15, 2e-5
# Zoom factor of one notch of the wheel.
_WHEEL_FACTOR = 1.25
# The narrowest view, and the largest number of places with names. More names would overlap.
_MIN_SPAN_M, _MAX_NAMED_PLACES = 2e-6, 12
_OUTCOME_SYMBOLS = {CellOutcome.DONE: "✓", CellOutcome.FAILED: "✕", CellOutcome.SKIPPED: "–"}


class MapView(QWidget):
    """Map of places and the tip from above, x to the right and y upwards.

    Signals
    -------
    chosen(object, float, float) : a place, or None, was clicked at x and y, m.
    """

    chosen = Signal(object, float, float)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._reach: PositionBox | None = None
        self._zone: KeepOutZone | None = None
        self._trail: FloatArray = np.empty((0, 3))
        self._places: Sequence[MapPlace] = ()
        self._tip: FloatArray | None = None
        self._goal: MapPlace | None = None
        self._middle, self._span_m = np.zeros(3), 1e-3
        self._press_point: QPointF | None = None
        self._dragged = False
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setCursor(Qt.CursorShape.CrossCursor)
        self.setAccessibleName(tr("Map of the tip"))
        self.setToolTip(
            make_tooltip(
                tr(
                    "Where the tip has been, from above. ◆: saved positions; circles: cells of the "
                    "list. Red is forbidden, the frame is what the axes can reach."
                ),
                tr("Click to choose a place; nothing moves. Wheel: zoom. Drag: move the map."),
            )
        )

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the preferred size, a square."""
        return QSize(230, 230)

    def heightForWidth(self, width: int) -> int:  # noqa: N802 (Qt's name)
        """Return the width, which makes the map square."""
        return width

    def show_places(self, places: Sequence[MapPlace], goal: MapPlace | None) -> None:
        """Show places, and mark the chosen one."""
        if (places, goal) != (self._places, self._goal):
            self._places, self._goal = places, goal
            self.update()

    def show_tip(
        self,
        tip: FloatArray | None,
        trail: FloatArray,
        reach: PositionBox,
        zone: KeepOutZone | None,
    ) -> None:
        """Show the tip, its trail, the reach of the axes and the forbidden zone."""
        is_same_tip = tip is self._tip or (
            tip is not None and self._tip is not None and np.array_equal(tip, self._tip)
        )
        if is_same_tip and len(trail) == len(self._trail) and zone is self._zone:
            return
        self._tip, self._trail, self._reach, self._zone = tip, trail, reach, zone
        self.update()

    def fit(self, *, whole_reach: bool) -> None:
        """Fit the view to the whole reach of the axes, or to trail, places and tip."""
        places = np.array([place.tip_m for place in self._places]).reshape(-1, 3)
        contents = [self._trail, places, *([] if self._tip is None else [self._tip[None]])]
        points = np.vstack(contents)
        if self._reach is not None and (whole_reach or not len(points)):
            points = np.vstack([self._reach.low, self._reach.high])
        if len(points):
            low, high = points.min(axis=0), points.max(axis=0)
            self._middle = 0.5 * (low + high)
            span = float((high - low)[:2].max())
            self._span_m = max((1.0 + 2.0 * _FIT_MARGIN_RATIO) * span, _MIN_FIT_SPAN_M)
            self.update()

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of a theme."""
        self._theme = theme
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin a click or a drag."""
        if event.button() is Qt.MouseButton.LeftButton:
            self._press_point, self._dragged = event.position(), False

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Move the map along with the mouse."""
        if self._press_point is None:
            return
        offset = event.position() - self._press_point
        if self._dragged or offset.manhattanLength() >= QApplication.startDragDistance():
            scale = self._make_projection().scale
            self._middle = self._middle - np.array([offset.x(), -offset.y(), 0.0]) / scale
            self._press_point, self._dragged = event.position(), True
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Report the clicked place, unless the map was dragged."""
        pressed, self._press_point = self._press_point, None
        if pressed is not None and not self._dragged:
            x, y = self._make_projection().to_position(event.position())
            self.chosen.emit(self._find_place(event.position()), x, y)

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Zoom; the point under the mouse stays in place."""
        notches = event.angleDelta().y() / 120.0
        max_span = 4.0 * self._compute_reach_span()
        span = float(np.clip(self._span_m * _WHEEL_FACTOR**-notches, _MIN_SPAN_M, max_span))
        x, y = self._make_projection().to_position(event.position())
        anchor = np.array([x, y, self._middle[2]])
        self._middle = anchor + (self._middle - anchor) * (span / self._span_m)
        self._span_m = span
        self.update()
        event.accept()

    def _compute_reach_span(self) -> float:
        reach = self._reach
        return 1.0 if reach is None else float((reach.high - reach.low)[:2].max())

    def _find_place(self, point: QPointF) -> MapPlace | None:
        projection = self._make_projection()
        hits = [
            (distance, index)
            for index, place in enumerate(self._places)
            if (distance := (projection.to_point(np.array(place.tip_m)) - point).manhattanLength())
            <= _HIT_RADIUS_PX
        ]
        return self._places[min(hits)[1]] if hits else None

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw zone, reach, trail, places, tip and scale bar."""
        theme, projection = self._theme, self._make_projection()
        painter = QPainter(self)
        painter.setFont(self.font())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), QColor(theme.surface))
        if self._zone is not None:
            red = QColor(theme.danger)
            red.setAlpha(60)
            painter.fillPath(make_forbidden_area(self._zone, projection), red)
        if self._reach is not None:
            painter.setPen(QPen(QColor(theme.line), 1.0))
            corners = (projection.to_point(self._reach.low), projection.to_point(self._reach.high))
            painter.drawRect(QRectF(*corners).normalized())
        if len(self._trail):
            painter.setPen(QPen(QColor(theme.accent), 1.2))
            painter.drawPolyline(projection.to_points(self._trail))
        self._draw_places(painter, projection)
        if self._tip is not None:
            self._draw_tip_and_path(painter, projection, self._tip)
        draw_scale_bar(
            painter, QRectF(self.rect()).adjusted(4, 0, 0, 0), projection.scale, QColor(theme.text)
        )
        painter.end()

    def _draw_places(self, painter: QPainter, projection: TipProjection) -> None:
        theme = self._theme
        for place in self._places:
            centre = projection.to_point(np.array(place.tip_m))
            painter.setPen(QPen(QColor(theme.text), 1.2))
            painter.setBrush(QColor(theme.surface))
            if place.kind is PlaceKind.CELL:
                painter.drawEllipse(centre, 6.0, 6.0)
            else:
                corners = ((0, -5), (5, 0), (0, 5), (-5, 0))
                painter.drawPolygon(QPolygonF([centre + QPointF(*corner) for corner in corners]))
            symbol = _OUTCOME_SYMBOLS.get(CellOutcome(place.outcome), "") if place.outcome else ""
            if len(self._places) <= _MAX_NAMED_PLACES or place == self._goal or symbol:
                name = (
                    place.name
                    if len(self._places) <= _MAX_NAMED_PLACES or place == self._goal
                    else ""
                )
                text = f"{name}{symbol}"
                width = painter.fontMetrics().horizontalAdvance(text)
                is_left = centre.x() + 8.0 + width > self.width()
                painter.drawText(centre + QPointF(-8.0 - width if is_left else 8.0, 4.0), text)

    def _draw_tip_and_path(
        self, painter: QPainter, projection: TipProjection, tip: FloatArray
    ) -> None:
        theme, tip_point = self._theme, projection.to_point(tip)
        if self._goal is not None:
            goal = projection.to_point(np.array(self._goal.tip_m))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(theme.warning), 1.0, Qt.PenStyle.DashLine))
            painter.drawLine(tip_point, goal)
            painter.setPen(QPen(QColor(theme.warning), 2.0))
            painter.drawEllipse(goal, 9.0, 9.0)
        painter.setPen(QPen(QColor(theme.text), 1.5))
        painter.drawLine(tip_point - QPointF(7.0, 0.0), tip_point + QPointF(7.0, 0.0))
        painter.drawLine(tip_point - QPointF(0.0, 7.0), tip_point + QPointF(0.0, 7.0))

    def _make_projection(self) -> TipProjection:
        area = QRectF(self.rect())
        scale = max(min(area.width(), area.height()), 1.0) / self._span_m
        return TipProjection(area, self._middle, scale, 1)
