"""Sizes that depend on the theme: on its font, and on the frames of its buttons and fields."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QFontInfo
from PySide6.QtWidgets import QWidget

_NORMAL = 13.0  # px, of text
_DRESSED = (QEvent.Type.FontChange, QEvent.Type.StyleChange)


class WhenDressed(QObject):
    """Calls ``fit`` at once, and again whenever a widget gets another font or style.

    A panel is made before the window dresses it, and text may be made larger at any time.
    """

    def __init__(self, widget: QWidget, fit: Callable[[], object]) -> None:
        super().__init__(widget)
        self._fit = fit
        widget.installEventFilter(self)
        fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Fit: a widget has its new font and style by the time it is told of them."""
        if event.type() in _DRESSED:
            self._fit()
        return False


def grow_with_text(widget: QWidget, resize: Callable[[int], object], length: int) -> None:
    """Call ``resize`` with a length, px at normal text, in proportion to the size of text."""
    WhenDressed(widget, lambda: resize(round(length * max(_size(widget) / _NORMAL, 1.0))))


def _size(widget: QWidget) -> int:
    return QFontInfo(widget.font()).pixelSize()


def leave_room(widget: QWidget, text: str, beside: int = 0) -> None:
    """Keep a widget at least as wide as a text and ``beside`` px, in any size of text."""

    def fit() -> None:
        widget.setMinimumWidth(widget.fontMetrics().horizontalAdvance(text) + beside)

    WhenDressed(widget, fit)
