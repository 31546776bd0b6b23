"""View of the newest picture, with zoom, pan and overlays."""

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

from rotemina.app.microscope import MicroscopeStatus
from rotemina.app.widgets.style import Theme
from rotemina.drivers.cameras import CameraFrame, SensorRegion
from rotemina.plugins.microscope import painting, tr
from rotemina.plugins.microscope.contrast import ContrastSettings, compute_levels
from rotemina.plugins.microscope.feed_notice import make_feed_notice
from rotemina.plugins.microscope.geometry import Viewport
from rotemina.plugins.microscope.overlays import (
    OverlayLayer,
    OverlayLine,
    OverlayShape,
    OverlayStyle,
    make_shapes,
)
from rotemina.plugins.microscope.painting import make_scale_bar
from rotemina.plugins.microscope.picture import PictureRenderer, PictureRequest, RenderedPicture

# Zoom factor of one notch of the wheel.
_WHEEL_FACTOR = 1.2
# Qt reports eighths of a degree: one notch is 15°.
_NOTCH_ANGLE_DELTA = 120.0
ALL_LAYERS = frozenset(OverlayLayer) - {OverlayLayer.CROSSHAIR}


class PointerTool(StrEnum):
    """Action of the left button in the picture."""

    PAN = "pan"
    MOVE = "move"
    MARK = "mark"
    MEASURE = "measure"
    TIP = "tip"
    CELL = "cell"


class PictureView(QWidget):
    """View of the newest :class:`MicroscopeStatus`, painted when Qt has time.

    Signals
    -------
    pressed, dragged, released (float, float) : column and row of the left button, unless it pans.
    hovered() : the cursor has moved; see ``cursor_pixel``.
    mode_ended() : Esc was pressed or the view was hidden, so the active mode must end.
    painted(CameraFrame) : this picture is on the screen.
    zoomed() : ``viewport`` has changed.
    """

    pressed = Signal(float, float)
    dragged = Signal(float, float)
    released = Signal(float, float)
    hovered = Signal()
    mode_ended = Signal()
    painted = Signal(object)
    zoomed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.status = MicroscopeStatus()
        self.viewport = Viewport()
        self.contrast = ContrastSettings()
        self.span = (0.0, 1.0)
        self.layers = ALL_LAYERS
        self.tool = PointerTool.PAN
        self.cursor_pixel: tuple[float, float] | None = None
        self.measure_line: tuple[tuple[float, float], tuple[float, float]] | None = None
        self._theme = theme
        self._pan_start: QPointF | None = None
        self._is_button_held = False
        self._is_space_held = False
        self._picture: RenderedPicture | None = None
        # Whether the view was resized after the picture had been rendered.
        self._is_picture_outdated = False
        self._renderer = PictureRenderer(self, self._on_picture)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setMinimumSize(160, 120)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAccessibleName(tr("Picture of the microscope"))
        self.setToolTip("")

    @property
    def frame(self) -> CameraFrame | None:
        """The newest picture."""
        return self.status.feed.frame

    def show_status(self, status: MicroscopeStatus) -> None:
        """Show a status. An earlier one that has not been painted yet is dropped."""
        previous = self.frame
        self.status = status
        frame = self.frame
        if frame is None:
            # Otherwise the old picture might appear as a picture of the next camera.
            self._picture = None
        if frame is None or frame is previous:
            self.update()
            return
        rows, columns = frame.pixels.shape[:2]
        if (rows, columns) != (self.viewport.rows, self.viewport.columns):
            self._set_viewport(self.viewport.with_picture_size(columns, rows))
        if not self._renderer.busy:
            self._renderer.start(self._make_request(frame))

    def set_contrast(self, contrast: ContrastSettings) -> None:
        """Show the pixel values with another contrast."""
        self.contrast = contrast
        if self.frame is not None:
            self.span = compute_levels(self.frame, contrast)
        self.update()

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of a theme around the picture."""
        self._theme = theme
        self.update()

    def set_layer(self, layer: OverlayLayer, on: bool) -> None:
        """Show or hide a layer over the picture."""
        self.layers = self.layers | {layer} if on else self.layers - {layer}
        self.update()

    def set_tool(self, tool: PointerTool) -> None:
        """Set the action of the left button."""
        self.tool = tool
        self.measure_line = None
        self._is_button_held = False
        self._update_cursor_shape()
        self.update()

    def show_fitted(self) -> None:
        """Show the whole picture."""
        self._set_viewport(self.viewport.zoom_to_fit())

    def show_one_to_one(self) -> None:
        """Show one camera pixel per screen pixel."""
        self._set_viewport(self.viewport.zoom_one_to_one())

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the preferred size."""
        return QSize(640, 507)

    def find_visible_region(self) -> SensorRegion | None:
        """Return the visible part of the sensor; None before the first picture."""
        frame = self.frame
        if frame is None:
            return None
        part, region = self.viewport.find_visible_part(), frame.region
        return SensorRegion(
            region.left + part.columns[0],
            region.top + part.rows[0],
            part.columns[1] - part.columns[0],
            part.rows[1] - part.rows[0],
        )

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the newest picture and the overlays."""
        painter = QPainter(self)
        area = QRectF(self.rect())
        painter.fillRect(area, QColor(self._theme.window))
        frame = self.frame
        picture = None if frame is None else self._get_current_picture(frame)
        if picture is not None:
            picture.draw(
                painter, self._compute_target(picture) if self._is_picture_outdated else None
            )
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            if OverlayLayer.CROSSHAIR in self.layers:
                painting.draw_crosshair(painter, self.viewport)
            painting.draw_shapes(painter, self.viewport, self._collect_shapes())
            zoom, status = self.viewport.zoom, self.status
            bar = make_scale_bar(status.pixel_m, status.scale_source, zoom, area.width())
            painting.draw_scale_bar(painter, area, bar)
        notice = make_feed_notice(self.status.feed)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painting.draw_notice(painter, area, notice, self._theme)
        painting.draw_badge(painter, area, notice, self._theme)
        painter.end()
        if picture is not None:
            self.painted.emit(picture.request.frame)

    def _make_request(self, frame: CameraFrame) -> PictureRequest:
        return PictureRequest(frame, self.contrast, self.viewport.find_visible_part())

    def _on_picture(self, picture: RenderedPicture) -> None:
        """Show a rendered picture, and render the newest one if it has arrived meanwhile."""
        frame = self.frame
        if frame is None:
            # The camera was closed meanwhile.
            return
        self._picture, self.span = picture, picture.span
        request = self._make_request(frame)
        is_same_view = picture.request.looks_like(request)
        self._is_picture_outdated = self._is_picture_outdated and not is_same_view
        if frame is not picture.request.frame or self._is_picture_outdated:
            self._renderer.start(request)
        self.update()

    def _compute_target(self, picture: RenderedPicture) -> QRectF:
        """Return the rectangle for a picture rendered for another view size, screen px."""
        (left, right), (top, bottom) = picture.request.part.columns, picture.request.part.rows
        corner = self.viewport.to_screen(left - 0.5, top - 0.5)
        opposite_corner = self.viewport.to_screen(right - 0.5, bottom - 0.5)
        return QRectF(QPointF(*corner), QPointF(*opposite_corner))

    def _get_current_picture(self, frame: CameraFrame) -> RenderedPicture:
        """Return the picture to paint, rendered at once if contrast or zoom has changed.

        While the view is being resized, the last picture is good enough.
        """
        request = self._make_request(frame)
        picture = self._picture
        if picture is not None and self._is_picture_outdated:
            return picture
        if picture is None or not picture.request.looks_like(request):
            picture = self._picture = request.render()
            self.span = picture.span
        return picture

    def _collect_shapes(self) -> list[OverlayShape]:
        overlays = make_shapes(self.status, self.layers)
        if self.measure_line is not None:
            overlays.append(OverlayLine(OverlayStyle.MEASURE, np.array(self.measure_line)))
        return overlays

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin to pan, or report a press of the left button."""
        button = event.button()
        is_panning = self._is_space_held or self.tool is PointerTool.PAN
        if button is Qt.MouseButton.MiddleButton or (
            button is Qt.MouseButton.LeftButton and is_panning
        ):
            self._pan_start = event.position()
            self._update_cursor_shape()
        elif button is Qt.MouseButton.LeftButton and self.frame is not None:
            pixel = self._find_pixel(event)
            if self.viewport.contains(*pixel):
                self._is_button_held = True
                self.pressed.emit(*pixel)
        else:
            super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Pan or drag, and report the cursor."""
        if self._pan_start is not None:
            offset = event.position() - self._pan_start
            self._pan_start = event.position()
            self._set_viewport(self.viewport.pan_by(offset.x(), offset.y()))
        elif self._is_button_held:
            self.dragged.emit(*self._find_pixel(event))
        self._move_cursor(self._find_pixel(event))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """End panning, or report the release of the left button."""
        if self._pan_start is not None:
            self._pan_start = None
            self._update_cursor_shape()
        elif self._is_button_held and event.button() is Qt.MouseButton.LeftButton:
            self._is_button_held = False
            self.released.emit(*self._find_pixel(event))

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Zoom about the cursor."""
        notches = event.angleDelta().y() / _NOTCH_ANGLE_DELTA
        anchor = event.position()
        self._set_viewport(
            self.viewport.zoom_about(_WHEEL_FACTOR**notches, (anchor.x(), anchor.y()))
        )
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Pan with space, fit with F, show 1:1 with 1, end the mode with Esc.

        When Esc arrives here, it has already stopped the machine.
        """
        keys: dict[int, Callable[[], object]] = {
            Qt.Key.Key_F: self.show_fitted,
            Qt.Key.Key_1: self.show_one_to_one,
            Qt.Key.Key_Escape: self.mode_ended.emit,
        }
        if event.key() == Qt.Key.Key_Space:
            self._is_space_held = True
            self._update_cursor_shape()
        elif event.key() in keys and not event.isAutoRepeat():
            keys[event.key()]()
        else:
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """End panning with the space bar."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._stop_panning()
        else:
            super().keyReleaseEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:  # noqa: N802 (Qt's name)
        """End panning: a key may be released while another widget has the focus."""
        self._stop_panning()
        super().focusOutEvent(event)

    def leaveEvent(self, event: object) -> None:  # noqa: N802 (Qt's name)
        """Report that the cursor is no longer over the picture."""
        self._move_cursor(None)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """End the mode, because the effect of a click would be invisible."""
        self._stop_panning()
        self._is_button_held = False
        self.mode_ended.emit()
        super().hideEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Adapt the viewport, and render the picture in the new size."""
        size = event.size()
        self.viewport = self.viewport.with_widget_size(size.width(), size.height())
        self.zoomed.emit()
        frame, picture = self.frame, self._picture
        if frame is not None and picture is not None:
            request = self._make_request(frame)
            self._is_picture_outdated = not picture.request.looks_like(request)
            if self._is_picture_outdated and not self._renderer.busy:
                self._renderer.start(request)

    def _stop_panning(self) -> None:
        self._is_space_held = False
        self._pan_start = None
        self._update_cursor_shape()

    def _find_pixel(self, event: QMouseEvent) -> tuple[float, float]:
        return self.viewport.to_picture(event.position().x(), event.position().y())

    def _move_cursor(self, pixel: tuple[float, float] | None) -> None:
        self.cursor_pixel = pixel
        self.hovered.emit()

    def _set_viewport(self, viewport: Viewport) -> None:
        self.viewport = viewport
        self.zoomed.emit()
        self.update()

    def _update_cursor_shape(self) -> None:
        shape = Qt.CursorShape.CrossCursor
        if self._pan_start is not None:
            shape = Qt.CursorShape.ClosedHandCursor
        elif self._is_space_held or self.tool is PointerTool.PAN:
            shape = Qt.CursorShape.OpenHandCursor
        self.setCursor(shape)
