"""Search for free space in a window, for notices that must not cover controls in use."""

from collections.abc import Collection, Iterable, Iterator

import numpy as np
from PySide6.QtCore import QPoint, QRect, QSize, Qt
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
    QToolBar,
    QWidget,
)

CELL_PX = 4
# Widgets that accept clicks or keys anywhere in their area.
_CONTROL_CLASSES = (
    QAbstractButton,
    QAbstractSlider,
    QAbstractSpinBox,
    QComboBox,
    QLineEdit,
    QMenuBar,
    QTabBar,
)
# Widgets that are only read, or large ones such as tables; they may be partly covered.
_CONTENT_CLASSES = (QAbstractItemView, QLabel, QPlainTextEdit, QProgressBar, QTextEdit)
# A picture or list of at least this size (px) stays usable when it is partly covered.
_MIN_ROOMY_SIZE = QSize(320, 240)


class FreeSpaceMap:
    """Map of the free space of an area, in cells of 4 px."""

    def __init__(self, area: QRect, taken: Iterable[QRect] = ()) -> None:
        self.area = area
        rows, columns = max(area.height() // CELL_PX, 0), max(area.width() // CELL_PX, 0)
        self._taken = np.zeros((rows, columns), dtype=np.int32)
        self._sums: np.ndarray | None = None
        for rect in taken:
            self.take(rect)

    def take(self, rect: QRect) -> None:
        """Mark a rectangle as taken."""
        self._taken[self._to_cells(rect)] = 1
        self._sums = None

    def is_free(self, rect: QRect) -> bool:
        """Return whether a rectangle is inside the area and completely free."""
        return self.area.contains(rect) and not self._taken[self._to_cells(rect)].any()

    def _to_cells(self, rect: QRect) -> tuple[slice, slice]:
        inside = rect.intersected(self.area)
        if inside.isEmpty():
            return slice(0), slice(0)
        top, left = inside.top() - self.area.top(), inside.left() - self.area.left()
        bottom, right = top + inside.height(), left + inside.width()
        return slice(top // CELL_PX, -(-bottom // CELL_PX)), slice(
            left // CELL_PX, -(-right // CELL_PX)
        )

    def find(self, size: QSize) -> QRect | None:
        """Return the free rectangle of a size closest to the lower right corner, or None."""
        height, width = -(-size.height() // CELL_PX), -(-size.width() // CELL_PX)
        rows, columns = self._taken.shape
        if height > rows or width > columns:
            return None
        sums = self._sum_taken_cells()
        # Number of taken cells under the rectangle for each position, from the summed-area table.
        covered = (
            sums[height:, width:]
            - sums[:-height, width:]
            - sums[height:, :-width]
            + sums[:-height, :-width]
        )
        row_numbers = np.arange(rows - height + 1)[:, None]
        nearness = np.where(covered == 0, row_numbers + np.arange(columns - width + 1), -1)
        best = int(nearness.argmax())
        row, column = divmod(best, nearness.shape[1])
        if nearness[row, column] < 0:
            return None
        corner = self.area.topLeft() + QPoint(column * CELL_PX, row * CELL_PX)
        return QRect(corner, size)

    def _sum_taken_cells(self) -> np.ndarray:
        """Return, for each cell corner, how many taken cells are above and left of it."""
        if self._sums is None:
            self._sums = np.pad(self._taken.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
        return self._sums


def find_used_places(
    window: QWidget, without: Collection[QWidget] = ()
) -> tuple[list[QRect], list[QRect]]:
    """Return the rectangles of usable controls and readouts, and those of text.

    The widgets in ``without`` and their contents are ignored.
    """
    controls, content = [], []
    for widget, rect in _walk_visible(window, without):
        if _is_control(widget):
            if widget.isEnabled():
                controls.append(rect)
        # The readouts show where the machine is and must stay visible.
        elif widget.property("readout"):
            controls.append(rect)
        elif isinstance(widget, _CONTENT_CLASSES):
            content.append(rect)
    return controls, content


def _is_control(widget: QWidget) -> bool:
    """Return whether a widget is a control that must not be covered.

    Read-only text is not a control. A large widget that handles clicks, such as a plot, a list or a
    picture, is not one either: it stays usable when a notice covers part of it.
    """
    if isinstance(widget, _CONTROL_CLASSES):
        return True
    if isinstance(widget, QGraphicsView):
        return False
    if isinstance(widget, QTextEdit | QPlainTextEdit):
        return not widget.isReadOnly()
    handles_clicks = isinstance(widget, QAbstractItemView) or any(
        "mousePressEvent" in widget_class.__dict__
        for widget_class in type(widget).__mro__
        if not widget_class.__module__.startswith("PySide6")
    )
    size = QWidget.size(widget)
    is_roomy = size.width() >= _MIN_ROOMY_SIZE.width() and size.height() >= _MIN_ROOMY_SIZE.height()
    return handles_clicks and not is_roomy


def _walk_visible(window: QWidget, without: Collection[QWidget]) -> Iterator[tuple[QWidget, QRect]]:
    pending = [(window, window.rect(), QPoint())]
    while pending:
        parent, visible_rect, origin = pending.pop()
        for child in QWidget.children(parent):
            if not isinstance(child, QWidget) or child in without:
                continue
            if child.isWindow() or not child.isVisible():
                continue
            # A panel may have attributes named like Qt methods, such as "size", so the method is
            # called on the class.
            child_rect = QWidget.geometry(child).translated(origin)
            rect = child_rect.intersected(visible_rect)
            if not rect.isEmpty():
                yield child, rect
                pending.append((child, rect, child_rect.topLeft()))


def find_header_bottom(window: QWidget) -> int:
    """Return the lower edge of a window's header, in px from the top.

    Nothing may cover the header.
    """
    bars = window.findChildren(QToolBar, options=Qt.FindChildOption.FindDirectChildrenOnly)
    return max((bar.geometry().bottom() + 1 for bar in bars if bar.isVisible()), default=0)
