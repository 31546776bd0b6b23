"""Painting a widget once where it comes into sight."""

from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt
from PySide6.QtWidgets import QWidget


class PaintedOnce(QObject):
    """Holds a widget's painting back until all that is shown with it has been heard of.

    Every widget that is shown asks to be painted, and every scene of a plot has the whole window
    painted at once: six plots side by side would be painted three times.
    """

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self._widget = widget
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Hold back what is being shown."""
        if event.type() == QEvent.Type.Show and not event.spontaneous():
            self._widget.setUpdatesEnabled(False)
            # Behind everything that showing posts, and before the painting.
            low = Qt.EventPriority.LowEventPriority.value
            QCoreApplication.postEvent(self, QEvent(QEvent.Type.User), low)
        return super().eventFilter(watched, event)

    def customEvent(self, _: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Paint what was shown."""
        self._widget.setUpdatesEnabled(True)
