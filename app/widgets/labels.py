"""Labels: elided lines, quiet lines, headings, coloured names."""

from collections.abc import Iterable
from html import escape

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QSizePolicy

from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.fitted_text import fitted_font
from rotemina.app.widgets.when_dressed import WhenDressed

_FORM = str.maketrans("123456789-−", "000000000++")  # any digit as the widest, and any sign
_LINES = "lines"  # property of a label: how many it always has room for


class ElidedLabel(QLabel):
    """One line of plain text that takes the available room; its tooltip has all of it.

    It keeps its text by itself: Qt's label would have all of the window laid out anew at each one.
    """

    def __init__(self) -> None:
        super().__init__()
        self._text = ""
        self._shorter: tuple[str, ...] = ()
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)

    def text(self) -> str:
        """Return all of the text."""
        return self._text

    def setText(self, text: str) -> None:  # noqa: N802 (Qt's name)
        """Show another text, with the same tooltip."""
        if bool(text) != bool(self._text):
            super().setText(" " if text else "")  # for its height
        if self.accessibleName() == self._text:
            self.setAccessibleName(text)
        self._text, self._shorter = text, ()
        self.update()

    def show_text(self, text: str, *shorter: str) -> None:
        """Show another text, or the first of its ever shorter forms that there is room for."""
        if text != self._text:
            self.setText(text)
            self._shorter = shorter
            self.setToolTip(plain_tip(text) if text else "")

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for no width: it takes what the others leave."""
        return self.minimumSizeHint()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for no width at all."""
        return QSize(0, super().minimumSizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw as much of the text as there is room for."""
        painter = QPainter(self)
        painter.setPen(self.palette().color(self.foregroundRole()))
        metrics, room = self.fontMetrics(), self.contentsRect().width()
        forms = (self._text, *self._shorter)
        text = next((one for one in forms if metrics.horizontalAdvance(one) <= room), forms[-1])
        cut = metrics.elidedText(text, Qt.TextElideMode.ElideRight, room)
        painter.drawText(self.contentsRect(), int(Qt.AlignmentFlag.AlignVCenter), cut)
        painter.end()


class LiveLabel(QLabel):
    """Plain text whose digits change at every frame.

    Qt's label would have all of the window laid out anew at each text. This one has that done for
    another form of it alone: any number of as many digits takes the same place, with any sign.
    Where it has less room than it asks for, it is drawn smaller and not cut.
    """

    def __init__(self, text: str = "", *, quiet: bool = False) -> None:
        super().__init__()
        self._text = ""
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setProperty("quiet", quiet)
        self.setText(text)

    def text(self) -> str:
        """Return the text."""
        return self._text

    def setText(self, text: str) -> None:  # noqa: N802 (Qt's name)
        """Show another text."""
        if text == self._text:
            return
        if self.accessibleName() == self._text:  # a screen reader would read the form
            self.setAccessibleName(text)
        self._text = text
        form = text.translate(_FORM)
        if form != super().text():
            super().setText(form)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the text."""
        painter = QPainter(self)
        self.drawFrame(painter)
        painter.setPen(self.palette().color(self.foregroundRole()))
        flags, room = int(self.alignment()), self.contentsRect()
        if self.frameWidth():  # from which Qt's label keeps half an x away
            away = self.fontMetrics().horizontalAdvance("x") // 2
            right = bool(self.alignment() & Qt.AlignmentFlag.AlignRight)
            room.adjust(0 if right else away, 0, -away if right else 0, 0)
        if self.wordWrap():
            flags |= int(Qt.TextFlag.TextWordWrap)
        elif self.width() < self.sizeHint().width():
            painter.setFont(fitted_font(self.font(), self._text, room.width()))
        painter.drawText(room, flags, self._text)
        painter.end()


def heading(text: str) -> QLabel:
    """Return a heading."""
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setProperty("heading", True)
    return label


def plain_text(text: str = "", *, quiet: bool = True, wrap: bool = False, lines: int = 0) -> QLabel:
    """Return a label whose text is no markup.

    With ``wrap`` it breaks into lines as it needs; with ``lines`` too, and always has room for so
    many.
    """
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setProperty("quiet", quiet)
    label.setWordWrap(wrap or lines > 0)
    if lines:
        label.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        keep_lines(label, lines)
        WhenDressed(label, lambda: _fit_lines(label))
    return label


def keep_lines(label: QLabel, lines: int) -> None:
    """Give a label room for so many lines, whatever is in it: what is below must not leap."""
    label.setProperty(_LINES, lines)
    _fit_lines(label)


def _fit_lines(label: QLabel) -> None:
    label.setFixedHeight(label.property(_LINES) * label.fontMetrics().lineSpacing() + 2)


def show_text(label: QLabel, text: str) -> None:
    """Show a text; an empty one takes no room."""
    if text != label.text():
        label.setText(text)
    if label.isHidden() is bool(text):
        label.setVisible(bool(text))


def hint(text: str) -> QLabel:
    """Return a quiet text in the middle of a place where there is nothing to show yet."""
    label = plain_text(text, wrap=True)
    label.setAlignment(Qt.AlignmentFlag.AlignCenter)
    return label


def legend(theme: Theme, names: Iterable[tuple[str, str]], *, mark: str = "") -> str:
    """Return names, each with the role of its colour, as rich text; ``mark`` has it alone."""

    def coloured(text: str, role: str) -> str:
        return f'<span style="color:{getattr(theme, role)}">{text}</span>'

    if mark:
        return "&nbsp; ".join(f"{coloured(mark, role)}&nbsp;{escape(n)}" for n, role in names)
    return ", ".join(coloured(escape(name), role) for name, role in names)
