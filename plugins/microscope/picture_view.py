"""The newest picture, with zoom, pan, and overlays."""

from collections.abc import Callable
from enum import StrEnum

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QHideEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.shell.theme import Theme
from rotemina.drivers.cameras.frame import Frame, Region
from rotemina.plugins.microscope import painting, tr
from rotemina.plugins.microscope.contrast import Contrast, levels
from rotemina.plugins.microscope.feed_notice import feed_notice
from rotemina.plugins.microscope.geometry import Viewport
from rotemina.plugins.microscope.overlays import Layer, Look, Shape, Stroke, shapes
from rotemina.plugins.microscope.picture import Picture, PictureWork, Wanted
from rotemina.plugins.microscope.scale_bar import scale_bar

_WHEEL = 1.2  # a notch
_NOTCH = 120.0
ALL_LAYERS = frozenset(Layer) - {Layer.CROSSHAIR}


class PointerTool(StrEnum):
    """What the left button does in the picture."""

    PAN = "pan"
    MOVE = "move"
    MARK = "mark"
    MEASURE = "measure"
    TIP = "tip"
    CELL = "cell"


class PictureView(QWidget):
    """Shows a :class:`MicroscopeStatus`; it keeps only the newest, and paints when Qt has time.

    Signals
    -------
    pressed, dragged, released (float, float) : column and row of the left button, unless it pans.
    hovered() : the cursor is elsewhere; see ``cursor``.
    left() : Esc was pressed, or the view was hidden: whatever mode it was in, it is to end.
    painted(Frame) : that picture is on the screen.
    zoomed() : see ``viewport``.
    """

    pressed = Signal(float, float)
    dragged = Signal(float, float)
    released = Signal(float, float)
    hovered = Signal()
    left = Signal()
    painted = Signal(object)
    zoomed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.status = MicroscopeStatus()
        self.viewport = Viewport()
        self.contrast = Contrast()
        self.span = (0.0, 1.0)
        self.layers = ALL_LAYERS
        self.tool = PointerTool.PAN
        self.cursor_at: tuple[float, float] | None = None
        self.line: tuple[tuple[float, float], tuple[float, float]] | None = None
        self._theme = theme
        self._panned_from: QPointF | None = None
        self._held = False
        self._space = False
        self._picture: Picture | None = None
        self._resized = False  # since the picture was worked out
        self._work = PictureWork(self, self._take)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setMinimumSize(160, 120)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAccessibleName(tr("Picture of the microscope"))
        self.setToolTip("")

    @property
    def frame(self) -> Frame | None:
        """The newest picture."""
        return self.status.feed.frame

    def show_status(self, status: MicroscopeStatus) -> None:
        """Show another moment; one that was not painted yet is forgotten."""
        before = self.frame
        self.status = status
        frame = self.frame
        if frame is None:
            self._picture = None  # no other camera's picture may stand for it later
        if frame is None or frame is before:
            self.update()
            return
        rows, columns = frame.pixels.shape[:2]
        if (rows, columns) != (self.viewport.rows, self.viewport.columns):
            self._view(self.viewport.showing(columns, rows))
        if not self._work.busy:
            self._work.begin(self._wanted(frame))

    def set_contrast(self, contrast: Contrast) -> None:
        """Show numbers by other colours."""
        self.contrast = contrast
        if self.frame is not None:
            self.span = levels(self.frame, contrast)
        self.update()

    def set_theme(self, theme: Theme) -> None:
        """Change the colours beside the picture."""
        self._theme = theme
        self.update()

    def set_layer(self, layer: Layer, on: bool) -> None:
        """Show or hide something over the picture."""
        self.layers = self.layers | {layer} if on else self.layers - {layer}
        self.update()

    def set_tool(self, tool: PointerTool) -> None:
        """Have the left button do something else."""
        self.tool = tool
        self.line = None
        self._held = False
        self._show_cursor()
        self.update()

    def show_fitted(self) -> None:
        """Show all of the picture."""
        self._view(self.viewport.fit())

    def show_one_to_one(self) -> None:
        """Show each pixel as one of the screen's."""
        self._view(self.viewport.one_to_one())

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for room."""
        return QSize(640, 507)

    def region_in_sight(self) -> Region | None:
        """Return the part of the sensor that is in sight; None before the first picture."""
        frame = self.frame
        if frame is None:
            return None
        part, region = self.viewport.part(), frame.region
        return Region(
            region.left + part.columns[0],
            region.top + part.rows[0],
            part.columns[1] - part.columns[0],
            part.rows[1] - part.rows[0],
        )

    # --- drawing ----------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the newest picture, and what lies over it."""
        painter = QPainter(self)
        area = QRectF(self.rect())
        painter.fillRect(area, QColor(self._theme.window))
        frame = self.frame
        picture = None if frame is None else self._picture_in_sight(frame)
        if picture is not None:
            picture.draw(painter, self._place(picture) if self._resized else None)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            if Layer.CROSSHAIR in self.layers:
                painting.draw_crosshair(painter, self.viewport)
            painting.draw_shapes(painter, self.viewport, self._shapes())
            zoom, status = self.viewport.zoom, self.status
            bar = scale_bar(status.pixel_m, status.scale_source, zoom, area.width())
            painting.draw_bar(painter, area, bar)
        said = feed_notice(self.status.feed)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painting.draw_notice(painter, area, said, self._theme)
        painting.draw_badge(painter, area, said, self._theme)
        painter.end()
        if picture is not None:
            self.painted.emit(picture.of.frame)

    def _wanted(self, frame: Frame) -> Wanted:
        return Wanted(frame, self.contrast, self.viewport.part())

    def _take(self, picture: Picture) -> None:
        """Show what was worked out, and go on with what came meanwhile."""
        frame = self.frame
        if frame is None:
            return  # the camera was closed meanwhile
        self._picture, self.span = picture, picture.span
        wanted = self._wanted(frame)
        fits = picture.of.looks_like(wanted)
        self._resized = self._resized and not fits
        if frame is not picture.of.frame or self._resized:
            self._work.begin(wanted)
        self.update()

    def _place(self, picture: Picture) -> QRectF:
        """Return where a picture of another size of the view belongs, screen px."""
        (left, right), (top, bottom) = picture.of.part.columns, picture.of.part.rows
        corner = self.viewport.to_screen(left - 0.5, top - 0.5)
        other = self.viewport.to_screen(right - 0.5, bottom - 0.5)
        return QRectF(QPointF(*corner), QPointF(*other))

    def _picture_in_sight(self, frame: Frame) -> Picture:
        """Return the newest picture; what hands change, such as the zoom, is not waited for.

        While the view is being resized the last one is good enough.
        """
        wanted = self._wanted(frame)
        picture = self._picture
        if picture is not None and self._resized:
            return picture
        if picture is None or not picture.of.looks_like(wanted):
            picture = self._picture = wanted.worked_out()
            self.span = picture.span
        return picture

    def _shapes(self) -> list[Shape]:
        found = shapes(self.status, self.layers)
        if self.line is not None:
            found.append(Stroke(Look.MEASURE, np.array(self.line)))
        return found

    # --- hands ------------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin to pan, or what the left button does."""
        button = event.button()
        pans = self._space or self.tool is PointerTool.PAN
        if button is Qt.MouseButton.MiddleButton or (button is Qt.MouseButton.LeftButton and pans):
            self._panned_from = event.position()
            self._show_cursor()
        elif button is Qt.MouseButton.LeftButton and self.frame is not None:
            at = self._at(event)
            if self.viewport.holds(*at):
                self._held = True
                self.pressed.emit(*at)
        else:
            super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Pan, drag, or only look."""
        if self._panned_from is not None:
            way = event.position() - self._panned_from
            self._panned_from = event.position()
            self._view(self.viewport.panned(way.x(), way.y()))
        elif self._held:
            self.dragged.emit(*self._at(event))
        self._hover(self._at(event))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """End what the press began."""
        if self._panned_from is not None:
            self._panned_from = None
            self._show_cursor()
        elif self._held and event.button() is Qt.MouseButton.LeftButton:
            self._held = False
            self.released.emit(*self._at(event))

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Zoom about the cursor."""
        turned = event.angleDelta().y() / _NOTCH
        about = event.position()
        self._view(self.viewport.zoomed(_WHEEL**turned, (about.x(), about.y())))
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Space pans, F fits, 1 is one to one, Esc leaves a mode; the stop has heard it already."""
        keys: dict[int, Callable[[], object]] = {
            Qt.Key.Key_F: self.show_fitted,
            Qt.Key.Key_1: self.show_one_to_one,
            Qt.Key.Key_Escape: self.left.emit,
        }
        if event.key() == Qt.Key.Key_Space:
            self._space = True
            self._show_cursor()
        elif event.key() in keys and not event.isAutoRepeat():
            keys[event.key()]()
        else:
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """End panning with the space bar."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._let_go()
        else:
            super().keyReleaseEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:  # noqa: N802 (Qt's name)
        """Hold nothing that is not held here."""
        self._let_go()
        super().focusOutEvent(event)

    def leaveEvent(self, event: object) -> None:  # noqa: N802 (Qt's name)
        """Say nothing of a cursor that is elsewhere."""
        self._hover(None)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """End the mode: nobody sees what a click would do."""
        self._let_go()
        self._held = False
        self.left.emit()
        super().hideEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Keep the picture in sight."""
        size = event.size()
        self.viewport = self.viewport.resized(size.width(), size.height())
        self.zoomed.emit()
        frame, picture = self.frame, self._picture
        if frame is not None and picture is not None:
            wanted = self._wanted(frame)
            self._resized = not picture.of.looks_like(wanted)
            if self._resized and not self._work.busy:
                self._work.begin(wanted)

    def _let_go(self) -> None:
        self._space = False
        self._panned_from = None
        self._show_cursor()

    def _at(self, event: QMouseEvent) -> tuple[float, float]:
        return self.viewport.to_picture(event.position().x(), event.position().y())

    def _hover(self, at: tuple[float, float] | None) -> None:
        self.cursor_at = at
        self.hovered.emit()

    def _view(self, viewport: Viewport) -> None:
        self.viewport = viewport
        self.zoomed.emit()
        self.update()

    def _show_cursor(self) -> None:
        shape = Qt.CursorShape.CrossCursor
        if self._panned_from is not None:
            shape = Qt.CursorShape.ClosedHandCursor
        elif self._space or self.tool is PointerTool.PAN:
            shape = Qt.CursorShape.OpenHandCursor
        self.setCursor(shape)
