"""A button whose meaning changes keeps its size, and a double click on it counts once."""

import pytest
from PySide6.QtCore import Qt

from rotemina.app.widgets.controls import ChangingButton


@pytest.fixture
def button(qtbot):
    clicks = []
    changing_button = ChangingButton(
        "Play", "Pause", "Resume", run=lambda: clicks.append(changing_button.text())
    )
    changing_button.clicks = clicks
    qtbot.addWidget(changing_button)
    return changing_button


def test_the_size_does_not_depend_on_the_meaning(button):
    sizes = set()
    for text in ("Play", "Pause", "Resume"):
        button.show_meaning(text)
        sizes.add((button.sizeHint().toTuple(), button.minimumSizeHint().toTuple()))
    assert len(sizes) == 1


@pytest.mark.parametrize("resumes", [False, True])
def test_every_click_stops_but_the_second_of_a_double_click_does_not_resume(qtbot, button, resumes):
    left = Qt.MouseButton.LeftButton
    button.show_meaning("Pause", stops=True)
    if resumes:
        button.clicked.connect(lambda: button.show_meaning("Resume"))
    qtbot.mouseClick(button, left)
    qtbot.mouseDClick(button, left)
    qtbot.mouseRelease(button, left)
    assert button.clicks == (["Pause"] if resumes else ["Pause", "Pause"])
    if resumes:
        qtbot.mouseClick(button, left)
        assert button.clicks == ["Pause", "Resume"]
