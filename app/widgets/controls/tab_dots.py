"""Dots on tabs with new contents; no tab moves or changes its size because of them."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QTabBar, QWidget

from rotemina.app.language import translate

# Size of a dot, and its distance to the upper right corner of its tab.
_SIZE_PX, _MARGIN_PX = 7.0, 3.0


class TabDots(QWidget):
    """Overlay on a tab bar that ignores the mouse and draws a dot on each tab with new contents.

    Parameters
    ----------
    bar : QTabBar
    is_new : callable
        Returns whether the tab of an index has new contents.
    """

    def __init__(self, bar: QTabBar, is_new: Callable[[int], bool]) -> None:
        super().__init__(bar)
        self._bar, self._is_new = bar, is_new
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        bar.installEventFilter(self)
        self.setGeometry(bar.rect())
        self.show()

    def refresh(self) -> None:
        """Draw the dots again and report new contents to screen readers."""
        bar = self._bar
        for index in range(bar.count()):
            title = bar.tabText(index).replace("&", "")
            text = translate("widgets", "{title}, has something new").format(title=title)
            bar.setAccessibleTabName(index, text if self._is_new(index) else title)
        # The buttons that scroll the tabs must stay on top.
        self.lower()
        self.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Cover the whole tab bar."""
        if event.type() == QEvent.Type.Resize:
            self.setGeometry(self._bar.rect())
        return False

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the dots."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self.palette().color(QPalette.ColorRole.Highlight))
        for index in filter(self._is_new, range(self._bar.count())):
            tab = self._bar.tabRect(index)
            left, top = tab.right() - _MARGIN_PX - _SIZE_PX, tab.top() + _MARGIN_PX
            painter.drawEllipse(QRectF(left, top, _SIZE_PX, _SIZE_PX))


class TabNews(QObject):
    """Marks on tabs with new contents, until they are selected."""

    def __init__(self, bar: QTabBar) -> None:
        super().__init__(bar)
        self._bar = bar
        self._marked_indices: set[int] = set()
        self._dots = TabDots(bar, self._marked_indices.__contains__)
        bar.currentChanged.connect(self._on_tab_changed)

    def mark(self, index: int) -> None:
        """Mark a tab, unless it is selected."""
        if index != self._bar.currentIndex():
            self._marked_indices.add(index)
            self._dots.refresh()

    def is_new(self, index: int) -> bool:
        """Return whether a tab has contents that were not seen yet."""
        return index in self._marked_indices

    def _on_tab_changed(self, index: int) -> None:
        self._marked_indices.discard(index)
        self._dots.refresh()
