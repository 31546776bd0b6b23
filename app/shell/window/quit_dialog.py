"""Questions to the operator, and work to wait for, before the window closes."""

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.language import translate
from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import SessionPhase, SessionState
from rotemina.app.workbench import (
    FRAME_MS,
    Level,
    Workbench,
)
from rotemina.drivers.contract import DeviceState


class WindowCloser:
    """Decision whether a window may close now, and closing it later if it must wait."""

    def __init__(self, window: QWidget, workbench: Workbench) -> None:
        self._window, self._workbench = window, workbench
        self._is_closing = False

    def may_close(self) -> bool:
        """Return whether to close at once.

        The operator is asked before moving axes are stopped, but not again after a stop was
        requested. The window waits until a recording or other work has ended. If it is closed a
        second time meanwhile, it closes at once; the recording can then be recovered.
        """
        bench = self._workbench
        state = bench.session.snapshot()
        if is_moving(state) and not _may_stop(self._window, state):
            return False
        if not state.stopping:
            bench.stop()
        is_playing = bench.playback.state.phase is PlaybackPhase.PLAYING
        # The order matters: an end is counted before the playback reports it.
        if not self._is_closing and (
            is_playing or bench.session.snapshot().stopping or bench.has_unhandled_playback
        ):
            QTimer.singleShot(FRAME_MS, self._window, self._window.close)
            return False
        if not self._is_closing and (bench.operation.recording is not None or bench.busy):
            self._close_later()
            return False
        if bench.records.unsaved is not None and not _may_lose_record(self._window):
            self._is_closing = False
            return False
        self._is_closing = True
        return True

    def _close_later(self) -> None:
        """Close the window once the recording is written, which may take a long time."""
        self._is_closing = True
        self._workbench.notify(
            Level.INFO,
            translate(
                "shell",
                "The window closes as soon as everything is written. Close it again to "
                "quit at once; the recording can then be recovered at the next start.",
            ),
        )
        self._workbench.finish_recording(self._window.close, self._cancel_closing)

    def _cancel_closing(self) -> None:
        self._is_closing = False


def is_moving(state: SessionState) -> bool:
    """Return whether anything moves or is about to move, and no stop was requested."""
    return state.phase is SessionPhase.MOVING or (
        state.phase is SessionPhase.READY and bool(state.owners)
    )


def _may_stop(parent: QWidget, state: SessionState) -> bool:
    is_playing = state.activity is DeviceState.PLAYING
    return _ask(
        parent,
        translate(
            "shell", "A trajectory is playing. Quitting stops it and keeps the record so far."
        )
        if is_playing
        else translate("shell", "The machine is moving. Quitting stops it."),
        translate("shell", "Stop and quit"),
    )


def _may_lose_record(parent: QWidget) -> bool:
    return _ask(
        parent,
        translate(
            "shell",
            "The record of the last playback is not saved: quitting now loses it. To "
            "save it, stay and press Ctrl+S.",
        ),
        translate("shell", "Quit and lose it"),
    )


def _ask(parent: QWidget, text: str, quit_label: str) -> bool:
    box = QMessageBox(QMessageBox.Icon.Question, translate("shell", "Quit"), text, parent=parent)
    stay_button = box.addButton(translate("shell", "Stay"), QMessageBox.ButtonRole.RejectRole)
    quit_button = box.addButton(quit_label, QMessageBox.ButtonRole.DestructiveRole)
    box.setDefaultButton(stay_button)
    box.setEscapeButton(stay_button)
    box.exec()
    return box.clickedButton() is quit_button
