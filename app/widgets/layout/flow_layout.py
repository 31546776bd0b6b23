"""A row of widgets that breaks into several lines if it is too narrow."""

from collections.abc import Iterator

from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtWidgets import QLayout, QLayoutItem, QWidget


class FlowLayout(QLayout):
    """Layout that places widgets side by side, in as many lines as the width requires.

    Expanding widgets share the rest of their line. The layout never requests more width than its
    widest widget needs.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._items: list[QLayoutItem] = []

    def addItem(self, item: QLayoutItem) -> None:  # noqa: N802 (Qt's name)
        """Add an item after the others."""
        self._items.append(item)

    def count(self) -> int:
        """Return the number of items."""
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem | None:  # noqa: N802 (Qt's name)
        """Return an item, or None beyond the last one."""
        return self._items[index] if 0 <= index < len(self._items) else None

    def takeAt(self, index: int) -> QLayoutItem | None:  # noqa: N802 (Qt's name)
        """Remove an item and return it."""
        return self._items.pop(index) if 0 <= index < len(self._items) else None

    def expandingDirections(self) -> Qt.Orientation:  # noqa: N802 (Qt's name)
        """Return no direction: the layout does not expand."""
        return Qt.Orientation(0)

    def hasHeightForWidth(self) -> bool:  # noqa: N802 (Qt's name)
        """Return True: the height depends on the width."""
        return True

    def heightForWidth(self, width: int) -> int:  # noqa: N802 (Qt's name)
        """Return the height of the lines at a width, px."""
        return self._place(QRect(0, 0, width, 0), apply=False)

    def setGeometry(self, rect: QRect) -> None:  # noqa: N802 (Qt's name)
        """Place the widgets."""
        super().setGeometry(rect)
        self._place(rect, apply=True)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size of a single line."""
        sizes = [item.sizeHint() for item in self._visible_items()]
        width = sum(size.width() for size in sizes) + self.spacing() * max(len(sizes) - 1, 0)
        return self._with_margins(width, max((size.height() for size in sizes), default=0))

    def minimumSize(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the width of the widest widget and the height of one line."""
        sizes = [item.minimumSize() for item in self._visible_items()]
        width = max((size.width() for size in sizes), default=0)
        return self._with_margins(width, max((size.height() for size in sizes), default=0))

    def _with_margins(self, width: int, height: int) -> QSize:
        margins = self.contentsMargins()
        return QSize(
            width + margins.left() + margins.right(), height + margins.top() + margins.bottom()
        )

    def _visible_items(self) -> Iterator[QLayoutItem]:
        return (item for item in self._items if not item.isEmpty())

    def _break_lines(self, width: int) -> Iterator[list[QLayoutItem]]:
        line: list[QLayoutItem] = []
        used_width = 0
        for item in self._visible_items():
            needed_width = item.sizeHint().width()
            if line and used_width + self.spacing() + needed_width > width:
                yield line
                line, used_width = [], 0
            used_width += needed_width + (self.spacing() if line else 0)
            line.append(item)
        if line:
            yield line

    def _place(self, rect: QRect, *, apply: bool) -> int:
        """Place the lines below each other; return their total height."""
        margins = self.contentsMargins()
        area = rect.marginsRemoved(margins)
        top = area.top()
        for line in self._break_lines(area.width()):
            sizes = [item.sizeHint() for item in line]
            height = max(size.height() for size in sizes)
            spare_width = area.width() - sum(size.width() for size in sizes)
            spare_width -= self.spacing() * (len(line) - 1)
            expanding_flags = [
                item.expandingDirections() & Qt.Orientation.Horizontal for item in line
            ]
            left = area.left()
            for item, size, expands in zip(line, sizes, expanding_flags, strict=True):
                if expands:
                    size.setWidth(
                        size.width()
                        + max(spare_width, 0) // max(sum(map(bool, expanding_flags)), 1)
                    )
                width = min(size.width(), area.width())
                if apply:
                    position = QPoint(left, top + (height - size.height()) // 2)
                    item.setGeometry(QRect(position, QSize(width, size.height())))
                left += width + self.spacing()
            top += height + self.spacing()
        return max(top - self.spacing() - area.top(), 0) + margins.top() + margins.bottom()
