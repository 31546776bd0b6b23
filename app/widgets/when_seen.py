"""Work for what is drawn that waits until it is in sight."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QWidget


class WhenSeen(QObject):
    """Calls ``work`` at once while a widget is in sight, else once as soon as it is.

    In a window that is not shown yet nothing is out of sight: what is built there is complete.
    """

    def __init__(self, widget: QWidget, work: Callable[[], object]) -> None:
        super().__init__(widget)
        self._widget, self._work, self._due = widget, work, False
        widget.installEventFilter(self)

    def __call__(self) -> None:
        """Do the work, or note that it is to be done."""
        self._due = not self._widget.isVisible() and self._widget.window().isVisible()
        if not self._due:
            self._work()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Catch up after the widget has come into sight: it is painted first."""
        if event.type() == QEvent.Type.Show and self._due:
            QTimer.singleShot(0, self, self._catch_up)
        return False

    def _catch_up(self) -> None:
        if self._due and self._widget.isVisible():
            self()
