"""Text is drawn smaller where it has too little room, and lines break rather than being cut."""

import itertools

import pytest
from PySide6.QtCore import QRect
from PySide6.QtGui import QFont, QFontMetrics
from PySide6.QtWidgets import QPushButton, QWidget

from rotemina.app.widgets.fitted_text import FittedButton, fitted_font
from rotemina.app.widgets.flow_layout import FlowLayout
from rotemina.app.widgets.labels import ElidedLabel


def font_of(pixels):
    font = QFont()
    font.setPixelSize(pixels)
    return font


@pytest.mark.parametrize("text", ["Reconnect", "Stop\nand lock at once"])
def test_a_font_is_only_as_small_as_a_text_needs(qapp, text):
    font = font_of(26)
    needed = max(map(QFontMetrics(font).horizontalAdvance, text.split("\n")))
    assert fitted_font(font, text, needed) == font
    for width in (needed - 1, needed // 2, needed // 3):
        fitted = fitted_font(font, text, width)
        assert max(map(QFontMetrics(fitted).horizontalAdvance, text.split("\n"))) <= width
        larger = font_of(fitted.pixelSize() + 2)
        assert max(map(QFontMetrics(larger).horizontalAdvance, text.split("\n"))) > width


def strokes(button):
    """Count the upright strokes in the picture of a button."""
    picture = button.grab().toImage()
    row, inner = picture.height() // 2, range(4, picture.width() - 4)
    ink = [picture.pixel(x, row) != picture.pixel(4, row) for x in inner]
    return sum(now and not before for before, now in itertools.pairwise(ink))


def test_a_narrow_button_shows_all_of_its_text(qtbot):
    button = FittedButton("I I I I I I I I")
    button.setStyleSheet("font-size: 40px; padding: 2px;")
    qtbot.addWidget(button)
    button.resize(button.sizeHint())
    assert strokes(button) == 8
    button.resize(button.width() * 2 // 3, button.height())
    assert strokes(button) == 8


@pytest.mark.parametrize(("width", "lines"), [(400, 1), (230, 2), (100, 4)])
def test_a_row_breaks_into_the_lines_that_it_needs(qtbot, width, lines):
    box = QWidget()
    qtbot.addWidget(box)
    row = FlowLayout(box)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(10)
    parts = [QPushButton() for _ in range(3)]
    for part in parts:
        part.setFixedSize(90, 20)
        row.addWidget(part)
    rest = ElidedLabel()
    rest.setFixedHeight(20)
    rest.setMinimumWidth(40)
    row.addWidget(rest)
    assert row.heightForWidth(width) == 30 * lines - 10
    box.resize(width, 200)
    box.show()
    places = [part.geometry() for part in (*parts, rest)]
    assert all(QRect(0, 0, width, 200).contains(place) for place in places)
    assert not any(one.intersects(other) for one in places for other in places if one is not other)
    assert places[-1].right() == width - 1  # takes what is left
