"""The button that helps: what it does, and that it never does what it did not show."""

import pytest
from PySide6.QtCore import Qt

from rotemina.app.shell.helping_button import HelpingButton
from rotemina.app.shell.window_state import Remedy
from rotemina.drivers.clock import VirtualClock

CALLS = {
    Remedy.CONNECT: "reconnect",
    Remedy.RECONNECT: "reconnect",
    Remedy.RELEASE: "release",
    Remedy.CLEAR_FAULT: "clear_fault",
    Remedy.HOME: "home",
}


class Asked:
    """What was asked for, by name."""

    def __init__(self):
        self.requests = []
        self.panel_asked = self

    def emit(self, name):
        self.requests.append(name)

    def __getattr__(self, name):
        return lambda: self.requests.append(name)


@pytest.fixture
def clock():
    return VirtualClock(10.0)


@pytest.fixture
def asked():
    return Asked()


@pytest.fixture
def button(qtbot, asked, clock):
    made = HelpingButton(asked, clock)
    qtbot.addWidget(made)
    return made


def press(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


@pytest.mark.parametrize("remedy", Remedy)
def test_every_remedy_does_what_it_is_called(qtbot, button, asked, clock, remedy):
    button.show_remedy(remedy)
    clock.advance(0.5)
    button.show_remedy(remedy)
    assert button.isEnabled()
    assert button.text()
    press(qtbot, button)
    assert asked.requests == [CALLS.get(remedy, "connection")]


def test_a_double_click_on_release_does_not_home(qtbot, button, asked, clock):
    for _ in range(2):
        button.show_remedy(Remedy.RELEASE)
        clock.advance(0.5)
    press(qtbot, button)
    press(qtbot, button)  # before the next frame
    button.show_remedy(Remedy.HOME)
    assert not button.isEnabled()
    assert "has only just changed" in button.toolTip()
    press(qtbot, button)
    clock.advance(0.49)
    button.show_remedy(Remedy.HOME)
    press(qtbot, button)
    assert asked.requests == ["release", "release"]
    clock.advance(0.02)
    button.show_remedy(Remedy.HOME)
    press(qtbot, button)
    assert asked.requests[2:] == ["home"]


def test_nothing_to_help_hides_it(button):
    button.show_remedy(Remedy.HOME)
    assert not button.isHidden()
    button.show_remedy(None)
    assert button.isHidden()
