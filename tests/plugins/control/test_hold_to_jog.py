"""A held jog ends as soon as the release of its button could be missed."""

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

from rotemina.drivers.contract import Gate, VirtualClock
from rotemina.plugins.control.hold_to_jog import MAX_KEY_REPEAT_GAP_S, HoldToJog

LONG_MS = 30_000


@pytest.fixture
def held_jog(qtbot, monkeypatch):
    """A jog button in a tab, held down by its key, and the speeds that it sends."""
    window = QWidget()
    qtbot.addWidget(window)
    tabs, page, field = QTabWidget(), QWidget(), QLineEdit()
    button = QPushButton("+", page)
    tabs.addTab(page, "axes")
    tabs.addTab(QWidget(), "other")
    column = QVBoxLayout(window)
    column.addWidget(tabs)
    column.addWidget(field)
    sent_speeds, clock = [], VirtualClock(1.0)
    gate = Gate(clock)

    def move_velocity(speeds, permit):
        permit.check()
        sent_speeds.append(speeds["x"])

    session = SimpleNamespace(move_velocity=move_velocity, permit=gate.permit)
    workbench = SimpleNamespace(session=session, run_request=lambda request: (request(), True)[1])
    hold_to_jog = HoldToJog(workbench, "x", window, clock)
    hold_to_jog.watch_button(button)
    button.pressed.connect(lambda: hold_to_jog.begin(button, 1e-3))
    button.released.connect(hold_to_jog.end)
    window.show()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow, timeout=LONG_MS)
    button.setFocus()
    qtbot.keyPress(button, Qt.Key.Key_Space)
    assert hold_to_jog.is_active
    assert sent_speeds == [1e-3]
    return SimpleNamespace(**locals())


def open_other_window(held_jog):
    other_window = QWidget()
    held_jog.qtbot.addWidget(other_window)
    other_window.show()
    other_window.activateWindow()
    held_jog.qtbot.waitUntil(other_window.isActiveWindow, timeout=LONG_MS)


def open_menu(held_jog):
    menu = QMenu(held_jog.window)
    menu.addAction("one")
    menu.popup(held_jog.window.pos())
    held_jog.qtbot.addWidget(menu)


def open_dialog(held_jog):
    dialog = QDialog(held_jog.window)
    held_jog.qtbot.addWidget(dialog)
    dialog.open()


def lock_screen(held_jog):
    """Make the application inactive: a lock screen takes the focus from all its windows."""
    held_jog.application_state = Qt.ApplicationState.ApplicationInactive
    held_jog.monkeypatch.setattr(
        QGuiApplication, "applicationState", staticmethod(lambda: held_jog.application_state)
    )


INTERRUPTIONS = {
    "tab": lambda held_jog: held_jog.tabs.setCurrentIndex(1),
    "focus": lambda held_jog: held_jog.field.setFocus(),
    "window": open_other_window,
    "menu": open_menu,
    "dialog": open_dialog,
    "locked screen": lock_screen,
    "lost release": lambda held_jog: held_jog.clock.advance(1.01 * MAX_KEY_REPEAT_GAP_S),
}


@pytest.mark.parametrize("interruption", INTERRUPTIONS)
def test_a_held_jog_ends_when_its_release_could_be_missed(qtbot, held_jog, interruption):
    INTERRUPTIONS[interruption](held_jog)
    held_jog.hold_to_jog._renew_speed()
    assert not held_jog.hold_to_jog.is_active
    assert held_jog.sent_speeds[-1] == 0.0


@pytest.mark.parametrize("action", ["stop", "stop and release"])
def test_a_stop_ends_a_held_jog_although_the_button_stays_down(held_jog, action):
    held_jog.gate.stop("emergency stop" if action == "stop and release" else None)
    if action == "stop and release":
        held_jog.gate.release()
    held_jog.hold_to_jog._renew_speed()
    assert held_jog.button.isDown()
    assert not held_jog.hold_to_jog.is_active
    assert held_jog.sent_speeds == [1e-3]  # the stop halts the axis, so the jog sends no zero speed
    held_jog.hold_to_jog._renew_speed()
    assert held_jog.sent_speeds == [1e-3]


def test_a_held_jog_continues_while_its_key_repeats(held_jog):
    for _ in range(5):
        held_jog.clock.advance(0.9 * MAX_KEY_REPEAT_GAP_S)
        event = QKeyEvent(
            QEvent.Type.KeyPress, Qt.Key.Key_Space, Qt.KeyboardModifier.NoModifier, " ", True
        )
        QApplication.sendEvent(held_jog.button, event)
        held_jog.hold_to_jog._renew_speed()
        assert held_jog.hold_to_jog.is_active
