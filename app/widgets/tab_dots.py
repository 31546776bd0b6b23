"""Dots on tabs behind which something new waits; no tab moves or changes its size for it."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QTabBar, QWidget

from rotemina.app.shell.language import translate

_SIZE, _MARGIN = 7.0, 3.0  # px, in the upper right corner of a tab


class TabDots(QWidget):
    """Lies over a tab bar, lets the mouse through, and draws a dot on each tab that is new.

    Parameters
    ----------
    bar : QTabBar
    is_new : callable
        Returns whether the tab of an index is to have a dot.
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
        """Draw anew after something became new or was seen, and say so to screen readers."""
        bar = self._bar
        for index in range(bar.count()):
            title = bar.tabText(index).replace("&", "")
            text = translate("widgets", "{title}, has something new").format(title=title)
            bar.setAccessibleTabName(index, text if self._is_new(index) else title)
        self.lower()  # below the buttons that scroll the tabs
        self.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Cover the whole bar."""
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
            left, top = tab.right() - _MARGIN - _SIZE, tab.top() + _MARGIN
            painter.drawEllipse(QRectF(left, top, _SIZE, _SIZE))


class TabNews(QObject):
    """Remembers which tabs of a bar have something new; one that is looked at has not."""

    def __init__(self, bar: QTabBar) -> None:
        super().__init__(bar)
        self._bar = bar
        self._new: set[int] = set()
        self._dots = TabDots(bar, self._new.__contains__)
        bar.currentChanged.connect(self._see)

    def mark(self, index: int) -> None:
        """Note that a tab has something new, unless it is in front."""
        if index != self._bar.currentIndex():
            self._new.add(index)
            self._dots.refresh()

    def is_new(self, index: int) -> bool:
        """Return whether a tab has something that was not looked at."""
        return index in self._new

    def _see(self, index: int) -> None:
        self._new.discard(index)
        self._dots.refresh()
