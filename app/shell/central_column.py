"""The middle of the window: bars that are shown for a time, and the central panels below them."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from rotemina.app.widgets.layouts import in_column
from rotemina.app.widgets.scroll_areas import PanelFrame

LEAST_HEIGHT = 120  # px of the central panels: a strip of plots
_MARGIN = 6  # px
_LITTLE = 48  # px of the bars, at least
_MOST = 1 / 3  # of the window's height that bars may take; beyond that they are scrolled


class CentralColumn(QWidget):
    """Central panels below bars; it asks for little, whatever is in it."""

    def __init__(self, bars: Sequence[QWidget], panels: QWidget) -> None:
        super().__init__()
        self._bars = tuple(bars)
        self._together = QWidget()
        in_column(*bars, on=self._together, margins=(0, 0, 0, _MARGIN), spacing=_MARGIN)
        self._frame = PanelFrame(self._together, QSize(_LITTLE, _LITTLE))
        in_column(self._frame, (panels, 1), on=self, margins=_MARGIN, spacing=0)
        self._together.installEventFilter(self)
        self._share_height()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Share the height anew: bars may need more lines, or fewer."""
        super().resizeEvent(event)
        self._share_height()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Share the height anew where a bar comes or goes."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._share_height()
        return False

    def _share_height(self) -> None:
        """Ask for the height of the bars in addition: they do not take that of the panels."""
        width = self.width() - 2 * _MARGIN
        most = round(_MOST * self.window().height()) if self._has_bars() else 0
        wanted = self._together.heightForWidth(width)
        if wanted > most > 0:
            wanted = self._together.heightForWidth(width - self._frame.bar_width())
        wanted = max(wanted, 0)  # of no bar at all, Qt says −1
        if self._together.minimumHeight() != wanted:
            self._together.setMinimumHeight(wanted)
        height = min(wanted, most)
        if self._frame.maximumHeight() != height:
            self._frame.setFixedHeight(height)
        self.setMinimumHeight(LEAST_HEIGHT + height)

    def _has_bars(self) -> bool:
        return not all(bar.isHidden() for bar in self._bars)
