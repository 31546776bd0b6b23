"""A button whose meaning changes keeps its room, and a double click on it counts once."""

import pytest
from PySide6.QtCore import Qt

from rotemina.app.widgets.changing_button import ChangingButton


@pytest.fixture
def button(qtbot):
    clicks = []
    made = ChangingButton("Play", "Pause", "Resume", run=lambda: clicks.append(made.text()))
    made.clicks = clicks
    qtbot.addWidget(made)
    return made


def test_its_size_is_the_same_whatever_it_says(button):
    sizes = set()
    for text in ("Play", "Pause", "Resume"):
        button.show_meaning(text)
        sizes.add((button.sizeHint().toTuple(), button.minimumSizeHint().toTuple()))
    assert len(sizes) == 1


def test_the_second_click_of_a_double_click_does_not_resume(qtbot, button):
    left = Qt.MouseButton.LeftButton
    button.show_meaning("Pause", stops=True)
    button.clicked.connect(lambda: button.show_meaning("Resume"))
    qtbot.mouseClick(button, left)
    qtbot.mouseDClick(button, left)
    qtbot.mouseRelease(button, left)
    assert button.clicks == ["Pause"]
    qtbot.mouseClick(button, left)
    assert button.clicks == ["Pause", "Resume"]


def test_every_click_stops(qtbot, button):
    button.show_meaning("Pause", stops=True)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    qtbot.mouseDClick(button, Qt.MouseButton.LeftButton)
    qtbot.mouseRelease(button, Qt.MouseButton.LeftButton)
    assert button.clicks == ["Pause", "Pause"]
