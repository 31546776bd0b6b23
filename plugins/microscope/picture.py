"""A picture in the colours and the size in which it is on the screen."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from typing import NamedTuple

from PySide6.QtCore import QObject, QPointF, QRectF, Signal
from PySide6.QtGui import QImage, QPainter

from rotemina.drivers.cameras.frame import Frame
from rotemina.plugins.microscope.contrast import Colours, Contrast, levels, shown
from rotemina.plugins.microscope.geometry import Part


class Wanted(NamedTuple):
    """What is to be seen: which part, px, of which frame, and in which colours."""

    frame: Frame
    contrast: Contrast
    part: Part

    def looks_like(self, other: "Wanted") -> bool:
        """Return whether another frame alone makes them differ."""
        return (self.contrast, self.part) == (other.contrast, other.part)

    def worked_out(self) -> "Picture":
        """Return it in colours, of (part.height, part.width) screen px; takes milliseconds."""
        frame, contrast, part = self
        span = levels(frame, contrast)
        size = part.width, part.height
        colours = shown(frame, contrast, span, columns=part.columns, rows=part.rows, size=size)
        height, width = colours.shape
        image = QImage(colours.data, width, height, 4 * width, QImage.Format.Format_RGB32)
        return Picture(self, span, image, colours)


class Picture(NamedTuple):
    """What is drawn: levels (low, high) that became black and white, and colours of the part."""

    of: Wanted
    span: tuple[float, float]
    image: QImage
    colours: Colours  # what the image looks at

    def draw(self, painter: QPainter, place: QRectF | None = None) -> None:
        """Draw it where it belongs, or scaled to a place of another size."""
        part = self.of.part
        if place is not None:
            painter.drawImage(place, self.image)
            return
        painter.drawImage(QPointF(round(part.left), round(part.top)), self.image)


class PictureWork(QObject):
    """Works pictures out on a thread of its own, one at a time: some milliseconds for each frame.

    ``done`` gets the picture on the window's thread.
    """

    _ended = Signal(object)

    def __init__(self, parent: QObject, done: Callable[[Picture], None]) -> None:
        super().__init__(parent)
        self.busy = False
        self._done = done
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="picture")
        self._ended.connect(self._deliver)

    def begin(self, wanted: Wanted) -> None:
        """Begin with a picture; not while it is busy."""
        self.busy = True
        self._thread.submit(wanted.worked_out).add_done_callback(self._tell)

    def _tell(self, ended: Future[Picture]) -> None:
        with suppress(RuntimeError):  # the view may be gone by now
            self._ended.emit(ended)

    def _deliver(self, ended: Future[Picture]) -> None:
        self.busy = False
        self._done(ended.result())
