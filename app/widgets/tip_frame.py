"""Positions of the tip in a drawing from above or from the side: forbidden areas, a scale bar."""

from math import floor, log10

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QPolygonF

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.quantities import rounded

_STEPS = (5.0, 2.0, 1.0)
_UNITS = ((1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))
_BAR_SHARE, _BAR_HEIGHT = 0.3, 16.0  # of the width, and px


def draw_scale(painter: QPainter, area: QRectF, scale: float, colour: QColor) -> None:
    """Draw a bar of a round length at the lower left of an area; ``scale`` in px/m."""
    length, text = round_length(_BAR_SHARE * area.width() / scale)
    left, line = area.left() + 1.0, area.bottom() - 0.5 * _BAR_HEIGHT
    painter.setPen(QPen(colour, 2.0))
    painter.drawLine(QPointF(left, line), QPointF(left + length * scale, line))
    painter.drawText(
        QRectF(left + length * scale + 7.0, area.bottom() - _BAR_HEIGHT, 80.0, _BAR_HEIGHT),
        Qt.AlignmentFlag.AlignVCenter,
        text,
    )


class TipFrame:
    """Where points (3,), m, are in an area: x to the right, the axis ``up`` upwards."""

    def __init__(self, area: QRectF, middle: FloatArray, scale: float, up: int) -> None:
        self.area, self.scale, self.up = area, scale, up
        self._middle = middle

    def point(self, place: FloatArray) -> QPointF:
        """Return where a place (3,) is drawn."""
        away = self.scale * (place - self._middle)
        return self.area.center() + QPointF(float(away[0]), -float(away[self.up]))

    def place(self, point: QPointF) -> tuple[float, float]:
        """Return x and the axis ``up``, m, of a point of the area."""
        away = (point - self.area.center()) / self.scale
        return float(self._middle[0]) + away.x(), float(self._middle[self.up]) - away.y()

    def points(self, places: FloatArray) -> QPolygonF:
        """Return many (n, 3) at once; of those within half a pixel of each other, one."""
        away = self.scale * (places[:, [0, self.up]] - self._middle[[0, self.up]])
        pixel = np.rint(2.0 * away)
        kept = np.ones(len(away), dtype=bool)
        kept[1:] = (pixel[1:] != pixel[:-1]).any(axis=1)
        middle = self.area.center()
        return QPolygonF([QPointF(middle.x() + x, middle.y() - y) for x, y in away[kept].tolist()])


def forbidden(zone: KeepOutZone, frame: TipFrame) -> QPainterPath:
    """Return what of a view the tip must not be in."""
    allowed, area = QPainterPath(), frame.area
    middle = frame.point(zone.middle)
    far = area.width() + area.height() + abs(middle.x()) + abs(middle.y())
    reach = min(zone.radius * frame.scale, far)
    if frame.up == 1:
        allowed.addEllipse(middle, reach, reach)
    else:
        top, bottom = (
            frame.point(np.array([*zone.middle[:2], height])).y() if np.isfinite(height) else edge
            for height, edge in ((zone.high, area.top() - far), (zone.low, area.bottom() + far))
        )
        allowed.addRect(QRectF(middle.x() - reach, top, 2.0 * reach, bottom - top))
    everything = QPainterPath()
    everything.addRect(area)
    return everything.subtracted(allowed)


def round_length(most: float) -> tuple[float, str]:
    """Return the greatest round length, m, that is not more, and how it is written."""
    length = round_down(most)
    unit, name = next((one for one in _UNITS if length >= 0.9999 * one[0]), _UNITS[-1])
    return length, f"{rounded(length / unit)} {name}"


def round_down(value: float) -> float:
    """Return the greatest 1, 2 or 5 times a power of ten that is not more."""
    power = 10.0 ** floor(log10(value))
    return next(step * power for step in _STEPS if step * power <= value * (1 + 1e-12))
