"""The one button that helps in a state: release, reconnect, acknowledge, home, confirm."""

import time
from collections.abc import Callable
from typing import NamedTuple

from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.operator_requests import Requests
from rotemina.app.shell.steady_meaning import SteadyMeaning
from rotemina.app.shell.window_state import Remedy
from rotemina.app.widgets.controls import allow
from rotemina.app.widgets.fitted_text import FittedButton
from rotemina.drivers.clock import Clock


class _Help(NamedTuple):
    """What a press does."""

    text: str
    tip: str
    run: Callable[[Requests], object]


def _open_connection_page(requests: Requests) -> None:
    requests.panel_asked.emit("connection")


_HELP = {
    Remedy.CONNECT: _Help(
        marked("shell", "Connect"),
        marked("shell", "Connect to the device that was used last"),
        lambda requests: requests.reconnect(),
    ),
    Remedy.RECONNECT: _Help(
        marked("shell", "Reconnect"),
        marked("shell", "Connect again to the device"),
        lambda requests: requests.reconnect(),
    ),
    Remedy.RELEASE: _Help(
        marked("shell", "Release"),
        marked("shell", "Release the lock; nothing moves by itself"),
        lambda requests: requests.release(),
    ),
    Remedy.CLEAR_FAULT: _Help(
        marked("shell", "Clear fault"),
        marked("shell", "Acknowledge the fault; nothing moves by itself"),
        lambda requests: requests.clear_fault(),
    ),
    Remedy.COMPARE_PARAMETERS: _Help(
        marked("shell", "Compare …"),
        marked("shell", "Open the page on which parameters are written or accepted"),
        _open_connection_page,
    ),
    Remedy.HOME: _Help(
        marked("shell", "Home"),
        marked("shell", "Find the limit switches of all axes with switches; these axes move"),
        lambda requests: requests.home(),
    ),
    Remedy.CONFIRM: _Help(
        marked("shell", "Confirm …"),
        marked("shell", "Open the page on which the position is confirmed"),
        _open_connection_page,
    ),
}


class HelpingButton(FittedButton):
    """Shows what helps now; hidden where nothing needs to.

    What it does changes with the state. It is disabled until it has shown the same remedy for half
    a second: the second press of a double click on *Release* must not press *Home*.
    """

    def __init__(self, requests: Requests, clock: Clock = time.monotonic) -> None:
        super().__init__("")
        self._requests = requests
        self._remedy: Remedy | None = None
        self._meaning = SteadyMeaning(clock)
        self.clicked.connect(lambda _: self._press())
        self.hide()

    def show_remedy(self, remedy: Remedy | None) -> None:
        """Offer what leads out of a state."""
        self._remedy = remedy
        self._meaning.show(remedy)
        self.setVisible(remedy is not None)
        if remedy is None:
            return
        text = translate("shell", _HELP[remedy].text)
        if text != self.text():
            self.setText(text)
        changed = translate("shell", "the button has only just changed")
        settled = self._meaning.is_settled(remedy)
        allow(self, None if settled else changed, translate("shell", _HELP[remedy].tip))

    def _press(self) -> None:
        if self._remedy is not None and self._meaning.is_settled(self._remedy):
            _HELP[self._remedy].run(self._requests)
