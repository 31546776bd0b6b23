"""Work on a widget that waits until the widget is visible, or until its style is applied."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtGui import QFontInfo
from PySide6.QtWidgets import QWidget

from rotemina.sim.compatibility import serve_former_names

_NORMAL_TEXT_PX = 13.0
_STYLE_EVENTS = (QEvent.Type.FontChange, QEvent.Type.StyleChange)


class OnStyleChange(QObject):
    """Trigger that calls ``fit`` at once and whenever a widget gets another font or style.

    A panel is created before the window applies its theme, and the text size may change at any
    time.
    """

    def __init__(self, widget: QWidget, fit: Callable[[], object]) -> None:
        super().__init__(widget)
        self._fit = fit
        widget.installEventFilter(self)
        fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Call ``fit``; at this event the widget already has its new font and style."""
        if event.type() in _STYLE_EVENTS:
            self._fit()
        return False


def grow_with_text(widget: QWidget, resize: Callable[[int], object], length: int) -> None:
    """Call ``resize`` with a length, px at normal text size, scaled to the current text size."""
    OnStyleChange(
        widget, lambda: resize(round(length * max(_find_text_size(widget) / _NORMAL_TEXT_PX, 1.0)))
    )


def _find_text_size(widget: QWidget) -> int:
    return QFontInfo(widget.font()).pixelSize()


def reserve_width(widget: QWidget, text: str, extra_px: int = 0) -> None:
    """Keep a widget at least as wide as a text plus ``extra_px``, at any text size."""

    def fit() -> None:
        widget.setMinimumWidth(widget.fontMetrics().horizontalAdvance(text) + extra_px)

    OnStyleChange(widget, fit)


class OnVisible(QObject):
    """Trigger that calls ``work`` at once if a widget is visible, else when it becomes visible.

    While the window itself is not shown yet, nothing is delayed, so that its contents are complete
    when it is shown.
    """

    def __init__(self, widget: QWidget, work: Callable[[], object]) -> None:
        super().__init__(widget)
        self._widget, self._work, self._is_due = widget, work, False
        widget.installEventFilter(self)

    def __call__(self) -> None:
        """Do the work, or delay it."""
        self._is_due = not self._widget.isVisible() and self._widget.window().isVisible()
        if not self._is_due:
            self._work()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Do delayed work after the widget was shown and painted."""
        if event.type() == QEvent.Type.Show and self._is_due:
            QTimer.singleShot(0, self, self._catch_up)
        return False

    def _catch_up(self) -> None:
        if self._is_due and self._widget.isVisible():
            self()


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        WhenDressed="OnStyleChange",
        leave_room="reserve_width",
    )
