"""Drawing over the picture: overlays, scale bar, crosshair, and notices about the camera."""

from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QPainter, QPen, QPolygonF

from rotemina.app.microscope import ScaleSource
from rotemina.app.widgets.drawing import find_round_length, round_down
from rotemina.app.widgets.style import Theme
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.feed_notice import FeedNotice
from rotemina.plugins.microscope.geometry import Viewport
from rotemina.plugins.microscope.overlays import (
    OverlayCross,
    OverlayLine,
    OverlayRing,
    OverlayShape,
    OverlayStyle,
)
from rotemina.sim.messages import format_rounded

# Largest length of the bar, relative to the width of the widget.
_MAX_LENGTH_RATIO = 0.3
# These colours are drawn over a picture, not over the window. They are therefore the same in both
# themes. Colour-blind people can tell them apart.
STYLE_COLOURS = {
    OverlayStyle.TIP: "#ffd23f",
    OverlayStyle.LOST: "#ff6b6b",
    OverlayStyle.GHOST: "#4cc9ff",
    OverlayStyle.TARGET: "#ffffff",
    OverlayStyle.REACHED: "#7fe08f",
    OverlayStyle.MISSED: "#ff6b6b",
    OverlayStyle.PATH: "#e0a3ff",
    OverlayStyle.NANO: "#9ad1ff",
    OverlayStyle.CELL: "#7fe08f",
    OverlayStyle.AHEAD: "#7fe08f",
    OverlayStyle.MEASURE: "#ffb86b",
}
_HALO_COLOUR = QColor(0, 0, 0, 150)
# The outer and the inner end of each arm of a cross, as distances from the centre.
_CROSS_OUTER_PX, _CROSS_INNER_PX = 11.0, 3.0
# A smaller ring would be hidden by its cross.
_MIN_RING_RADIUS_PX = 4.0
_MARGIN_PX = 10.0


class ScaleBar(NamedTuple):
    """Scale bar: its length, screen px, its text and a remark."""

    length_px: float
    text: str
    remark: str = ""


def make_scale_bar(
    pixel_m: float | None, source: ScaleSource, zoom: float, width: float
) -> ScaleBar:
    """Return a bar of at most 30 % of ``width``, screen px.

    The length is given in pixels if the pixel size is unknown.
    """
    max_picture_px = _MAX_LENGTH_RATIO * width / zoom
    if pixel_m is None:
        count = max(round_down(max_picture_px), 1.0)
        return ScaleBar(count * zoom, f"{format_rounded(count, 6)} px", tr("not calibrated"))
    length_m, text = find_round_length(max_picture_px * pixel_m)
    remark = tr("from the robot file") if source is ScaleSource.ROBOT_FILE else ""
    return ScaleBar(length_m / pixel_m * zoom, text, remark)


def draw_shapes(painter: QPainter, viewport: Viewport, shapes: Sequence[OverlayShape]) -> None:
    """Draw overlays, each with a dark halo so that it is visible on any picture."""
    for shape in shapes:
        colour = QColor(STYLE_COLOURS[shape.style])
        for pen in (QPen(_HALO_COLOUR, 3.5), QPen(colour, 1.5)):
            if isinstance(shape, OverlayLine) and shape.dashed:
                pen.setStyle(Qt.PenStyle.DashLine)
            painter.setPen(pen)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            _draw_shape(painter, viewport, shape)
        if isinstance(shape, OverlayLine | OverlayCross) and shape.label:
            # The label of a line is below its end, so that it does not cover the label of a cross.
            is_cross = isinstance(shape, OverlayCross)
            point = QPointF(*viewport.to_screen(*(shape.at if is_cross else shape.points[-1])))
            offset = QPointF(
                _CROSS_OUTER_PX + 2.0,
                -5.0 if is_cross else _CROSS_OUTER_PX + painter.fontMetrics().ascent(),
            )
            draw_text(painter, point + offset, shape.label, colour)


def _draw_shape(painter: QPainter, viewport: Viewport, shape: OverlayShape) -> None:
    if isinstance(shape, OverlayLine):
        line = QPolygonF([QPointF(*viewport.to_screen(*point)) for point in shape.points])
        if shape.closed:
            painter.drawPolygon(line)
        else:
            painter.drawPolyline(line)
        return
    centre = QPointF(*viewport.to_screen(*shape.at))
    if isinstance(shape, OverlayRing):
        radius = shape.radius * viewport.zoom
        if radius >= _MIN_RING_RADIUS_PX:
            painter.drawEllipse(centre, radius, radius)
        return
    for direction in (QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)):
        painter.drawLine(
            QLineF(centre + _CROSS_INNER_PX * direction, centre + _CROSS_OUTER_PX * direction)
        )


def draw_crosshair(painter: QPainter, viewport: Viewport) -> None:
    """Draw lines through the centre of the picture."""
    x, y = viewport.to_screen(*viewport.picture_centre)
    for pen in (QPen(_HALO_COLOUR, 2.0), QPen(QColor(255, 255, 255, 170), 0.8)):
        painter.setPen(pen)
        painter.drawLine(QLineF(0.0, y, viewport.width, y))
        painter.drawLine(QLineF(x, 0.0, x, viewport.height))


def draw_scale_bar(painter: QPainter, area: QRectF, bar: ScaleBar) -> None:
    """Draw the scale bar in the lower right corner."""
    right, bottom = area.right() - _MARGIN_PX, area.bottom() - _MARGIN_PX
    line = QLineF(right - bar.length_px, bottom, right, bottom)
    for pen in (QPen(_HALO_COLOUR, 7.0), QPen(QColor("white"), 4.0)):
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(pen)
        painter.drawLine(line)
    text = bar.text if not bar.remark else f"{bar.text}  ({bar.remark})"
    width = painter.fontMetrics().horizontalAdvance(text)
    draw_text(painter, QPointF(right - width, bottom - 8.0), text, QColor("white"))


def draw_badge(painter: QPainter, area: QRectF, feed_notice: FeedNotice, theme: Theme) -> None:
    """Draw state, rate and age in the upper left corner."""
    metrics = painter.fontMetrics()
    box = QRectF(
        area.left() + _MARGIN_PX,
        area.top() + _MARGIN_PX,
        metrics.horizontalAdvance(feed_notice.badge) + 16.0,
        metrics.height() + 6.0,
    )
    colour = QColor(_find_tone_colour(theme, feed_notice.tone))
    painter.setPen(QPen(colour, 1.0))
    surface = QColor(theme.surface)
    surface.setAlpha(225)
    painter.setBrush(surface)
    painter.drawRoundedRect(box, 8.0, 8.0)
    painter.setPen(colour)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, feed_notice.badge)


def draw_notice(painter: QPainter, area: QRectF, feed_notice: FeedNotice, theme: Theme) -> None:
    """Grey and hatch an outdated picture, and write title and reason over it."""
    if feed_notice.veiled:
        shade = QColor(theme.window)
        shade.setAlpha(150)
        painter.fillRect(area, shade)
        painter.fillRect(area, QBrush(QColor(theme.quiet), Qt.BrushStyle.BDiagPattern))
    if not feed_notice.title:
        return
    font, title_font = painter.font(), QFont(painter.font())
    title_font.setPixelSize(22)
    title_font.setBold(True)
    text_area = QRectF(0.0, 0.0, max(min(area.width() - 40.0, 460.0), 60.0), area.height())
    flags = Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignHCenter
    painter.setFont(title_font)
    title_box = painter.boundingRect(text_area, int(flags), feed_notice.title)
    painter.setFont(font)
    reason_box = painter.boundingRect(text_area, int(flags), feed_notice.reason)
    height = title_box.height() + (reason_box.height() + 6.0 if feed_notice.reason else 0.0)
    box = QRectF(0.0, 0.0, text_area.width() + 24.0, height + 24.0)
    box.moveCenter(area.center())
    painter.setPen(QPen(QColor(_find_tone_colour(theme, feed_notice.tone)), 2.0))
    painter.setBrush(QColor(theme.surface))
    painter.drawRoundedRect(box, 6.0, 6.0)
    inner = box.adjusted(12.0, 12.0, -12.0, -12.0)
    painter.setPen(QColor(_find_tone_colour(theme, feed_notice.tone)))
    painter.setFont(title_font)
    painter.drawText(inner, int(flags), feed_notice.title)
    painter.setFont(font)
    painter.setPen(QColor(theme.text))
    painter.drawText(
        inner.adjusted(0.0, title_box.height() + 6.0, 0.0, 0.0), int(flags), feed_notice.reason
    )


def draw_text(painter: QPainter, start: QPointF, text: str, colour: QColor) -> None:
    """Draw a line of text on a dark background. Its base line begins at ``start``."""
    metrics = painter.fontMetrics()
    box = QRectF(metrics.boundingRect(text)).translated(start).adjusted(-3.0, -1.0, 3.0, 1.0)
    painter.fillRect(box, _HALO_COLOUR)
    painter.setPen(colour)
    painter.drawText(start, text)


def _find_tone_colour(theme: Theme, tone: str) -> str:
    roles = {"busy": theme.accent, "danger": theme.danger_text}
    return roles.get(tone) or str(getattr(theme, tone))
