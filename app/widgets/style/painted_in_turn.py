"""Staggered painting: widgets are painted one after another, each in its own event-loop turn."""

from collections.abc import Callable
from functools import cache

from PySide6.QtCore import QCoreApplication, QObject, QTimer
from PySide6.QtWidgets import QWidget
from shiboken6 import isValid


class StaggeredPainting(QObject):
    """Delayed painting of a widget, until the widgets ahead of it in the queue are painted.

    If several plots are shown or resized at once, they would otherwise all be painted together, and
    the window would not react meanwhile. While the painting is held, the widget should paint only
    its background.

    Parameters
    ----------
    widget : QWidget
        Updated when its turn comes.
    fit : callable
        Fits the widget's contents to its size. It is called once before the widget is painted,
        however often the widget was resized meanwhile.
    """

    def __init__(self, widget: QWidget, fit: Callable[[], object]) -> None:
        super().__init__(widget)
        self._widget, self._fit = widget, fit
        self._is_held = False

    @property
    def is_held(self) -> bool:
        """Whether the widget is still waiting for its turn."""
        return self._is_held

    def hold(self) -> None:
        """Delay the painting until the widget's turn comes."""
        if not self._is_held:
            self._is_held = True
            _get_queue().add(self)

    def release(self) -> None:
        """Paint the widget now if it is held."""
        if self._is_held:
            self._is_held = False
            self._fit()
            self._widget.update()


class _PaintQueue(QObject):
    def __init__(self) -> None:
        super().__init__(QCoreApplication.instance())
        self._paintings: list[StaggeredPainting] = []
        self._release_timer = QTimer(self, singleShot=True, interval=0)
        self._release_timer.timeout.connect(self._release_next)

    def add(self, painting: StaggeredPainting) -> None:
        self._paintings.append(painting)
        self._release_timer.start()

    def _release_next(self) -> None:
        while self._paintings:
            painting = self._paintings.pop(0)
            if isValid(painting):
                painting.release()
                break
        if self._paintings:
            self._release_timer.start()


@cache
def _get_queue() -> _PaintQueue:
    return _PaintQueue()
