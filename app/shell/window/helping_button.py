"""The button that offers the remedy for a state: release, reconnect, home, confirm and others."""

import time
from collections.abc import Callable
from typing import NamedTuple

from rotemina.app.language import marked, translate
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.widgets.text import FittedButton
from rotemina.app.workbench import ButtonMeaning, OperatorRequests, StateRemedy
from rotemina.drivers.contract import Clock


class _RemedyAction(NamedTuple):
    text: str
    tip: str
    run: Callable[[OperatorRequests], object]


def _show_connection_panel(requests: OperatorRequests) -> None:
    requests.panel_asked.emit("connection")


_REMEDY_ACTIONS = {
    StateRemedy.CONNECT: _RemedyAction(
        marked("shell", "Connect"),
        marked("shell", "Connect to the device that was used last"),
        lambda requests: requests.reconnect(),
    ),
    StateRemedy.RECONNECT: _RemedyAction(
        marked("shell", "Reconnect"),
        marked("shell", "Connect again to the device"),
        lambda requests: requests.reconnect(),
    ),
    StateRemedy.RELEASE: _RemedyAction(
        marked("shell", "Release"),
        marked("shell", "Release the lock; nothing moves by itself"),
        lambda requests: requests.release(),
    ),
    StateRemedy.CLEAR_FAULT: _RemedyAction(
        marked("shell", "Clear fault"),
        marked("shell", "Acknowledge the fault; nothing moves by itself"),
        lambda requests: requests.clear_fault(),
    ),
    StateRemedy.COMPARE_PARAMETERS: _RemedyAction(
        marked("shell", "Compare …"),
        marked("shell", "Open the page on which parameters are written or accepted"),
        _show_connection_panel,
    ),
    StateRemedy.HOME: _RemedyAction(
        marked("shell", "Home"),
        marked("shell", "Find the limit switches of all axes with switches; these axes move"),
        lambda requests: requests.home(),
    ),
    StateRemedy.CONFIRM: _RemedyAction(
        marked("shell", "Confirm …"),
        marked("shell", "Open the page on which the position is confirmed"),
        _show_connection_panel,
    ),
}


class RemedyButton(FittedButton):
    """Button that offers the remedy for the current state; hidden if none is needed.

    Its action changes with the state. It stays disabled until it has shown the same remedy for half
    a second: the second press of a double click on *Release* must not press *Home*.
    """

    def __init__(self, requests: OperatorRequests, clock: Clock = time.monotonic) -> None:
        super().__init__("")
        self._requests = requests
        self._remedy: StateRemedy | None = None
        self._meaning = ButtonMeaning(clock)
        self.clicked.connect(lambda _: self._press())
        self.hide()

    def show_remedy(self, remedy: StateRemedy | None) -> None:
        """Offer a remedy; None hides the button."""
        self._remedy = remedy
        self._meaning.set_meaning(remedy)
        self.setVisible(remedy is not None)
        if remedy is None:
            return
        text = translate("shell", _REMEDY_ACTIONS[remedy].text)
        if text != self.text():
            self.setText(text)
        reason = translate("shell", "the button has only just changed")
        is_settled = self._meaning.is_settled(remedy)
        enable_unless(
            self, None if is_settled else reason, translate("shell", _REMEDY_ACTIONS[remedy].tip)
        )

    def _press(self) -> None:
        if self._remedy is not None and self._meaning.is_settled(self._remedy):
            _REMEDY_ACTIONS[self._remedy].run(self._requests)
