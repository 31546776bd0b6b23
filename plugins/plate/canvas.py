"""The drawing of the plate: drag to rotate, wheel to zoom, with a colour bar."""

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

from rotemina.app.shell.theme import Theme
from rotemina.plugins.plate import mark, tr
from rotemina.plugins.plate.surface_drawing import View, colours, drawn
from rotemina.plugins.plate.surface_picture import Picture
from rotemina.sim.quantities import rounded

_DEGREES_PER_PIXEL = 0.5
_KEY_DEGREES = 5.0
_ZOOM_PER_STEP = 1.15
_TURNS = {
    Qt.Key.Key_Left: (-_KEY_DEGREES, 0.0),
    Qt.Key.Key_Right: (_KEY_DEGREES, 0.0),
    Qt.Key.Key_Up: (0.0, -_KEY_DEGREES),
    Qt.Key.Key_Down: (0.0, _KEY_DEGREES),
}
_ZOOMS = {Qt.Key.Key_Plus: _ZOOM_PER_STEP, Qt.Key.Key_Minus: 1.0 / _ZOOM_PER_STEP}
_BAR_WIDTH = 14
_STOPS = 16
_BAR_ROOM = 92  # on the right, for the bar and its numbers
TIP = mark("Drag to rotate, use the wheel to zoom, double-click to reset; also arrow keys, + and −")


class Canvas(QWidget):
    """A picture in 3-D without OpenGL."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.view = View()
        self.picture: Picture | None = None
        self.with_mesh = False
        self.hint = ""
        self._theme = theme
        self._grabbed: QPointF | None = None
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(260, 180)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(tr("The plate in 3-D"))
        self.setToolTip(tr(TIP))

    def set_theme(self, theme: Theme) -> None:
        """Draw in other colours."""
        self._theme = theme
        self.update()

    def show_picture(self, picture: Picture | None, hint: str = "") -> None:
        """Draw another picture, or words in its place."""
        self.picture, self.hint = picture, hint
        self.update()

    def show_mesh(self, with_mesh: bool) -> None:
        """Draw the mesh's lines, or leave them out."""
        self.with_mesh = with_mesh
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for a size at which a plate can be seen."""
        return QSize(520, 300)

    # --- drawing ----------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the picture and its bar."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.surface))
        painter.setPen(QColor(self._theme.quiet))
        if self.picture is None:
            flags = int(Qt.AlignmentFlag.AlignCenter) | int(Qt.TextFlag.TextWordWrap)
            painter.drawText(self.rect().adjusted(20, 20, -20, -20), flags, self.hint)
        else:
            self._draw(painter, self.picture)
        painter.end()

    def _draw(self, painter: QPainter, picture: Picture) -> None:
        ratio = self.devicePixelRatioF()
        width, height = max(self.width() - _BAR_ROOM, 1), self.height()
        size = max(round(width * ratio), 1), max(round(height * ratio), 1)
        theme = self._theme
        image = drawn(
            picture.surface,
            self.view,
            size,
            _rgb(theme.surface),
            _rgb(theme.command),
            _rgb(theme.line) if self.with_mesh else None,
        )
        painter.drawImage(QRectF(0, 0, width, height), _as_image(image))
        self._draw_bar(painter, picture)

    def _draw_bar(self, painter: QPainter, picture: Picture) -> None:
        left, top = self.width() - _BAR_ROOM + 6, 30
        bottom = self.height() - 14
        bar = QLinearGradient(left, bottom, left, top)
        for share in np.linspace(0.0, 1.0, _STOPS):
            bar.setColorAt(share, QColor(*colours()[round(share * 255)].tolist()))
        painter.fillRect(QRectF(left, top, _BAR_WIDTH, bottom - top), bar)
        painter.setPen(QColor(self._theme.text))
        painter.drawText(QPointF(left, 18), picture.unit or tr("relative"))
        for share in (0.0, 0.25, 0.5, 0.75, 1.0):
            value = picture.low + share * (picture.high - picture.low)
            y = bottom - share * (bottom - top) + 5
            painter.drawText(QPointF(left + _BAR_WIDTH + 5, y), rounded(value, 3))

    # --- turning ----------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin to turn."""
        self._grabbed = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Turn."""
        if self._grabbed is not None:
            moved = event.position() - self._grabbed
            self._grabbed = event.position()
            self._look(
                self.view.turned(_DEGREES_PER_PIXEL * moved.x(), _DEGREES_PER_PIXEL * moved.y())
            )

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave it as it is."""
        self._grabbed = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Show it as at first."""
        self._look(View())

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Zoom."""
        self._look(self.view.zoomed(_ZOOM_PER_STEP ** (event.angleDelta().y() / 120.0)))
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Turn and zoom by keys."""
        key = Qt.Key(event.key())
        if key in _TURNS:
            self._look(self.view.turned(*_TURNS[key]))
        elif key in _ZOOMS:
            self._look(self.view.zoomed(_ZOOMS[key]))
        else:
            super().keyPressEvent(event)

    def _look(self, view: View) -> None:
        self.view = view
        self.update()


def _rgb(colour: str) -> tuple[int, int, int]:
    one = QColor(colour)
    return one.red(), one.green(), one.blue()


def _as_image(pixels: np.ndarray) -> QImage:
    height, width, _ = pixels.shape
    image = QImage(pixels.data, width, height, 4 * width, QImage.Format.Format_RGB32)
    return image.copy()  # the array goes when it is drawn
