"""Text is drawn smaller if it has too little room, and rows break instead of being cut."""

import itertools

import pytest
from PySide6.QtCore import QRect
from PySide6.QtGui import QFont, QFontMetrics
from PySide6.QtWidgets import QPushButton, QWidget

from rotemina.app.widgets.layout import FlowLayout
from rotemina.app.widgets.text import ElidedLabel, FittedButton
from rotemina.app.widgets.text.fitted_text import fit_font


def make_font(pixels):
    font = QFont()
    font.setPixelSize(pixels)
    return font


@pytest.mark.parametrize("text", ["Reconnect", "Stop\nand lock at once"])
def test_a_font_shrinks_only_as_much_as_needed(qapp, text):
    font = make_font(26)
    needed = max(map(QFontMetrics(font).horizontalAdvance, text.split("\n")))
    assert fit_font(font, text, needed) == font
    for width in (needed - 1, needed // 2, needed // 3):
        fitted = fit_font(font, text, width)
        assert max(map(QFontMetrics(fitted).horizontalAdvance, text.split("\n"))) <= width
        larger = make_font(fitted.pixelSize() + 2)
        assert max(map(QFontMetrics(larger).horizontalAdvance, text.split("\n"))) > width


def count_strokes(button):
    """Count the upright strokes in the picture of a button."""
    picture = button.grab().toImage()
    row, inner = picture.height() // 2, range(4, picture.width() - 4)
    ink = [picture.pixel(x, row) != picture.pixel(4, row) for x in inner]
    return sum(is_ink and not was_ink for was_ink, is_ink in itertools.pairwise(ink))


def test_a_narrow_button_shows_all_of_its_text(qtbot):
    button = FittedButton("I I I I I I I I")
    button.setStyleSheet("font-size: 40px; padding: 2px;")
    qtbot.addWidget(button)
    button.resize(button.sizeHint())
    assert count_strokes(button) == 8
    button.resize(button.width() * 2 // 3, button.height())
    assert count_strokes(button) == 8


@pytest.mark.parametrize(("width", "lines"), [(400, 1), (230, 2), (100, 4)])
def test_a_row_breaks_into_as_many_lines_as_needed(qtbot, width, lines):
    box = QWidget()
    qtbot.addWidget(box)
    row = FlowLayout(box)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(10)
    parts = [QPushButton() for _ in range(3)]
    for part in parts:
        part.setFixedSize(90, 20)
        row.addWidget(part)
    label = ElidedLabel()
    label.setFixedHeight(20)
    label.setMinimumWidth(40)
    row.addWidget(label)
    assert row.heightForWidth(width) == 30 * lines - 10
    box.resize(width, 200)
    box.show()
    rectangles = [part.geometry() for part in (*parts, label)]
    assert all(QRect(0, 0, width, 200).contains(rectangle) for rectangle in rectangles)
    assert not any(
        first.intersects(second)
        for first in rectangles
        for second in rectangles
        if first is not second
    )
    assert rectangles[-1].right() == width - 1  # takes the remaining width
