"""What is asked before the window closes."""

from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.motion.state import Phase, SessionState
from rotemina.app.shell.language import translate
from rotemina.drivers.samples import DeviceState


def moves(state: SessionState) -> bool:
    """Whether something moves that nobody has stopped yet, or is about to go on."""
    return state.phase is Phase.MOVING or (state.phase is Phase.READY and bool(state.owners))


def may_stop(parent: QWidget, state: SessionState) -> bool:
    """Ask whether to stop what moves, and quit; it goes on until that is answered."""
    playing = state.activity is DeviceState.PLAYING
    return _asked(
        parent,
        translate(
            "shell", "A trajectory is playing. Quitting stops it and keeps the record so far."
        )
        if playing
        else translate("shell", "The machine is moving. Quitting stops it."),
        translate("shell", "Stop and quit"),
    )


def may_lose_record(parent: QWidget) -> bool:
    """Ask whether to quit though the last played record could not be written."""
    return _asked(
        parent,
        translate(
            "shell",
            "The record of the last playback is not saved: quitting now loses it. To "
            "save it, stay and press Ctrl+S.",
        ),
        translate("shell", "Quit and lose it"),
    )


def _asked(parent: QWidget, text: str, leave: str) -> bool:
    box = QMessageBox(QMessageBox.Icon.Question, translate("shell", "Quit"), text, parent=parent)
    stay = box.addButton(translate("shell", "Stay"), QMessageBox.ButtonRole.RejectRole)
    quit_ = box.addButton(leave, QMessageBox.ButtonRole.DestructiveRole)
    box.setDefaultButton(stay)
    box.setEscapeButton(stay)
    box.exec()
    return box.clickedButton() is quit_
