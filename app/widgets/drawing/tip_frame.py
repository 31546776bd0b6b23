"""Drawing of tip positions from above or from the side, with forbidden areas and a scale bar."""

from math import floor, log10

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QPolygonF

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import KeepOutZone
from rotemina.sim.messages import format_rounded

_ROUND_STEPS = (5.0, 2.0, 1.0)
_UNITS = ((1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))
# Largest share of the area's width that the scale bar takes.
_MAX_BAR_SHARE = 0.3
_BAR_HEIGHT_PX = 16.0


def draw_scale_bar(painter: QPainter, area: QRectF, scale: float, colour: QColor) -> None:
    """Draw a bar of a round length at the lower left of an area; ``scale`` is in px/m."""
    length, text = find_round_length(_MAX_BAR_SHARE * area.width() / scale)
    left, line_y = area.left() + 1.0, area.bottom() - 0.5 * _BAR_HEIGHT_PX
    painter.setPen(QPen(colour, 2.0))
    painter.drawLine(QPointF(left, line_y), QPointF(left + length * scale, line_y))
    painter.drawText(
        QRectF(left + length * scale + 7.0, area.bottom() - _BAR_HEIGHT_PX, 80.0, _BAR_HEIGHT_PX),
        Qt.AlignmentFlag.AlignVCenter,
        text,
    )


class TipProjection:
    """Projection of points (3,), m, onto an area: x to the right, axis number ``up`` upwards."""

    def __init__(self, area: QRectF, middle: FloatArray, scale: float, up: int) -> None:
        self.area, self.scale, self.up = area, scale, up
        self._middle = middle

    def to_point(self, position: FloatArray) -> QPointF:
        """Return where a position (3,), m, is drawn."""
        offset = self.scale * (position - self._middle)
        return self.area.center() + QPointF(float(offset[0]), -float(offset[self.up]))

    def to_position(self, point: QPointF) -> tuple[float, float]:
        """Return the x and ``up`` coordinates, m, of a point in the area."""
        offset = (point - self.area.center()) / self.scale
        return float(self._middle[0]) + offset.x(), float(self._middle[self.up]) - offset.y()

    def to_points(self, positions: FloatArray) -> QPolygonF:
        """Return where positions (n, 3), m, are drawn.

        Of successive positions in the same half pixel only the first is drawn.
        """
        offsets = self.scale * (positions[:, [0, self.up]] - self._middle[[0, self.up]])
        half_pixels = np.rint(2.0 * offsets)
        mask = np.ones(len(offsets), dtype=bool)
        mask[1:] = (half_pixels[1:] != half_pixels[:-1]).any(axis=1)
        middle = self.area.center()
        return QPolygonF(
            [QPointF(middle.x() + x, middle.y() - y) for x, y in offsets[mask].tolist()]
        )


def make_forbidden_area(zone: KeepOutZone, frame: TipProjection) -> QPainterPath:
    """Return the part of a view in which the tip must not be."""
    allowed, area = QPainterPath(), frame.area
    middle = frame.to_point(zone.middle)
    beyond_edge = area.width() + area.height() + abs(middle.x()) + abs(middle.y())
    radius = min(zone.radius * frame.scale, beyond_edge)
    if frame.up == 1:
        allowed.addEllipse(middle, radius, radius)
    else:
        top, bottom = (
            frame.to_point(np.array([*zone.middle[:2], height])).y()
            if np.isfinite(height)
            else edge
            for height, edge in (
                (zone.high, area.top() - beyond_edge),
                (zone.low, area.bottom() + beyond_edge),
            )
        )
        allowed.addRect(QRectF(middle.x() - radius, top, 2.0 * radius, bottom - top))
    whole_view = QPainterPath()
    whole_view.addRect(area)
    return whole_view.subtracted(allowed)


def find_round_length(max_length: float) -> tuple[float, str]:
    """Return the largest round length, m, up to a limit, and its text."""
    length = round_down(max_length)
    unit, name = next(
        (candidate for candidate in _UNITS if length >= 0.9999 * candidate[0]), _UNITS[-1]
    )
    return length, f"{format_rounded(length / unit)} {name}"


def round_down(value: float) -> float:
    """Return the largest 1, 2 or 5 times a power of ten that does not exceed a value."""
    power = 10.0 ** floor(log10(value))
    return next(step * power for step in _ROUND_STEPS if step * power <= value * (1 + 1e-12))
