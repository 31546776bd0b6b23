"""Text that is drawn in a smaller font, instead of being cut, if there is too little space."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QFont, QFontInfo, QFontMetrics, QPaintEvent
from PySide6.QtWidgets import QPushButton, QStyle, QStyleOptionButton, QStylePainter

_MIN_FONT_PX = 6


def fit_font(font: QFont, text: str, width: int) -> QFont:
    """Return the largest font, up to the given one, in which each line fits into a width."""
    lines = text.split("\n")
    fitted = font
    while (size := QFontInfo(fitted).pixelSize()) > _MIN_FONT_PX:
        needed_width = max(map(QFontMetrics(fitted).horizontalAdvance, lines))
        if needed_width <= width:
            break
        fitted = QFont(font)
        fitted.setPixelSize(max(min(size - 1, int(size * width / needed_width)), _MIN_FONT_PX))
    return fitted


class FittedButton(QPushButton):
    """Button whose text is drawn smaller instead of being cut if the button is too narrow."""

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the text in the font of the style if it fits, else in a smaller one."""
        option = QStyleOptionButton()
        self.initStyleOption(option)
        text_area = self.style().subElementRect(
            QStyle.SubElement.SE_PushButtonContents, option, self
        )
        font = fit_font(self.font(), self.text(), text_area.width())
        if font == self.font():
            super().paintEvent(event)
            return
        option.text = ""
        painter = QStylePainter(self)
        painter.drawControl(QStyle.ControlElement.CE_PushButton, option)
        painter.setFont(font)
        painter.setPen(self.palette().buttonText().color())
        painter.drawText(text_area, int(Qt.AlignmentFlag.AlignCenter), self.text())
