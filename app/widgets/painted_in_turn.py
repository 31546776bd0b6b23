"""Painting widgets one after another, each in a turn of the event loop of its own."""

from collections.abc import Callable
from functools import cache

from PySide6.QtCore import QCoreApplication, QObject, QTimer
from PySide6.QtWidgets import QWidget
from shiboken6 import isValid


class PaintedInTurn(QObject):
    """Holds the painting of a widget back until the widgets before it are painted.

    Several plots side by side that are shown or resized at once would otherwise be painted all
    together, and the window would not react meanwhile. The widget paints no more than its ground
    while it is held.

    Parameters
    ----------
    widget : QWidget
        What is updated when its turn comes.
    fit : callable
        Fits the widget's contents to its size; called once before it is painted, however often it
        was resized until then.
    """

    def __init__(self, widget: QWidget, fit: Callable[[], object]) -> None:
        super().__init__(widget)
        self._widget, self._fit = widget, fit
        self._is_held = False

    @property
    def is_held(self) -> bool:
        """Whether its turn has yet to come."""
        return self._is_held

    def hold(self) -> None:
        """Paint the widget as soon as its turn comes."""
        if not self._is_held:
            self._is_held = True
            _queue().add(self)

    def release(self) -> None:
        """Let the widget be painted now, if it is held back."""
        if self._is_held:
            self._is_held = False
            self._fit()
            self._widget.update()


class _Queue(QObject):
    def __init__(self) -> None:
        super().__init__(QCoreApplication.instance())
        self._waiting: list[PaintedInTurn] = []
        self._next = QTimer(self, singleShot=True, interval=0)
        self._next.timeout.connect(self._release_next)

    def add(self, held: PaintedInTurn) -> None:
        self._waiting.append(held)
        self._next.start()

    def _release_next(self) -> None:
        while self._waiting:
            held = self._waiting.pop(0)
            if isValid(held):
                held.release()
                break
        if self._waiting:
            self._next.start()


@cache
def _queue() -> _Queue:
    return _Queue()
