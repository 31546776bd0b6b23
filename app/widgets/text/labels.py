"""Labels: elided lines, quiet lines, headings, coloured names."""

from collections.abc import Iterable
from html import escape
from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QSizePolicy

from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.style import OnStyleChange, Theme
from rotemina.app.widgets.text.fitted_text import fit_font
from rotemina.sim.compatibility import serve_former_names

# Maps each digit to the widest digit, and each sign to the widest sign.
_WIDEST_CHARS = str.maketrans("123456789-−", "000000000++")
# Dynamic property of a label: the number of lines for which it reserves space.
_LINES_PROPERTY = "lines"


class ElidedLabel(QLabel):
    """One line of plain text, cut to the available width; the tooltip contains the whole text.

    The label stores the text itself, because Qt's label would lay out the whole window at each
    change.
    """

    def __init__(self) -> None:
        super().__init__()
        self._text = ""
        self._shorter_forms: tuple[str, ...] = ()
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)

    def text(self) -> str:
        """Return the whole text."""
        return self._text

    def setText(self, text: str) -> None:  # noqa: N802 (Qt's name)
        """Show another text and keep the tooltip."""
        if bool(text) != bool(self._text):
            # A space gives the label the height of one line.
            super().setText(" " if text else "")
        if self.accessibleName() == self._text:
            self.setAccessibleName(text)
        self._text, self._shorter_forms = text, ()
        self.update()

    def show_text(self, text: str, *shorter: str) -> None:
        """Show another text, or the first of its shorter forms that fits."""
        if text != self._text:
            self.setText(text)
            self._shorter_forms = shorter
            self.setToolTip(make_tooltip(text) if text else "")

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request no width; the label takes what the others leave."""
        return self.minimumSizeHint()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request no width."""
        return QSize(0, super().minimumSizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw as much of the text as fits."""
        painter = QPainter(self)
        painter.setPen(self.palette().color(self.foregroundRole()))
        metrics, width = self.fontMetrics(), self.contentsRect().width()
        forms = (self._text, *self._shorter_forms)
        text = next((form for form in forms if metrics.horizontalAdvance(form) <= width), forms[-1])
        elided_text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, width)
        painter.drawText(self.contentsRect(), int(Qt.AlignmentFlag.AlignVCenter), elided_text)
        painter.end()


class LiveLabel(QLabel):
    """Plain text whose digits change in every frame.

    Qt's label would lay out the whole window at each new text. This label reserves the space of the
    widest digit for each digit, and of the widest sign for each sign. The window is only laid out
    again when the number of digits or another part of the text changes. If there is too little
    space, the text is drawn smaller instead of being cut.
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
        # Otherwise a screen reader would read the text with the widest digits.
        if self.accessibleName() == self._text:
            self.setAccessibleName(text)
        self._text = text
        widest_form = text.translate(_WIDEST_CHARS)
        if widest_form != super().text():
            super().setText(widest_form)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the text."""
        painter = QPainter(self)
        self.drawFrame(painter)
        painter.setPen(self.palette().color(self.foregroundRole()))
        flags, rect = int(self.alignment()), self.contentsRect()
        # With a frame, Qt's label indents the text by half the width of an x.
        if self.frameWidth():
            indent = self.fontMetrics().horizontalAdvance("x") // 2
            is_right_aligned = bool(self.alignment() & Qt.AlignmentFlag.AlignRight)
            rect.adjust(0 if is_right_aligned else indent, 0, -indent if is_right_aligned else 0, 0)
        if self.wordWrap():
            flags |= int(Qt.TextFlag.TextWordWrap)
        elif self.width() < self.sizeHint().width():
            painter.setFont(fit_font(self.font(), self._text, rect.width()))
        painter.drawText(rect, flags, self._text)
        painter.end()


def make_heading(text: str) -> QLabel:
    """Return a heading."""
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setProperty("heading", True)
    return label


def make_plain_label(
    text: str = "", *, quiet: bool = True, wrap: bool = False, lines: int = 0
) -> QLabel:
    """Return a label whose text is not markup.

    With ``wrap`` the text is wrapped. With ``lines`` it is wrapped too, and space for that many
    lines is always reserved.
    """
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setProperty("quiet", quiet)
    label.setWordWrap(wrap or lines > 0)
    if lines:
        label.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        reserve_lines(label, lines)
        OnStyleChange(label, lambda: _fit_lines(label))
    return label


def reserve_lines(label: QLabel, lines: int) -> None:
    """Reserve space for a number of lines in a label, so that widgets below it do not move."""
    label.setProperty(_LINES_PROPERTY, lines)
    _fit_lines(label)


def _fit_lines(label: QLabel) -> None:
    label.setFixedHeight(label.property(_LINES_PROPERTY) * label.fontMetrics().lineSpacing() + 2)


def show_or_hide_text(label: QLabel, text: str) -> None:
    """Show a text; hide the label if the text is empty."""
    if text != label.text():
        label.setText(text)
    if label.isHidden() is bool(text):
        label.setVisible(bool(text))


def make_hint(text: str) -> QLabel:
    """Return a quiet, centred text for a place where there is nothing to show yet."""
    label = make_plain_label(text, wrap=True)
    label.setAlignment(Qt.AlignmentFlag.AlignCenter)
    return label


def make_colour_legend(theme: Theme, names: Iterable[tuple[str, str]], *, mark: str = "") -> str:
    """Return names in the colours of their roles as rich text.

    If ``mark`` is given, it is put before each name and only the mark is coloured.
    """

    def colour_text(text: str, role: str) -> str:
        return f'<span style="color:{getattr(theme, role)}">{text}</span>'

    if mark:
        return "&nbsp; ".join(f"{colour_text(mark, role)}&nbsp;{escape(n)}" for n, role in names)
    return ", ".join(colour_text(escape(name), role) for name, role in names)


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        heading="make_heading",
        hint="make_hint",
        keep_lines="reserve_lines",
        legend="make_colour_legend",
        plain_text="make_plain_label",
        show_text="show_or_hide_text",
    )
