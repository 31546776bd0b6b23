"""A hidden widget is drawn once when it becomes visible, not before and not twice."""

import pytest
from PySide6.QtWidgets import QTabWidget, QWidget

from rotemina.app.widgets.style import OnVisible


@pytest.fixture
def tabs(qtbot):
    tabs = QTabWidget()
    qtbot.addWidget(tabs)
    for name in ("first", "second"):
        tabs.addTab(QWidget(), name)
    return tabs


def test_a_widget_is_drawn_if_its_window_is_not_shown_yet(tabs):
    calls = []
    draw = OnVisible(tabs.widget(1), lambda: calls.append(1))
    draw()
    assert calls == [1]


def test_a_widget_behind_another_tab_is_drawn_once_when_shown(qtbot, tabs):
    calls = []
    draw = OnVisible(tabs.widget(1), lambda: calls.append(1))
    with qtbot.waitExposed(tabs):
        tabs.show()
    for _ in range(3):
        draw()
    assert calls == []
    tabs.setCurrentIndex(1)
    qtbot.waitUntil(lambda: calls == [1])
    draw()
    assert calls == [1, 1]
    tabs.setCurrentIndex(0)
    tabs.setCurrentIndex(1)
    qtbot.wait(1)
    assert calls == [1, 1]


def test_a_widget_that_is_hidden_again_at_once_is_not_drawn(qtbot, tabs):
    calls = []
    draw = OnVisible(tabs.widget(1), lambda: calls.append(1))
    with qtbot.waitExposed(tabs):
        tabs.show()
    draw()
    tabs.setCurrentIndex(1)
    tabs.setCurrentIndex(0)
    qtbot.wait(1)
    assert calls == []
    tabs.setCurrentIndex(1)
    qtbot.waitUntil(lambda: calls == [1])
