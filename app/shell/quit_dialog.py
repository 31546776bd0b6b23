"""What is asked, and waited for, before the window closes."""

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import Phase, SessionState
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import FRAME_MS, Level, Workbench
from rotemina.drivers.samples import DeviceState


class Leaving:
    """Tells whether a window may close, and closes it later where it must wait."""

    def __init__(self, window: QWidget, workbench: Workbench) -> None:
        self._window, self._workbench = window, workbench
        self._begun = False

    def may_close(self) -> bool:
        """Return whether to close at once.

        What moves is asked about, and stopped; a recording, or other work, that has yet to end is
        waited for. To close the window again then leaves at once: what was recorded stays to
        be recovered. What a stop has been asked for is not asked about again.
        """
        bench = self._workbench
        state = bench.session.snapshot()
        if moves(state) and not _may_stop(self._window, state):
            return False
        if not state.stopping:
            bench.stop()
        ends = bench.playback.state.phase is PlaybackPhase.PLAYING
        # In this order: what has just ended is counted before the playback says that it has.
        if not self._begun and (ends or bench.session.snapshot().stopping or bench.untold):
            QTimer.singleShot(FRAME_MS, self._window, self._window.close)
            return False
        if not self._begun and (bench.operation.recording is not None or bench.busy):
            self._close_later()
            return False
        if bench.unsaved is not None and not _may_lose_record(self._window):
            self._begun = False
            return False
        self._begun = True
        return True

    def _close_later(self) -> None:
        """Close when a recording is in its file, which may take long; the window lives on."""
        self._begun = True
        self._workbench.notify(
            Level.INFO,
            translate(
                "shell",
                "The window closes as soon as everything is written. Close it again to "
                "leave at once; the recording can then be recovered at the next start.",
            ),
        )
        self._workbench.finish_recording(self._window.close, self._stay)

    def _stay(self) -> None:
        self._begun = False


def moves(state: SessionState) -> bool:
    """Whether something moves that nobody has stopped yet, or is about to continue."""
    return state.phase is Phase.MOVING or (state.phase is Phase.READY and bool(state.owners))


def _may_stop(parent: QWidget, state: SessionState) -> bool:
    """Ask whether to stop what moves, and quit; it continues until that is answered."""
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


def _may_lose_record(parent: QWidget) -> bool:
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
