"""Text that is drawn smaller rather than cut where there is too little room for it."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QFont, QFontInfo, QFontMetrics, QPaintEvent
from PySide6.QtWidgets import QPushButton, QStyle, QStyleOptionButton, QStylePainter

_SMALLEST = 6  # px


def fitted_font(font: QFont, text: str, width: int) -> QFont:
    """Return a font in which each line of a text fits into a width, smaller only if it must be."""
    lines = text.split("\n")
    fitted = font
    while (size := QFontInfo(fitted).pixelSize()) > _SMALLEST:
        needed = max(map(QFontMetrics(fitted).horizontalAdvance, lines))
        if needed <= width:
            break
        fitted = QFont(font)
        fitted.setPixelSize(max(min(size - 1, int(size * width / needed)), _SMALLEST))
    return fitted


class FittedButton(QPushButton):
    """A button whose text is drawn smaller rather than cut where the button is too narrow."""

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the text in the font of the style where it fits, and in a smaller one elsewhere."""
        option = QStyleOptionButton()
        self.initStyleOption(option)
        inner = self.style().subElementRect(QStyle.SubElement.SE_PushButtonContents, option, self)
        font = fitted_font(self.font(), self.text(), inner.width())
        if font == self.font():
            super().paintEvent(event)
            return
        option.text = ""
        painter = QStylePainter(self)
        painter.drawControl(QStyle.ControlElement.CE_PushButton, option)
        painter.setFont(font)
        painter.setPen(self.palette().buttonText().color())
        painter.drawText(inner, int(Qt.AlignmentFlag.AlignCenter), self.text())
