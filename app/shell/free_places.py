"""Where in a window there is room for something that must not cover what is used."""

from collections.abc import Collection, Iterable, Iterator

import numpy as np
from PySide6.QtCore import QPoint, QRect, QSize
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSlider,
    QAbstractSpinBox,
    QComboBox,
    QGraphicsView,
    QLabel,
    QLineEdit,
    QMenuBar,
    QPlainTextEdit,
    QProgressBar,
    QTabBar,
    QTextEdit,
    QWidget,
)

CELL = 4  # px
# What takes clicks or keys in each of its parts.
_CONTROLS = (
    QAbstractButton,
    QAbstractSlider,
    QAbstractSpinBox,
    QComboBox,
    QLineEdit,
    QMenuBar,
    QTabBar,
)
# What is read, or is as large as a table: a part of it may be covered.
_CONTENT = (QAbstractItemView, QLabel, QPlainTextEdit, QProgressBar, QTextEdit)
# px: a picture or a list of at least this size can still be used where a part of it is covered.
_ROOMY = QSize(320, 240)


class FreePlaces:
    """The free places of an area, in cells of 4 px."""

    def __init__(self, area: QRect, taken: Iterable[QRect] = ()) -> None:
        self.area = area
        rows, columns = max(area.height() // CELL, 0), max(area.width() // CELL, 0)
        self._taken = np.zeros((rows, columns), dtype=np.int32)
        self._sums: np.ndarray | None = None
        for rect in taken:
            self.take(rect)

    def take(self, rect: QRect) -> None:
        """Let a place be free no longer."""
        self._taken[self._cells(rect)] = 1
        self._sums = None

    def is_free(self, rect: QRect) -> bool:
        """Return whether a place is within the area and nothing has taken any of it."""
        return self.area.contains(rect) and not self._taken[self._cells(rect)].any()

    def _cells(self, rect: QRect) -> tuple[slice, slice]:
        inside = rect.intersected(self.area)
        if inside.isEmpty():
            return slice(0), slice(0)
        top, left = inside.top() - self.area.top(), inside.left() - self.area.left()
        bottom, right = top + inside.height(), left + inside.width()
        return slice(top // CELL, -(-bottom // CELL)), slice(left // CELL, -(-right // CELL))

    def find(self, size: QSize) -> QRect | None:
        """Return the free place of a size that is next to the lower right; None where none is."""
        height, width = -(-size.height() // CELL), -(-size.width() // CELL)
        rows, columns = self._taken.shape
        if height > rows or width > columns:
            return None
        sums = self._summed()
        covered = (
            sums[height:, width:]
            - sums[:-height, width:]
            - sums[height:, :-width]
            + sums[:-height, :-width]
        )
        down = np.arange(rows - height + 1)[:, None]
        nearness = np.where(covered == 0, down + np.arange(columns - width + 1), -1)
        best = int(nearness.argmax())
        row, column = divmod(best, nearness.shape[1])
        if nearness[row, column] < 0:
            return None
        corner = self.area.topLeft() + QPoint(column * CELL, row * CELL)
        return QRect(corner, size)

    def _summed(self) -> np.ndarray:
        """Return how many cells are taken above and left of each corner of a cell."""
        if self._sums is None:
            self._sums = np.pad(self._taken.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
        return self._sums


def used_places(
    window: QWidget, without: Collection[QWidget] = ()
) -> tuple[list[QRect], list[QRect]]:
    """Return where a window has controls that can be used or readouts, and where it has text.

    What is in the widgets ``without`` does not count.
    """
    controls, content = [], []
    for widget, rect in _seen(window, without):
        if _is_control(widget):
            if widget.isEnabled():
                controls.append(rect)
        elif widget.property("readout"):  # where the machine is, must be seen at all times
            controls.append(rect)
        elif isinstance(widget, _CONTENT):
            content.append(rect)
    return controls, content


def _is_control(widget: QWidget) -> bool:
    """Whether a widget is one to click on; one that handles clicks itself is, unless it is large.

    A text to read is none, and a plot and a large list or picture can be used next to a notice.
    """
    if isinstance(widget, _CONTROLS):
        return True
    if isinstance(widget, QGraphicsView):
        return False
    if isinstance(widget, QTextEdit | QPlainTextEdit):
        return not widget.isReadOnly()
    handles_clicks = isinstance(widget, QAbstractItemView) or any(
        "mousePressEvent" in kind.__dict__
        for kind in type(widget).__mro__
        if not kind.__module__.startswith("PySide6")
    )
    size = QWidget.size(widget)
    roomy = size.width() >= _ROOMY.width() and size.height() >= _ROOMY.height()
    return handles_clicks and not roomy


def _seen(window: QWidget, without: Collection[QWidget]) -> Iterator[tuple[QWidget, QRect]]:
    """Walk through what is visible in a window, each with the part of its place that is seen."""
    waiting = [(window, window.rect(), QPoint())]
    while waiting:
        parent, seen, origin = waiting.pop()
        for child in QWidget.children(parent):
            if not isinstance(child, QWidget) or child in without:
                continue
            if child.isWindow() or not child.isVisible():
                continue
            # A panel may have parts named as Qt's methods are, such as "size".
            place = QWidget.geometry(child).translated(origin)
            rect = place.intersected(seen)
            if not rect.isEmpty():
                yield child, rect
                waiting.append((child, rect, place.topLeft()))
