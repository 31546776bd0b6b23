"""Widget that draws the plate with a colour bar; drag to rotate, wheel to zoom."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QImage,
    QKeyEvent,
    QLinearGradient,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.widgets.style import Theme
from rotemina.plugins.plate import mark, tr
from rotemina.plugins.plate.surface_drawing import OrbitView, draw_surface, make_colour_table
from rotemina.plugins.plate.surface_picture import PlatePicture
from rotemina.sim.messages import format_rounded

_DEGREES_PER_PIXEL = 0.5
_DEGREES_PER_KEY = 5.0
_ZOOM_PER_STEP = 1.15
_KEY_ROTATIONS = {
    Qt.Key.Key_Left: (-_DEGREES_PER_KEY, 0.0),
    Qt.Key.Key_Right: (_DEGREES_PER_KEY, 0.0),
    Qt.Key.Key_Up: (0.0, -_DEGREES_PER_KEY),
    Qt.Key.Key_Down: (0.0, _DEGREES_PER_KEY),
}
_KEY_ZOOMS = {Qt.Key.Key_Plus: _ZOOM_PER_STEP, Qt.Key.Key_Minus: 1.0 / _ZOOM_PER_STEP}
_BAR_WIDTH_PX = 14
_GRADIENT_STOP_COUNT = 16

# Width of the space at the right for the colour bar and its numbers.
_BAR_SPACE_PX = 92

CANVAS_TIP = mark(
    "Drag to rotate, use the wheel to zoom, double-click to reset; also arrow keys, + and −"
)


class PlateCanvas(QWidget):
    """Widget that shows a picture in 3-D without OpenGL."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.view = OrbitView()
        self.picture: PlatePicture | None = None
        self.with_mesh = False
        self.hint = ""
        self._theme = theme
        self._drag_position: QPointF | None = None
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(260, 180)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(tr("The plate in 3-D"))
        self.setToolTip(tr(CANVAS_TIP))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    def show_picture(self, picture: PlatePicture | None, hint: str = "") -> None:
        """Draw another picture, or the hint if ``picture`` is None."""
        self.picture, self.hint = picture, hint
        self.update()

    def show_mesh(self, with_mesh: bool) -> None:
        """Draw the lines of the mesh, or hide them."""
        self.with_mesh = with_mesh
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return a size at which the plate is well visible."""
        return QSize(520, 300)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the picture and its colour bar, or the hint."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.surface))
        painter.setPen(QColor(self._theme.quiet))
        if self.picture is None:
            flags = int(Qt.AlignmentFlag.AlignCenter) | int(Qt.TextFlag.TextWordWrap)
            painter.drawText(self.rect().adjusted(20, 20, -20, -20), flags, self.hint)
        else:
            self._draw(painter, self.picture)
        painter.end()

    def _draw(self, painter: QPainter, picture: PlatePicture) -> None:
        ratio = self.devicePixelRatioF()
        width, height = max(self.width() - _BAR_SPACE_PX, 1), self.height()
        size = max(round(width * ratio), 1), max(round(height * ratio), 1)
        theme = self._theme
        image = draw_surface(
            picture.surface,
            self.view,
            size,
            _to_rgb(theme.surface),
            _to_rgb(theme.command),
            _to_rgb(theme.line) if self.with_mesh else None,
        )
        painter.drawImage(QRectF(0, 0, width, height), _to_image(image))
        self._draw_bar(painter, picture)

    def _draw_bar(self, painter: QPainter, picture: PlatePicture) -> None:
        left, top = self.width() - _BAR_SPACE_PX + 6, 30
        bottom = self.height() - 14
        bar = QLinearGradient(left, bottom, left, top)
        for fraction in np.linspace(0.0, 1.0, _GRADIENT_STOP_COUNT):
            bar.setColorAt(fraction, QColor(*make_colour_table()[round(fraction * 255)].tolist()))
        painter.fillRect(QRectF(left, top, _BAR_WIDTH_PX, bottom - top), bar)
        painter.setPen(QColor(self._theme.text))
        painter.drawText(QPointF(left, 18), picture.unit or tr("relative"))
        for fraction in (0.0, 0.25, 0.5, 0.75, 1.0):
            value = picture.low + fraction * (picture.high - picture.low)
            y = bottom - fraction * (bottom - top) + 5
            painter.drawText(QPointF(left + _BAR_WIDTH_PX + 5, y), format_rounded(value, 3))

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Start a rotation."""
        self._drag_position = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Rotate the view."""
        if self._drag_position is not None:
            distance = event.position() - self._drag_position
            self._drag_position = event.position()
            self._set_view(
                self.view.with_rotation(
                    _DEGREES_PER_PIXEL * distance.x(), _DEGREES_PER_PIXEL * distance.y()
                )
            )

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """End the rotation."""
        self._drag_position = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Reset the view."""
        self._set_view(OrbitView())

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Zoom the view."""
        self._set_view(self.view.with_zoom(_ZOOM_PER_STEP ** (event.angleDelta().y() / 120.0)))
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Rotate with the arrow keys, zoom with + and −."""
        key = Qt.Key(event.key())
        if key in _KEY_ROTATIONS:
            self._set_view(self.view.with_rotation(*_KEY_ROTATIONS[key]))
        elif key in _KEY_ZOOMS:
            self._set_view(self.view.with_zoom(_KEY_ZOOMS[key]))
        else:
            super().keyPressEvent(event)

    def _set_view(self, view: OrbitView) -> None:
        self.view = view
        self.update()


def _to_rgb(colour: str) -> tuple[int, int, int]:
    q_colour = QColor(colour)
    return q_colour.red(), q_colour.green(), q_colour.blue()


def _to_image(pixels: np.ndarray) -> QImage:
    height, width, _ = pixels.shape
    image = QImage(pixels.data, width, height, 4 * width, QImage.Format.Format_RGB32)
    # The image uses the memory of the array, which is freed after this call.
    return image.copy()
