"""Small manners of controls: one that cannot act says why, and a long text is cut with dots."""

from html import escape

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QKeySequence, QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QProgressBar, QSizePolicy, QWidget

from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate

_WHY_NOT = "whyNot"
_TOLD = "_told_why_not"


def plain_tip(*lines: str) -> str:
    """Return a tooltip whose lines are no markup, whatever they hold."""
    return f"<qt>{'<br>'.join(escape(line) for line in lines if line)}</qt>"


def native_keys(shortcut: str) -> str:
    """Return a shortcut such as ``Ctrl+S`` as keyboards of the window's language have it."""
    return QKeySequence(shortcut).toString(QKeySequence.SequenceFormat.NativeText)


def allow(widget: QWidget, why_not: str | None, tip: str) -> None:
    """Enable a control, or disable it with a tooltip that says why it cannot act."""
    widget.setEnabled(why_not is None)
    told = why_not, tip
    if getattr(widget, _TOLD, None) == told:
        return  # panels ask for every control in every frame
    setattr(widget, _TOLD, told)
    text = plain_tip(
        tip,
        translate("shell", "Not now: {why_not}").format(why_not=spoken(why_not)) if why_not else "",
    )
    widget.setToolTip(text)
    widget.setProperty(_WHY_NOT, why_not or "")


def why_not(widget: QWidget) -> str | None:
    """Return why a control cannot act, as :func:`allow` was told last."""
    return widget.property(_WHY_NOT) or None


def fill(bar: QProgressBar, value: int) -> None:
    """Set how full a bar is; it is painted with the rest of the window.

    Left to itself it would be painted at once, and with it, in one go, all of the window that waits
    to be painted: many times a second, in the middle of something else.
    """
    if bar.value() != value:
        bar.setUpdatesEnabled(False)
        bar.setValue(value)
        bar.setUpdatesEnabled(True)


class ElidedLabel(QLabel):
    """One line of plain text that takes what room there is; its tooltip has all of it."""

    def __init__(self) -> None:
        super().__init__()
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)

    def show_text(self, text: str) -> None:
        """Show another text."""
        if text != self.text():
            self.setText(text)
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
        cut = self.fontMetrics().elidedText(
            self.text(), Qt.TextElideMode.ElideRight, self.contentsRect().width()
        )
        painter.drawText(self.contentsRect(), int(Qt.AlignmentFlag.AlignVCenter), cut)
        painter.end()
