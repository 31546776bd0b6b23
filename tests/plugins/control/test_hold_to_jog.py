"""A jog that is held ends with whatever may lose its release."""

from types import SimpleNamespace

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QGuiApplication, QKeyEvent
from PySide6.QtWidgets import (
    QApplication,
    QDialog,
    QLineEdit,
    QMenu,
    QPushButton,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.gate import Gate
from rotemina.plugins.control.hold_to_jog import REPEATED_S, Holding

LONG_MS = 30_000


@pytest.fixture
def held(qtbot, monkeypatch):
    """A button in a tab of a window, held down by its key, and the speeds that it sends."""
    window = QWidget()
    qtbot.addWidget(window)
    tabs, page, field = QTabWidget(), QWidget(), QLineEdit()
    button = QPushButton("+", page)
    tabs.addTab(page, "axes")
    tabs.addTab(QWidget(), "other")
    column = QVBoxLayout(window)
    column.addWidget(tabs)
    column.addWidget(field)
    sent, clock = [], VirtualClock(1.0)
    gate = Gate(clock)

    def move_velocity(speeds, permit):
        permit.check()
        sent.append(speeds["x"])

    session = SimpleNamespace(move_velocity=move_velocity, permit=gate.permit)
    bench = SimpleNamespace(session=session, ask=lambda request: (request(), True)[1])
    holding = Holding(bench, "x", window, clock)
    holding.watch(button)
    button.pressed.connect(lambda: holding.begin(button, 1e-3))
    button.released.connect(holding.end)
    window.show()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow, timeout=LONG_MS)
    button.setFocus()
    qtbot.keyPress(button, Qt.Key.Key_Space)
    assert holding.busy
    assert sent == [1e-3]
    return SimpleNamespace(**locals())


def other_window(held):
    second = QWidget()
    held.qtbot.addWidget(second)
    second.show()
    second.activateWindow()
    held.qtbot.waitUntil(second.isActiveWindow, timeout=LONG_MS)


def popup(held):
    menu = QMenu(held.window)
    menu.addAction("one")
    menu.popup(held.window.pos())
    held.qtbot.addWidget(menu)


def dialog(held):
    asked = QDialog(held.window)
    held.qtbot.addWidget(asked)
    asked.open()


def locked_screen(held):
    """The lock takes the keyboard: no window of the program has the focus any more."""
    held.application_state = Qt.ApplicationState.ApplicationInactive
    held.monkeypatch.setattr(
        QGuiApplication, "applicationState", staticmethod(lambda: held.application_state)
    )


TAKEN = {
    "tab": lambda held: held.tabs.setCurrentIndex(1),
    "focus": lambda held: held.field.setFocus(),
    "window": other_window,
    "menu": popup,
    "dialog": dialog,
    "locked screen": locked_screen,
    "lost release": lambda held: held.clock.advance(1.01 * REPEATED_S),
}


@pytest.mark.parametrize("taken", TAKEN)
def test_it_ends_where_its_release_may_be_lost(qtbot, held, taken):
    TAKEN[taken](held)
    held.holding._renew()
    assert not held.holding.busy
    assert held.sent[-1] == 0.0


@pytest.mark.parametrize("way", ["stop", "stop and release"])
def test_a_stop_ends_it_although_the_button_stays_down(held, way):
    held.gate.stop("emergency stop" if way == "stop and release" else None)
    if way == "stop and release":
        held.gate.release()
    held.holding._renew()
    assert held.button.isDown()
    assert not held.holding.busy
    assert held.sent == [1e-3]  # not even a halt: the stop has done that
    held.holding._renew()
    assert held.sent == [1e-3]


def test_a_key_that_repeats_goes_on(held):
    for _ in range(5):
        held.clock.advance(0.9 * REPEATED_S)
        event = QKeyEvent(
            QEvent.Type.KeyPress, Qt.Key.Key_Space, Qt.KeyboardModifier.NoModifier, " ", True
        )
        QApplication.sendEvent(held.button, event)
        held.holding._renew()
        assert held.holding.busy
