"""What is out of sight is drawn once it comes into sight, not before and not twice."""

import pytest
from PySide6.QtWidgets import QTabWidget, QWidget

from rotemina.app.widgets.when_seen import WhenSeen


@pytest.fixture
def tabs(qtbot):
    tabs = QTabWidget()
    qtbot.addWidget(tabs)
    for name in ("first", "second"):
        tabs.addTab(QWidget(), name)
    return tabs


def test_in_a_window_that_is_not_shown_yet_all_is_drawn(tabs):
    drawn = []
    draw = WhenSeen(tabs.widget(1), lambda: drawn.append(1))
    draw()
    assert drawn == [1]


def test_behind_another_tab_it_waits_and_is_drawn_once(qtbot, tabs):
    drawn = []
    draw = WhenSeen(tabs.widget(1), lambda: drawn.append(1))
    with qtbot.waitExposed(tabs):
        tabs.show()
    for _ in range(3):
        draw()
    assert drawn == []
    tabs.setCurrentIndex(1)
    qtbot.waitUntil(lambda: drawn == [1])
    draw()
    assert drawn == [1, 1]
    tabs.setCurrentIndex(0)
    tabs.setCurrentIndex(1)
    qtbot.wait(1)
    assert drawn == [1, 1]


def test_one_that_is_hidden_again_at_once_goes_on_waiting(qtbot, tabs):
    drawn = []
    draw = WhenSeen(tabs.widget(1), lambda: drawn.append(1))
    with qtbot.waitExposed(tabs):
        tabs.show()
    draw()
    tabs.setCurrentIndex(1)
    tabs.setCurrentIndex(0)
    qtbot.wait(1)
    assert drawn == []
    tabs.setCurrentIndex(1)
    qtbot.waitUntil(lambda: drawn == [1])
