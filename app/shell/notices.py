"""Notices: what the operator must know, at the top of the window until it is read."""

from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.shell.help_topics import page_of
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Level

MOST_HEIGHT = 62
MOST = 3  # older notices give way; the log keeps them all


class Notice(QFrame):
    """One message with a button that closes it, and one that opens the page on it.

    Signals
    -------
    closed()
    asked(str) : which page is to be opened.
    """

    closed = Signal()
    asked = Signal(str)

    def __init__(self, level: Level, text: str) -> None:
        super().__init__()
        self.setObjectName("notice")
        self.setProperty("level", str(level))
        self.text = text
        self.setMaximumHeight(MOST_HEIGHT)  # a long message must not push the panels away
        self.setToolTip(escape(text))
        message = QLabel(text)
        message.setWordWrap(True)
        message.setTextFormat(Qt.TextFormat.PlainText)  # file names and values are not markup
        message.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        message.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        close = QToolButton()
        close.setText("✕")
        close.setAutoRaise(True)
        close.setToolTip(translate("shell", "Close this notice"))
        close.setAccessibleName(translate("shell", "Close this notice"))
        close.clicked.connect(self.closed)
        row = QHBoxLayout(self)
        row.setContentsMargins(10, 4, 6, 4)
        row.addWidget(message, 1)
        page = page_of(text)
        if page:
            self.help = QToolButton()
            self.help.setText("?")
            self.help.setAutoRaise(True)
            self.help.setToolTip(
                translate("shell", "What this means, and what to do: {page}").format(page=page)
            )
            self.help.setAccessibleName(translate("shell", "Help on this notice"))
            self.help.clicked.connect(lambda _=False: self.asked.emit(page))
            row.addWidget(self.help, 0, Qt.AlignmentFlag.AlignTop)
        row.addWidget(close, 0, Qt.AlignmentFlag.AlignTop)


class NoticeBar(QWidget):
    """The notices that are still open, newest first; takes no room when there is none.

    Signals
    -------
    asked(str) : which page of the help is to be opened.
    """

    asked = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self._open: list[Notice] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(4)

    def show_notice(self, level: Level, text: str) -> None:
        """Add a notice on top; the same text is not shown twice."""
        for open_notice in self.notices():
            if open_notice.text == text:
                self._remove(open_notice)
        notice = Notice(level, text)
        notice.closed.connect(lambda: self._remove(notice))
        notice.asked.connect(self.asked)
        self._open.insert(0, notice)
        self._column.insertWidget(0, notice)
        for old in self.notices()[MOST:]:
            self._remove(old)

    def notices(self) -> list[Notice]:
        """Return the open notices, newest first."""
        return list(self._open)

    def _remove(self, notice: Notice) -> None:
        self._open.remove(notice)
        self._column.removeWidget(notice)
        notice.hide()
        notice.deleteLater()
