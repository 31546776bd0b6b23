"""A row of widgets that breaks into several lines where it has too little width."""

from collections.abc import Iterator

from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtWidgets import QLayout, QLayoutItem, QWidget


class FlowLayout(QLayout):
    """Lays widgets out side by side, in as many lines as the width needs.

    A widget that expands takes what its line has left. The row never asks for more width than its
    widest widget.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._items: list[QLayoutItem] = []

    def addItem(self, item: QLayoutItem) -> None:  # noqa: N802 (Qt's name)
        """Take an item on, after the others."""
        self._items.append(item)

    def count(self) -> int:
        """Return how many items there are."""
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem | None:  # noqa: N802 (Qt's name)
        """Return an item, None beyond the last."""
        return self._items[index] if 0 <= index < len(self._items) else None

    def takeAt(self, index: int) -> QLayoutItem | None:  # noqa: N802 (Qt's name)
        """Remove an item and return it."""
        return self._items.pop(index) if 0 <= index < len(self._items) else None

    def expandingDirections(self) -> Qt.Orientation:  # noqa: N802 (Qt's name)
        """Expand to no side."""
        return Qt.Orientation(0)

    def hasHeightForWidth(self) -> bool:  # noqa: N802 (Qt's name)
        """Be as high as the lines need."""
        return True

    def heightForWidth(self, width: int) -> int:  # noqa: N802 (Qt's name)
        """Return the height of the lines in a width, px."""
        return self._place(QRect(0, 0, width, 0), apply=False)

    def setGeometry(self, rect: QRect) -> None:  # noqa: N802 (Qt's name)
        """Place the widgets."""
        super().setGeometry(rect)
        self._place(rect, apply=True)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size of a single line."""
        sizes = [item.sizeHint() for item in self._shown()]
        width = sum(size.width() for size in sizes) + self.spacing() * max(len(sizes) - 1, 0)
        return self._with_margins(width, max((size.height() for size in sizes), default=0))

    def minimumSize(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the width of the widest widget, and the height of one line."""
        sizes = [item.minimumSize() for item in self._shown()]
        width = max((size.width() for size in sizes), default=0)
        return self._with_margins(width, max((size.height() for size in sizes), default=0))

    def _with_margins(self, width: int, height: int) -> QSize:
        around = self.contentsMargins()
        return QSize(
            width + around.left() + around.right(), height + around.top() + around.bottom()
        )

    def _shown(self) -> Iterator[QLayoutItem]:
        return (item for item in self._items if not item.isEmpty())

    def _lines(self, width: int) -> Iterator[list[QLayoutItem]]:
        """Yield the items of each line."""
        line: list[QLayoutItem] = []
        used = 0
        for item in self._shown():
            needed = item.sizeHint().width()
            if line and used + self.spacing() + needed > width:
                yield line
                line, used = [], 0
            used += needed + (self.spacing() if line else 0)
            line.append(item)
        if line:
            yield line

    def _place(self, rect: QRect, *, apply: bool) -> int:
        """Place the lines one below the other; return the height that they take."""
        around = self.contentsMargins()
        inner = rect.marginsRemoved(around)
        top = inner.top()
        for line in self._lines(inner.width()):
            sizes = [item.sizeHint() for item in line]
            height = max(size.height() for size in sizes)
            spare = inner.width() - sum(size.width() for size in sizes)
            spare -= self.spacing() * (len(line) - 1)
            expanding = [item.expandingDirections() & Qt.Orientation.Horizontal for item in line]
            left = inner.left()
            for item, size, expands in zip(line, sizes, expanding, strict=True):
                if expands:
                    size.setWidth(size.width() + max(spare, 0) // max(sum(map(bool, expanding)), 1))
                width = min(size.width(), inner.width())
                if apply:
                    at = QPoint(left, top + (height - size.height()) // 2)
                    item.setGeometry(QRect(at, QSize(width, size.height())))
                left += width + self.spacing()
            top += height + self.spacing()
        return max(top - self.spacing() - inner.top(), 0) + around.top() + around.bottom()
