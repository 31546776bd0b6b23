"""Where the robot is drawn, without a GPU: turned by dragging, zoomed by the wheel."""

import time
from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, Qt, QTimer
from PySide6.QtGui import (
    QBrush,
    QColor,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPolygonF,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.scene.camera import Camera
from rotemina.app.scene.projected_picture import Drawn, Picture
from rotemina.app.scene.scene import Scene
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.plugins.view3d import tr

_INTERVAL_S = 0.04  # between two pictures, at least
_LEAST_PX = 0.2  # a picture in which no corner has moved farther is not drawn
_RADIANS_PER_PIXEL = 0.008
_STEP = 1.2  # of the wheel
_SHADES = 24
_EDGE = 0.35  # brightness of a solid's edges
_MARGIN = 8


class Canvas(QWidget):
    """Draws a scene while it is in sight, at most 25 times a second."""

    def __init__(self, scene: Scene, theme: Theme) -> None:
        super().__init__()
        self.picture = Picture()
        self.painted = 0
        self._scene, self._theme = scene, theme
        self._revision = 0
        self._asked: tuple[int, Camera | None, QSize] | None = None
        self._drawn: list[Drawn] = []
        self._painted: list[Drawn] = []
        self._grabbed: QPointF | None = None
        self._painted_s = 0.0
        self._brushes: dict[tuple[str, int, float], QBrush] = {}
        self._soon = QTimer(self, singleShot=True, timerType=Qt.TimerType.PreciseTimer)
        self._soon.timeout.connect(self.update)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(200, 120)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAccessibleName(tr("The robot in three dimensions"))
        self.setToolTip(
            plain_tip(
                tr(
                    "Drag to rotate, drag with the right button to shift, use the wheel to zoom, "
                    "double-click to reset."
                )
            )
        )

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for a little more than the least."""
        return QSize(480, 300)

    @property
    def in_sight(self) -> bool:
        """Whether any of it can be seen; a dock behind another one counts as visible."""
        return self.isVisible() and not self.visibleRegion().isEmpty()

    def set_theme(self, theme: Theme) -> None:
        """Write in other colours; the scene tells those of the solids."""
        self._theme = theme
        self.redraw()

    def follow(self) -> None:
        """Draw what has changed, if it can be seen."""
        if not self.in_sight:
            return
        before, noted = self._painted, (self.picture.note, self.picture.camera)
        newest = self._newest()
        if noted != (self.picture.note, self.picture.camera) or _moved(before, newest):
            self.redraw()

    def redraw(self) -> None:
        """Draw soon: now, or when the least interval is over."""
        if self._soon.isActive():
            return
        wait_s = self._painted_s + _INTERVAL_S - time.monotonic()
        if wait_s <= 0:
            self.update()
        else:
            self._soon.start(round(1e3 * wait_s) + 1)

    def _newest(self) -> list[Drawn]:
        """Return what is to be painted, computed again if anything has changed."""
        changes = self._scene.changes(self._revision)
        for command in changes.commands:
            self.picture.obey(command)
        self._revision = changes.revision
        asked = (self._revision, self.picture.camera, self.size())
        if asked != self._asked:
            self._asked = asked
            self._drawn = self.picture.drawn(self.width(), self.height())
        return self._drawn

    # --- the mouse --------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Take hold of the picture."""
        self._grabbed = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Turn it, or shift it with the right button."""
        if self._grabbed is None:
            return
        way, self._grabbed = event.position() - self._grabbed, event.position()
        if event.buttons() & Qt.MouseButton.RightButton:
            self._see(lambda camera: camera.shifted(-way.x(), way.y(), self.height()))
        else:
            right, up = -_RADIANS_PER_PIXEL * way.x(), _RADIANS_PER_PIXEL * way.y()
            self._see(lambda camera: camera.turned(right, up))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Release it."""
        self._grabbed = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Look again as the last button asked."""
        self.picture.camera = self.picture.home
        self.redraw()

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Come nearer or go farther."""
        factor = _STEP ** (event.angleDelta().y() / 120)
        self._see(lambda camera: camera.nearer(factor))

    def _see(self, change: Callable[[Camera], Camera]) -> None:
        if self.picture.camera is not None:
            self.picture.camera = change(self.picture.camera)
            self.redraw()

    # --- drawing ----------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the newest of the scene."""
        self._painted = self._newest()
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor.fromRgbF(*self.picture.background))
        for one in self._painted:
            self._paint(painter, one)
        self._write(painter)
        painter.end()
        self.painted += 1
        self._painted_s = time.monotonic()

    def _paint(self, painter: QPainter, one: Drawn) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)  # no seams between faces
        faces = [QPolygonF([QPointF(x, y) for x, y in face]) for face in one.faces]
        if one.veil:  # all at once, which is faster
            path = QPainterPath()
            for face in faces:
                path.addPolygon(face)
            painter.fillPath(path, self._brush(one.colour, 0.8, 0.5 * one.opacity))
        else:
            for face, shade in zip(faces, one.shades, strict=True):
                painter.setBrush(self._brush(one.colour, shade, 1.0))
                painter.drawConvexPolygon(face)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        edge = self._brush(one.colour, 1.0 if one.veil else _EDGE, 0.8 if one.veil else 1.0)
        painter.setPen(QPen(edge, 1.0))
        painter.drawLines([QLineF(*line) for line in one.lines.tolist()])

    def _brush(self, colour: str, shade: float, opacity: float) -> QBrush:
        """Return a colour at a brightness; grey where the readings are old."""
        named = f"grey {colour}" if self.picture.note["old"] else colour
        key = (named, round(_SHADES * shade), opacity)
        if key not in self._brushes:
            one = QColor(colour)
            red, green, blue = one.redF(), one.greenF(), one.blueF()
            if self.picture.note["old"]:
                red = green = blue = 0.3 * red + 0.59 * green + 0.11 * blue
            scale = key[1] / _SHADES
            self._brushes[key] = QBrush(
                QColor.fromRgbF(scale * red, scale * green, scale * blue, opacity)
            )
        return self._brushes[key]

    def _write(self, painter: QPainter) -> None:
        """Write the legend of the ghosts, and what the picture does not show."""
        note, line = self.picture.note, painter.fontMetrics().lineSpacing()
        y = float(_MARGIN)
        for ghost in note["shown"]:
            painter.setPen(QColor(note["colours"][ghost]))
            painter.drawText(QPointF(_MARGIN, y + painter.fontMetrics().ascent()), "■")
            painter.setPen(QColor(self._theme.text))
            left = _MARGIN + painter.fontMetrics().horizontalAdvance("■ ")
            text = note["words"][ghost]
            painter.drawText(QPointF(left, y + painter.fontMetrics().ascent()), text)
            y += line
        room = QRectF(self.rect()).adjusted(_MARGIN, y + 4, -_MARGIN, -_MARGIN)
        painter.setPen(QColor(self._theme.warning))
        flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap
        painter.drawText(room, int(flags), "\n".join(note["warnings"]))


def _moved(before: list[Drawn], after: list[Drawn]) -> bool:
    """Return whether a picture differs from another one so that it can be seen."""
    if len(before) != len(after):
        return True
    for one, other in zip(before, after, strict=True):
        if (one.path, one.colour, one.lines.shape) != (other.path, other.colour, other.lines.shape):
            return True
        if len(one.lines) and np.abs(one.lines - other.lines).max() > _LEAST_PX:
            return True
    return False
