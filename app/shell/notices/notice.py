"""One notice: its full text, how often it occurred, and buttons for remedy, help and closing."""

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

from rotemina.app.language import translate
from rotemina.app.widgets.text import ElidedLabel
from rotemina.app.workbench import Level, NoticeMessage

_WRAP_MODE = QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere


class NoticeText(QTextEdit):
    """Read-only plain text that can be selected; it wraps anywhere and scrolls if needed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.setReadOnly(True)
        self.setAcceptRichText(False)
        self.setUndoRedoEnabled(False)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWordWrapMode(_WRAP_MODE)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        policy = QSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.document().setDocumentMargin(0)
        self.setAccessibleName(translate("shell", "Text of the notice"))
        self.setPlainText(text)

    def hasHeightForWidth(self) -> bool:  # noqa: N802 (Qt's name)
        """Return True: the height depends on the width."""
        return True

    def heightForWidth(self, width: int) -> int:  # noqa: N802 (Qt's name)
        """Return the height of the full text, wrapped at this width."""
        document = QTextDocument()
        document.setDefaultFont(self.font())
        document.setDocumentMargin(0)
        option = document.defaultTextOption()
        option.setWrapMode(_WRAP_MODE)
        document.setDefaultTextOption(option)
        document.setPlainText(self.toPlainText())
        document.setTextWidth(width)
        return int(document.size().height()) + 1

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Request another height when the text size changes."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.updateGeometry()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request one line."""
        return QSize(0, self.fontMetrics().height())

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request one line; the notice gives the text more space."""
        return self.minimumSizeHint()


class Notice(QFrame):
    """One message with buttons for its remedy, its help page and closing.

    Signals
    -------
    closed()
    page_asked(str) : the help page of this name should be opened.
    """

    closed = Signal()
    page_asked = Signal(str)

    def __init__(
        self, level: Level, text: NoticeMessage, since_s: float, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setObjectName("notice")
        self.setProperty("level", str(level))
        self.level, self.text, self.since_s, self.count = level, text, since_s, 1
        # The unsettled causes, one per subject: different requests may fail for the same reason.
        self._causes = [text]
        # Whether the text needs a scroll bar.
        self._is_scrolling = False
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
        button_row = QHBoxLayout()
        self._grid.addLayout(button_row, 0, 1, Qt.AlignmentFlag.AlignTop)
        button_row.setSpacing(2)
        button_row.addWidget(self._tally)
        if page := text.page:
            self.help = self._make_button("?", translate("shell", "Help on this notice"))
            self.help.setToolTip(translate("shell", "Meaning and remedy: {page}").format(page=page))
            self.help.clicked.connect(lambda _=False: self.page_asked.emit(page))
            button_row.addWidget(self.help)
        close = self._make_button("✕", translate("shell", "Close this notice"))
        close.clicked.connect(self.closed)
        button_row.addWidget(close)
        if (remedy := text.remedy) is not None:
            self.remedy = QToolButton()
            self.remedy.setText(remedy.label)
            self.remedy.clicked.connect(lambda _=False: (self.closed.emit(), remedy.run()))
            self._grid.addWidget(self.remedy, 1, 0, 1, 2, Qt.AlignmentFlag.AlignRight)

    def repeat(self, level: Level, text: NoticeMessage, since_s: float) -> None:
        """Count a repeat, whose numbers may differ; :meth:`show_repeats` displays it."""
        self.level, self.text, self.since_s = level, text, since_s
        self.count += 1
        self._causes = [cause for cause in self._causes if cause.subject != text.subject] + [text]

    def settle_causes(self, is_over: Callable[[NoticeMessage], bool]) -> bool:
        """Remove the causes that are over, and return whether all are gone."""
        self._causes = [cause for cause in self._causes if not is_over(cause)]
        return not self._causes

    def show_repeats(self) -> None:
        """Show the latest text and the number of repeats."""
        if self.text != self._body.toPlainText():
            self._body.setPlainText(self.text)
            self._body.updateGeometry()
        tally = f"× {self.count}" if self.count > 1 else ""
        if tally != self._tally.text():
            self._tally.setText(tally)
            self._tally.setVisible(bool(tally))

    def polish(self) -> None:
        """Apply the window's style, on which all sizes depend."""
        for part in (self, *self.findChildren(QWidget)):
            part.ensurePolished()

    def show_at(self, place: QRect) -> None:
        """Show the notice in a rectangle of the window, on top."""
        self._is_scrolling = place.height() < self.heightForWidth(place.width())
        # Qt would keep a scroll bar that was needed at another size, which makes the lines shorter.
        policy = Qt.ScrollBarPolicy
        self._body.setVerticalScrollBarPolicy(
            policy.ScrollBarAsNeeded if self._is_scrolling else policy.ScrollBarAlwaysOff
        )
        self.setGeometry(place)
        self.show()
        self.raise_()

    @property
    def has_room(self) -> bool:
        """Whether the text still fits into the rectangle; a scrolling text always fits."""
        return self._is_scrolling or self.heightForWidth(self.width()) <= self.height()

    def height_for_lines(self, lines: int) -> int:
        """Return the height needed for a number of text lines and all buttons."""
        lines_height = (lines - 1) * self._body.fontMetrics().lineSpacing()
        return self.minimumSizeHint().height() + lines_height

    @property
    def letter_width_px(self) -> int:
        """The average width of a letter of the text, px."""
        return self._body.fontMetrics().averageCharWidth()

    def _make_button(self, symbol: str, name: str) -> QToolButton:
        button = QToolButton()
        button.setText(symbol)
        button.setAutoRaise(True)
        button.setToolTip(name)
        button.setAccessibleName(name)
        return button


class NoticeStrip(QFrame):
    """One line above the status bar for notices that have no free place.

    Signals
    -------
    closed() : the user closed the visible notice.
    more_asked() : the user asked to see all notices.
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

    def show_notices(self, unplaced: Notice | None, further_count: int) -> None:
        """Show the text of a notice that has no free place, and the number of further notices."""
        self.setProperty("level", "" if unplaced is None else str(unplaced.level))
        self.text.setVisible(unplaced is not None)
        self.close_button.setVisible(unplaced is not None)
        if unplaced is not None:
            tally = f"  × {unplaced.count}" if unplaced.count > 1 else ""
            first_line = next(iter(unplaced.text.splitlines()), "")
            self.text.show_text(f"{first_line}{tally}")
        self.more.setText(
            translate("shell", "+{n} more").format(n=further_count)
            if further_count
            else translate("shell", "Show")
        )
        self.style().polish(self)
        self.setVisible(unplaced is not None or further_count > 0)
