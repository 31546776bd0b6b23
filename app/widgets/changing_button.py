"""A button whose text and meaning change with the state, as Play and Pause."""

from collections.abc import Callable

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QPushButton, QStyle, QStyleOptionButton


class ChangingButton(QPushButton):
    """Keeps its room for each of its texts, and takes a double click for one click.

    So neither it nor its neighbours move when it says something else, and the second click of a
    double click on *Pause* does not resume. While it says what stops something, every click acts.

    Parameters
    ----------
    *texts : str
        All that it may say; it says the first.
    run : callable, optional
        Called by each click.
    """

    def __init__(self, *texts: str, run: Callable[[], object] | None = None) -> None:
        super().__init__(texts[0])
        self._texts = texts
        self._stops = False
        if run is not None:
            self.clicked.connect(lambda _: run())

    def show_meaning(self, text: str, *, stops: bool = False) -> None:
        """Say what the next click does, and whether that only stops something."""
        self._stops = stops
        if text != self.text():
            self.setText(text)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Have room for any of the texts."""
        option, size = QStyleOptionButton(), super().sizeHint()
        self.initStyleOption(option)
        for option.text in self._texts:
            text = self.fontMetrics().size(Qt.TextFlag.TextShowMnemonic, option.text)
            kind = QStyle.ContentsType.CT_PushButton
            size = size.expandedTo(self.style().sizeFromContents(kind, option, text, self))
        return size

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Take the second click only where it stops something."""
        if self._stops:
            super().mouseDoubleClickEvent(event)
        else:
            event.accept()
