"""The middle of the window: temporary bars above the central panels."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from rotemina.app.widgets.layout import PanelFrame, make_column

# Keeps a strip of the plots visible.
MIN_PANELS_HEIGHT_PX = 120
_MARGIN_PX = 6
_MIN_BARS_SIZE_PX = 48
# Share of the window's height. Taller bars are scrolled.
_MAX_BARS_SHARE = 1 / 3


class CentralColumn(QWidget):
    """Column of temporary bars and central panels that fits into a low window.

    Bars that are too tall are scrolled.
    """

    def __init__(self, bars: Sequence[QWidget], panels: QWidget) -> None:
        super().__init__()
        self._bars = tuple(bars)
        self._bars_widget = QWidget()
        make_column(*bars, on=self._bars_widget, margins=(0, 0, 0, _MARGIN_PX), spacing=_MARGIN_PX)
        self._frame = PanelFrame(self._bars_widget, QSize(_MIN_BARS_SIZE_PX, _MIN_BARS_SIZE_PX))
        make_column(self._frame, (panels, 1), on=self, margins=_MARGIN_PX, spacing=0)
        self._bars_widget.installEventFilter(self)
        self._divide_height()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Divide the height again: bars may need more lines, or fewer."""
        super().resizeEvent(event)
        self._divide_height()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Divide the height again when a bar appears or disappears."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._divide_height()
        return False

    def _divide_height(self) -> None:
        """Give the bars the height that they need, up to the limit, and the panels the rest."""
        width = self.width() - 2 * _MARGIN_PX
        max_height = round(_MAX_BARS_SHARE * self.window().height()) if self._has_bars() else 0
        bars_height = self._bars_widget.heightForWidth(width)
        if bars_height > max_height > 0:
            bars_height = self._bars_widget.heightForWidth(width - self._frame.bar_width_px())
        # Qt returns −1 if no bar is visible.
        bars_height = max(bars_height, 0)
        if self._bars_widget.minimumHeight() != bars_height:
            self._bars_widget.setMinimumHeight(bars_height)
        height = min(bars_height, max_height)
        if self._frame.maximumHeight() != height:
            self._frame.setFixedHeight(height)
        self.setMinimumHeight(MIN_PANELS_HEIGHT_PX + height)

    def _has_bars(self) -> bool:
        return not all(bar.isHidden() for bar in self._bars)
