"""The one button that helps in a state: release, reconnect, acknowledge, home, confirm."""

from collections.abc import Callable
from typing import NamedTuple

from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.shell.language import translate
from rotemina.app.shell.operator_requests import Requests
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import plain_tip


class Help(NamedTuple):
    """What a press does."""

    text: str
    tip: str
    run: Callable[[], object]


def help_in(state: SessionState, requests: Requests) -> Help | None:
    """Return what leads out of a state; None where nothing needs to, or no press can."""
    if state.connection is Connection.FAILED:
        return Help(
            translate("shell", "Reconnect"),
            translate("shell", "Connect again to the device"),
            requests.reconnect,
        )
    if state.connection is not Connection.CONNECTED:
        return None
    if state.latched is not None:
        return Help(
            translate("shell", "Release"),
            translate("shell", "Release the lock; nothing moves by itself"),
            requests.release,
        )
    if state.fault is not None:
        return Help(
            translate("shell", "Clear fault"),
            translate("shell", "Acknowledge the fault; nothing moves by itself"),
            requests.clear_fault,
        )
    if state.unhomed:
        return Help(
            translate("shell", "Home"),
            translate(
                "shell", "Find the limit switches of all axes with switches; these axes move"
            ),
            requests.home,
        )
    if state.doubt is not None:
        return Help(
            translate("shell", "Confirm …"),
            translate("shell", "Open the page on which the position is confirmed"),
            lambda: requests.panel_asked.emit("connection"),
        )
    return None


class HelpingButton(ChangingButton):
    """Shows what helps now; unseen where nothing needs to."""

    def __init__(self, requests: Requests) -> None:
        super().__init__("")  # a double click on Release must not home
        self._requests = requests
        self._run: Callable[[], object] | None = None
        self.clicked.connect(lambda _: self._run and self._run())
        self.hide()

    def refresh(self, state: SessionState) -> None:
        """Offer what leads out of a state."""
        offered = help_in(state, self._requests)
        self._run = offered.run if offered else None
        self.setVisible(offered is not None)
        if offered is not None and offered.text != self.text():
            self.setText(offered.text)
            self.setToolTip(plain_tip(offered.tip))
