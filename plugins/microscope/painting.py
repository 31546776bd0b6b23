"""Drawing over the picture: shapes, scale bar, crosshair, and the veil of an old picture."""

from collections.abc import Sequence

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QPainter, QPen, QPolygonF

from rotemina.app.shell.theme import Theme
from rotemina.plugins.microscope.feed_notice import FeedNotice
from rotemina.plugins.microscope.geometry import Viewport
from rotemina.plugins.microscope.overlays import Cross, Look, Ring, Shape, Stroke
from rotemina.plugins.microscope.scale_bar import Bar

# Over a picture, not over the window: the same in both themes, told apart by colour-blind eyes.
COLOURS = {
    Look.TIP: "#ffd23f",
    Look.LOST: "#ff6b6b",
    Look.GHOST: "#4cc9ff",
    Look.TARGET: "#ffffff",
    Look.REACHED: "#7fe08f",
    Look.MISSED: "#ff6b6b",
    Look.PATH: "#e0a3ff",
    Look.NANO: "#9ad1ff",
    Look.CELL: "#7fe08f",
    Look.AHEAD: "#7fe08f",
    Look.MEASURE: "#ffb86b",
}
_HALO = QColor(0, 0, 0, 150)
_ARM, _GAP = 11.0, 3.0  # of a cross, px
_LEAST_RING = 4.0  # a smaller one would be hidden by its cross
_MARGIN = 10.0


def draw_shapes(painter: QPainter, viewport: Viewport, shapes: Sequence[Shape]) -> None:
    """Draw what is marked in the picture, each with a dark halo so that it is seen on any."""
    for shape in shapes:
        colour = QColor(COLOURS[shape.look])
        for pen in (QPen(_HALO, 3.5), QPen(colour, 1.5)):
            if isinstance(shape, Stroke) and shape.dashed:
                pen.setStyle(Qt.PenStyle.DashLine)
            painter.setPen(pen)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            _draw(painter, viewport, shape)
        if isinstance(shape, Stroke | Cross) and shape.label:
            crossed = isinstance(shape, Cross)  # a line's label stands below: both may be seen
            at = QPointF(*viewport.to_screen(*(shape.at if crossed else shape.points[-1])))
            below = QPointF(_ARM + 2.0, -5.0 if crossed else _ARM + painter.fontMetrics().ascent())
            draw_text(painter, at + below, shape.label, colour)


def _draw(painter: QPainter, viewport: Viewport, shape: Shape) -> None:
    if isinstance(shape, Stroke):
        line = QPolygonF([QPointF(*viewport.to_screen(*point)) for point in shape.points])
        if shape.closed:
            painter.drawPolygon(line)
        else:
            painter.drawPolyline(line)
        return
    at = QPointF(*viewport.to_screen(*shape.at))
    if isinstance(shape, Ring):
        radius = shape.radius * viewport.zoom
        if radius >= _LEAST_RING:
            painter.drawEllipse(at, radius, radius)
        return
    for way in (QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)):
        painter.drawLine(QLineF(at + _GAP * way, at + _ARM * way))


def draw_crosshair(painter: QPainter, viewport: Viewport) -> None:
    """Draw lines through the middle of the picture."""
    x, y = viewport.to_screen(*viewport.middle)
    for pen in (QPen(_HALO, 2.0), QPen(QColor(255, 255, 255, 170), 0.8)):
        painter.setPen(pen)
        painter.drawLine(QLineF(0.0, y, viewport.width, y))
        painter.drawLine(QLineF(x, 0.0, x, viewport.height))


def draw_bar(painter: QPainter, area: QRectF, bar: Bar) -> None:
    """Draw the scale bar in the lower right corner."""
    right, low = area.right() - _MARGIN, area.bottom() - _MARGIN
    line = QLineF(right - bar.length, low, right, low)
    for pen in (QPen(_HALO, 7.0), QPen(QColor("white"), 4.0)):
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(pen)
        painter.drawLine(line)
    text = bar.text if not bar.remark else f"{bar.text}  ({bar.remark})"
    width = painter.fontMetrics().horizontalAdvance(text)
    draw_text(painter, QPointF(right - width, low - 8.0), text, QColor("white"))


def draw_badge(painter: QPainter, area: QRectF, feed_notice: FeedNotice, theme: Theme) -> None:
    """Draw state, rate and age in the upper left corner."""
    metrics = painter.fontMetrics()
    box = QRectF(
        area.left() + _MARGIN,
        area.top() + _MARGIN,
        metrics.horizontalAdvance(feed_notice.badge) + 16.0,
        metrics.height() + 6.0,
    )
    colour = QColor(_tone(theme, feed_notice.tone))
    painter.setPen(QPen(colour, 1.0))
    surface = QColor(theme.surface)
    surface.setAlpha(225)
    painter.setBrush(surface)
    painter.drawRoundedRect(box, 8.0, 8.0)
    painter.setPen(colour)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, feed_notice.badge)


def draw_notice(painter: QPainter, area: QRectF, feed_notice: FeedNotice, theme: Theme) -> None:
    """Grey and hatch a picture that shows the past, and say so in words."""
    if feed_notice.veiled:
        shade = QColor(theme.window)
        shade.setAlpha(150)
        painter.fillRect(area, shade)
        painter.fillRect(area, QBrush(QColor(theme.quiet), Qt.BrushStyle.BDiagPattern))
    if not feed_notice.title:
        return
    font, bold = painter.font(), QFont(painter.font())
    bold.setPixelSize(22)
    bold.setBold(True)
    wide = QRectF(0.0, 0.0, max(min(area.width() - 40.0, 460.0), 60.0), area.height())
    words = Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignHCenter
    painter.setFont(bold)
    head = painter.boundingRect(wide, int(words), feed_notice.title)
    painter.setFont(font)
    body = painter.boundingRect(wide, int(words), feed_notice.reason)
    height = head.height() + (body.height() + 6.0 if feed_notice.reason else 0.0)
    box = QRectF(0.0, 0.0, wide.width() + 24.0, height + 24.0)
    box.moveCenter(area.center())
    painter.setPen(QPen(QColor(_tone(theme, feed_notice.tone)), 2.0))
    painter.setBrush(QColor(theme.surface))
    painter.drawRoundedRect(box, 6.0, 6.0)
    inner = box.adjusted(12.0, 12.0, -12.0, -12.0)
    painter.setPen(QColor(_tone(theme, feed_notice.tone)))
    painter.setFont(bold)
    painter.drawText(inner, int(words), feed_notice.title)
    painter.setFont(font)
    painter.setPen(QColor(theme.text))
    painter.drawText(
        inner.adjusted(0.0, head.height() + 6.0, 0.0, 0.0), int(words), feed_notice.reason
    )


def draw_text(painter: QPainter, at: QPointF, text: str, colour: QColor) -> None:
    """Draw a line of text on a dark ground, its base line at ``at``."""
    metrics = painter.fontMetrics()
    box = QRectF(metrics.boundingRect(text)).translated(at).adjusted(-3.0, -1.0, 3.0, 1.0)
    painter.fillRect(box, _HALO)
    painter.setPen(colour)
    painter.drawText(at, text)


def _tone(theme: Theme, tone: str) -> str:
    roles = {"busy": theme.accent, "danger": theme.danger_text}
    return roles.get(tone) or str(getattr(theme, tone))
