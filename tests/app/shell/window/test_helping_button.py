"""The remedy button does only what it has shown for long enough."""

import pytest
from PySide6.QtCore import Qt

from rotemina.app.shell.window.helping_button import RemedyButton
from rotemina.app.workbench import StateRemedy
from rotemina.drivers.contract import VirtualClock

CALLS = {
    StateRemedy.CONNECT: "reconnect",
    StateRemedy.RECONNECT: "reconnect",
    StateRemedy.RELEASE: "release",
    StateRemedy.CLEAR_FAULT: "clear_fault",
    StateRemedy.HOME: "home",
}


class RecordingWorkbench:
    """A workbench that records the names of the requests."""

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
def workbench():
    return RecordingWorkbench()


@pytest.fixture
def button(qtbot, workbench, clock):
    remedy_button = RemedyButton(workbench, clock)
    qtbot.addWidget(remedy_button)
    return remedy_button


def press(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


@pytest.mark.parametrize("remedy", StateRemedy)
def test_every_remedy_makes_its_request(qtbot, button, workbench, clock, remedy):
    button.show_remedy(remedy)
    clock.advance(0.5)
    button.show_remedy(remedy)
    assert button.isEnabled()
    assert button.text()
    press(qtbot, button)
    assert workbench.requests == [CALLS.get(remedy, "connection")]


def test_a_double_click_on_release_does_not_home(qtbot, button, workbench, clock):
    for _ in range(2):
        button.show_remedy(StateRemedy.RELEASE)
        clock.advance(0.5)
    press(qtbot, button)
    press(qtbot, button)  # before the next frame
    button.show_remedy(StateRemedy.HOME)
    assert not button.isEnabled()
    assert "has only just changed" in button.toolTip()
    press(qtbot, button)
    clock.advance(0.49)
    button.show_remedy(StateRemedy.HOME)
    press(qtbot, button)
    assert workbench.requests == ["release", "release"]
    clock.advance(0.02)
    button.show_remedy(StateRemedy.HOME)
    press(qtbot, button)
    assert workbench.requests[2:] == ["home"]


def test_the_button_is_hidden_without_a_remedy(button):
    button.show_remedy(StateRemedy.HOME)
    assert not button.isHidden()
    button.show_remedy(None)
    assert button.isHidden()
