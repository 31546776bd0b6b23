"""Notices: what the operator must know, over the lower right of the window; nothing moves."""

import time
from html import escape

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, Qt, QTimer, Signal
from PySide6.QtGui import QCursor
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QMainWindow,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.shell.help_topics import page_of, remedy_of
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Level
from rotemina.drivers.clock import Clock

MOST_HEIGHT = 62
MOST = 3  # are seen; how many more there are is said below them
WIDTH = 440  # px
CONFIRMATION_S = 6.0
_READ_S = 1.0  # a warning that an action itself has caused outlives that action
_MARGIN = 8
_LOOK_MS = 250


class Notice(QFrame):
    """One message with buttons: for its remedy, for the page on it, and to close it.

    Signals
    -------
    closed()
    asked(str) : which page is to be opened.
    """

    closed = Signal()
    asked = Signal(str)

    def __init__(self, level: Level, text: str, since_s: float) -> None:
        super().__init__()
        self.setObjectName("notice")
        self.setProperty("level", str(level))
        self.level, self.text, self.since_s, self.count = level, text, since_s, 1
        self.setMaximumHeight(MOST_HEIGHT)  # the tooltip and the log have all of a long one
        self.setToolTip(escape(text))
        self._message = message = QLabel(text)
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
        page, remedy = page_of(text), remedy_of(text)
        if remedy is not None:
            self.remedy = QToolButton()
            self.remedy.setText(remedy.words)
            self.remedy.clicked.connect(lambda _=False: (self.closed.emit(), remedy.do()))
            row.addWidget(self.remedy, 0, Qt.AlignmentFlag.AlignTop)
        if page:
            self.help = QToolButton()
            self.help.setText("?")
            self.help.setAutoRaise(True)
            self.help.setToolTip(translate("shell", "Meaning and remedy: {page}").format(page=page))
            self.help.setAccessibleName(translate("shell", "Help on this notice"))
            self.help.clicked.connect(lambda _=False: self.asked.emit(page))
            row.addWidget(self.help, 0, Qt.AlignmentFlag.AlignTop)
        row.addWidget(close, 0, Qt.AlignmentFlag.AlignTop)

    def count_up(self, count: int) -> None:
        """Say how often it was told."""
        self.count = count
        self._message.setText(f"{self.text}  × {count}" if count > 1 else self.text)


class NoticeBar(QWidget):
    """The notices that are still open, newest first, over what else is shown.

    A confirmation goes after 6 s, a warning with the next action, an error when it is closed. While
    the mouse is over them, all stay.

    Signals
    -------
    asked(str) : which page of the help is to be opened.
    more_asked() : those that are not seen are wanted.
    """

    asked = Signal(str)
    more_asked = Signal()

    def __init__(self, window: QMainWindow, clock: Clock = time.monotonic) -> None:
        super().__init__(window)
        self._window, self._clock = window, clock
        self._open: list[Notice] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(4)
        self.more = QToolButton()
        self.more.clicked.connect(self.more_asked)
        self._column.addWidget(self.more, 0, Qt.AlignmentFlag.AlignRight)
        self._timer = QTimer(self, interval=_LOOK_MS)
        self._timer.timeout.connect(self.let_go)
        window.installEventFilter(self)
        self.hide()

    def show_notice(self, level: Level, text: str) -> None:
        """Add a notice on top; one that is there already is counted up."""
        before = next((one for one in self._open if one.text == text), None)
        notice = Notice(level, text, self._clock())
        notice.count_up(before.count + 1 if before is not None else 1)
        if before is not None:
            self._remove(before)
        notice.closed.connect(lambda: self._close(notice))
        notice.asked.connect(self.asked)
        self._open.insert(0, notice)
        self._column.insertWidget(0, notice)
        self._timer.start()
        self._show(anew=True)

    def notices(self) -> list[Notice]:
        """Return the open notices, newest first."""
        return list(self._open)

    def let_go(self) -> None:
        """Let confirmations go that have been read, unless the mouse is over them."""
        if self.isVisible() and self.geometry().contains(self._mouse()):
            return
        before_s = self._clock() - CONFIRMATION_S
        self._drop(Level.INFO, before_s)
        self._drop(Level.GOOD, before_s)
        if not self._open:
            self._timer.stop()

    def act(self) -> None:
        """Let warnings go: the operator has done something else since."""
        self._drop(Level.WARNING, self._clock() - _READ_S)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Stay at the lower right of the window."""
        if event.type() == QEvent.Type.Resize:
            self._place(self._corner(left=False))
        return super().eventFilter(watched, event)

    def _drop(self, level: Level, before_s: float) -> None:
        read = [one for one in self._open if one.level is level and one.since_s <= before_s]
        for one in read:
            self._remove(one)
        if read:
            self._show(anew=False)

    def _close(self, notice: Notice) -> None:
        self._remove(notice)
        self._show(anew=False)

    def _remove(self, notice: Notice) -> None:
        self._open.remove(notice)
        self._column.removeWidget(notice)
        notice.hide()
        notice.deleteLater()

    def _show(self, *, anew: bool) -> None:
        """Show the newest; where one comes up, all go to the other side if the mouse is there."""
        for number, one in enumerate(self._open):
            one.setVisible(number < MOST)
        beyond = len(self._open) - MOST
        self.more.setVisible(beyond > 0)
        self.more.setText(translate("shell", "+{n} more").format(n=beyond))
        self.setVisible(bool(self._open))
        corner = self._corner(left=False)
        if anew and corner.contains(self._mouse()):
            corner = self._corner(left=True)
        self._place(corner)
        self.raise_()

    def _place(self, corner: QRect) -> None:
        if self._open:
            self.setGeometry(corner)

    def _corner(self, *, left: bool) -> QRect:
        window = self._window
        width = min(WIDTH, window.width() - 2 * _MARGIN)
        seen = [*self._open[:MOST], *([self.more] if len(self._open) > MOST else [])]
        gaps = self._column.spacing() * max(len(seen) - 1, 0)
        height = gaps + sum(_height(one, width) for one in seen)
        bar = window.statusBar().height() if window.statusBar().isVisible() else 0
        top = window.height() - bar - _MARGIN - height
        return QRect(_MARGIN if left else window.width() - width - _MARGIN, top, width, height)

    def _mouse(self) -> QPoint:
        return self._window.mapFromGlobal(QCursor.pos())


def _height(widget: QWidget, width: int) -> int:
    wanted = widget.heightForWidth(width) if widget.hasHeightForWidth() else -1
    return min(wanted if wanted > 0 else widget.sizeHint().height(), widget.maximumHeight())
