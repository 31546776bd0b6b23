"""Rendering of pictures in screen colours and screen size, on a separate thread."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from typing import NamedTuple

from PySide6.QtCore import QObject, QPointF, QRectF, Signal
from PySide6.QtGui import QImage, QPainter

from rotemina.drivers.cameras import CameraFrame
from rotemina.plugins.microscope.contrast import (
    Colours,
    ContrastSettings,
    compute_levels,
    render_frame,
)
from rotemina.plugins.microscope.geometry import VisiblePart


class PictureRequest(NamedTuple):
    """Request to render a part of a frame with a contrast."""

    frame: CameraFrame
    contrast: ContrastSettings
    part: VisiblePart

    def looks_like(self, other: "PictureRequest") -> bool:
        """Return whether both requests differ at most in their frames."""
        return (self.contrast, self.part) == (other.contrast, other.part)

    def render(self) -> "RenderedPicture":
        """Return the picture in colours, (part.height, part.width) screen px.

        This takes some milliseconds.
        """
        frame, contrast, part = self
        span = compute_levels(frame, contrast)
        size = part.width, part.height
        colours = render_frame(
            frame, contrast, span, columns=part.columns, rows=part.rows, size=size
        )
        height, width = colours.shape
        image = QImage(colours.data, width, height, 4 * width, QImage.Format.Format_RGB32)
        return RenderedPicture(self, span, image, colours)


class RenderedPicture(NamedTuple):
    """Rendered picture, with ``span``, the levels (low, high) of black and white.

    ``colours`` is the memory that ``image`` uses. It must live as long as the image.
    """

    request: PictureRequest
    span: tuple[float, float]
    image: QImage
    colours: Colours

    def draw(self, painter: QPainter, target: QRectF | None = None) -> None:
        """Draw the picture at its position, or scaled to the rectangle ``target``, screen px."""
        part = self.request.part
        if target is not None:
            painter.drawImage(target, self.image)
            return
        painter.drawImage(QPointF(round(part.left), round(part.top)), self.image)


class PictureRenderer(QObject):
    """Renderer of one picture at a time, on a separate thread.

    Each picture takes some milliseconds. ``on_picture`` then receives it on the window's thread.
    """

    _finished = Signal(object)

    def __init__(self, parent: QObject, on_picture: Callable[[RenderedPicture], None]) -> None:
        super().__init__(parent)
        self.busy = False
        self._on_picture = on_picture
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="picture")
        self._finished.connect(self._deliver)

    def start(self, request: PictureRequest) -> None:
        """Start to render a picture. Must not be called while ``busy``."""
        self.busy = True
        self._thread.submit(request.render).add_done_callback(self._report_finished)

    def _report_finished(self, future: Future[RenderedPicture]) -> None:
        # The view may have been deleted meanwhile.
        with suppress(RuntimeError):
            self._finished.emit(future)

    def _deliver(self, future: Future[RenderedPicture]) -> None:
        self.busy = False
        self._on_picture(future.result())
