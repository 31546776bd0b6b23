"""One notice: its whole text, how often it came, and buttons for its remedy, help and closing."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QRect, QSize, Qt, Signal
from PySide6.QtGui import QTextDocument, QTextOption
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QTextEdit,
    QToolButton,
    QWidget,
)

from rotemina.app.shell.help_topics import Explained
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Level
from rotemina.app.widgets.labels import ElidedLabel

_WRAP = QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere


class NoticeText(QTextEdit):
    """Plain text to read, select and copy; it wraps anywhere, and scrolls where it must."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.setReadOnly(True)
        self.setAcceptRichText(False)
        self.setUndoRedoEnabled(False)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWordWrapMode(_WRAP)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        policy = QSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.document().setDocumentMargin(0)
        self.setAccessibleName(translate("shell", "Text of the notice"))
        self.setPlainText(text)

    def hasHeightForWidth(self) -> bool:  # noqa: N802 (Qt's name)
        """Say that the height follows from the width."""
        return True

    def heightForWidth(self, width: int) -> int:  # noqa: N802 (Qt's name)
        """Return the height of the whole text in lines of this width."""
        measured = QTextDocument()
        measured.setDefaultFont(self.font())
        measured.setDocumentMargin(0)
        option = measured.defaultTextOption()
        option.setWrapMode(_WRAP)
        measured.setDefaultTextOption(option)
        measured.setPlainText(self.toPlainText())
        measured.setTextWidth(width)
        return int(measured.size().height()) + 1

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Ask for another height where the text has another size."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.updateGeometry()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for one line."""
        return QSize(0, self.fontMetrics().height())

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for one line; the notice has room for more."""
        return self.minimumSizeHint()


class Notice(QFrame):
    """One message with buttons: for its remedy, for the page on it, and to close it.

    Signals
    -------
    closed()
    asked(str) : which page is to be opened.
    """

    closed = Signal()
    asked = Signal(str)

    def __init__(
        self, level: Level, text: Explained, since_s: float, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setObjectName("notice")
        self.setProperty("level", str(level))
        self.level, self.text, self.since_s, self.count = level, text, since_s, 1
        self._causes = [text]  # one of each subject: other requests may fail for the same reason
        self._is_cut = False  # whether its text scrolls for want of room
        self._body, self._tally = NoticeText(text), QLabel()
        self._tally.setObjectName("tally")
        self._tally.setTextFormat(Qt.TextFormat.PlainText)
        self._tally.hide()
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(10, 4, 6, 4)
        self._grid.setHorizontalSpacing(4)
        self._grid.setVerticalSpacing(2)
        self._grid.setColumnStretch(0, 1)
        self._grid.addWidget(self._body, 0, 0)
        side = QHBoxLayout()
        self._grid.addLayout(side, 0, 1, Qt.AlignmentFlag.AlignTop)
        side.setSpacing(2)
        side.addWidget(self._tally)
        if page := text.page:
            self.help = self._button("?", translate("shell", "Help on this notice"))
            self.help.setToolTip(translate("shell", "Meaning and remedy: {page}").format(page=page))
            self.help.clicked.connect(lambda _=False: self.asked.emit(page))
            side.addWidget(self.help)
        close = self._button("✕", translate("shell", "Close this notice"))
        close.clicked.connect(self.closed)
        side.addWidget(close)
        if (remedy := text.remedy) is not None:
            self.remedy = QToolButton()
            self.remedy.setText(remedy.words)
            self.remedy.clicked.connect(lambda _=False: (self.closed.emit(), remedy.do()))
            self._grid.addWidget(self.remedy, 1, 0, 1, 2, Qt.AlignmentFlag.AlignRight)

    def repeat(self, level: Level, text: Explained, since_s: float) -> None:
        """Count a repeat, which may have other values; :meth:`show_repeats` shows it."""
        self.level, self.text, self.since_s = level, text, since_s
        self.count += 1
        self._causes = [one for one in self._causes if one.subject != text.subject] + [text]

    def settle(self, is_over: Callable[[Explained], bool]) -> bool:
        """Forget the causes that are over; return whether that were all."""
        self._causes = [one for one in self._causes if not is_over(one)]
        return not self._causes

    def show_repeats(self) -> None:
        """Show the latest text, and how often it came."""
        if self.text != self._body.toPlainText():
            self._body.setPlainText(self.text)
            self._body.updateGeometry()
        tally = f"× {self.count}" if self.count > 1 else ""
        if tally != self._tally.text():
            self._tally.setText(tally)
            self._tally.setVisible(bool(tally))

    def polish(self) -> None:
        """Take on the window's style, on which all sizes depend."""
        for part in (self, *self.findChildren(QWidget)):
            part.ensurePolished()

    def stand(self, place: QRect) -> None:
        """Show it at a place of the window, on top."""
        self._is_cut = place.height() < self.heightForWidth(place.width())
        # Qt would keep a bar that was needed at another size: it makes the lines shorter.
        policy = Qt.ScrollBarPolicy
        self._body.setVerticalScrollBarPolicy(
            policy.ScrollBarAsNeeded if self._is_cut else policy.ScrollBarAlwaysOff
        )
        self.setGeometry(place)
        self.show()
        self.raise_()

    @property
    def fits(self) -> bool:
        """Whether its place is as large as when it was given; a text that scrolls fits always."""
        return self._is_cut or self.heightForWidth(self.width()) <= self.height()

    def height_of(self, lines: int) -> int:
        """Return the height that shows so many lines of the text, and all of its buttons."""
        lines_height = (lines - 1) * self._body.fontMetrics().lineSpacing()
        return self.minimumSizeHint().height() + lines_height

    @property
    def letter_width(self) -> int:
        """The usual width of a letter of the text, px."""
        return self._body.fontMetrics().averageCharWidth()

    def _button(self, sign: str, name: str) -> QToolButton:
        button = QToolButton()
        button.setText(sign)
        button.setAutoRaise(True)
        button.setToolTip(name)
        button.setAccessibleName(name)
        return button


class NoticeStrip(QFrame):
    """One line over the status bar, for notices that there is no place for.

    Signals
    -------
    closed() : the notice whose text it shows is acknowledged.
    more_asked() : all of them are to be shown.
    """

    closed = Signal()
    more_asked = Signal()

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("notice")
        self.text = ElidedLabel()
        self.more, self.close_button = QToolButton(), QToolButton()
        self.more.clicked.connect(self.more_asked)
        self.close_button.setText("✕")
        self.close_button.setAutoRaise(True)
        self.close_button.setAccessibleName(translate("shell", "Close this notice"))
        self.close_button.setToolTip(translate("shell", "Close this notice"))
        self.close_button.clicked.connect(self.closed)
        row = QHBoxLayout(self)
        row.setContentsMargins(6, 0, 2, 0)
        row.setSpacing(4)
        row.addWidget(self.text, 1)
        row.addWidget(self.more)
        row.addWidget(self.close_button)
        self.hide()

    def show_notices(self, unplaced: Notice | None, beyond: int) -> None:
        """Show the text of a notice without a place, and how many more there are."""
        self.setProperty("level", "" if unplaced is None else str(unplaced.level))
        self.text.setVisible(unplaced is not None)
        self.close_button.setVisible(unplaced is not None)
        if unplaced is not None:
            tally = f"  × {unplaced.count}" if unplaced.count > 1 else ""
            self.text.show_text(f"{unplaced.text.splitlines()[0]}{tally}")
        self.more.setText(
            translate("shell", "+{n} more").format(n=beyond)
            if beyond
            else translate("shell", "Show")
        )
        self.style().polish(self)
        self.setVisible(unplaced is not None or beyond > 0)
