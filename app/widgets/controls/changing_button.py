"""A button whose text and meaning change with the state, such as Play and Pause."""

from collections.abc import Callable

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QPushButton, QStyle, QStyleOptionButton


class ChangingButton(QPushButton):
    """Button with space for each of its texts, which treats a double click as a single click.

    Neither the button nor its neighbours move when its text changes, and the second click of a
    double click on *Pause* does not resume. While a click only stops something, every click acts.

    Parameters
    ----------
    *texts : str
        All texts of the button; the first one is shown initially.
    run : callable, optional
        Called at each click.
    """

    def __init__(self, *texts: str, run: Callable[[], object] | None = None) -> None:
        super().__init__(texts[0])
        self._texts = texts
        self._stops = False
        if run is not None:
            self.clicked.connect(lambda _: run())

    def show_meaning(self, text: str, *, stops: bool = False) -> None:
        """Show what the next click does; ``stops`` says whether it only stops something."""
        self._stops = stops
        if text != self.text():
            self.setText(text)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request enough space for any of the texts."""
        option, size = QStyleOptionButton(), super().sizeHint()
        self.initStyleOption(option)
        for option.text in self._texts:
            text_size = self.fontMetrics().size(Qt.TextFlag.TextShowMnemonic, option.text)
            contents = QStyle.ContentsType.CT_PushButton
            size = size.expandedTo(self.style().sizeFromContents(contents, option, text_size, self))
        return size

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Accept the second click only if it stops something."""
        if self._stops:
            super().mouseDoubleClickEvent(event)
        else:
            event.accept()
