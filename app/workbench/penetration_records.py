"""Automatic recordings of penetrations, unless a recording is already running."""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from rotemina.app.motion.penetration import RUNNING_PHASES, PenetrationPhase
from rotemina.app.motion.recording import SessionRecorder
from rotemina.app.operation import OperatorControl
from rotemina.app.workbench.background import BackgroundWorker
from rotemina.drivers.contract import Clock

# The recording continues for this time after a motion, to measure the gap.
_TAIL_S = 0.5
_CLOSE_TIMEOUT_S = 5.0
_RECORDING_NAME = "penetration"
_RECORDED_PHASES = RUNNING_PHASES | {PenetrationPhase.ARMED}


class PenetrationRecorder(QObject):
    """Recorder that records each penetration from arming until it has ended or is held.

    A penetration that was armed but never started is not kept. If a recording is already running,
    it contains the penetration and is not changed.

    Signals
    -------
    stored(Path) : a penetration was written to a separate file.
    """

    stored = Signal(object)

    def __init__(
        self,
        operation: OperatorControl,
        warn: Callable[[str], None],
        clock: Clock = time.monotonic,
    ) -> None:
        super().__init__()
        self._operation, self._warn, self._clock = operation, warn, clock
        self._background = BackgroundWorker(self)
        self._phase = PenetrationPhase.DISARMED
        self._recorder: SessionRecorder | None = None
        # Whether a penetration was started during this recording.
        self._was_started = False
        self._end_time_s: float | None = None

    def update_recording(self) -> None:
        """Start or stop the recording if necessary; to be called in every frame."""
        if self._background.busy:
            return
        previous_phase, self._phase = self._phase, self._operation.penetration.status.phase
        running_recorder = self._operation.recording
        if self._recorder is not None and running_recorder is not self._recorder:
            # The operator has ended this recording.
            self._recorder = None
        self._was_started |= self._phase in RUNNING_PHASES
        if self._phase in _RECORDED_PHASES:
            self._end_time_s = None
            if previous_phase not in _RECORDED_PHASES and running_recorder is None:
                self._was_started = self._phase in RUNNING_PHASES
                self._background.run("begin", self._start_recording, self._on_started, self._warn)
        elif self._recorder is not None:
            now_s = self._clock()
            self._end_time_s = now_s if self._end_time_s is None else self._end_time_s
            if now_s - self._end_time_s >= _TAIL_S:
                recorder, self._recorder = self._recorder, None
                # The next penetration may begin meanwhile.
                self._phase = PenetrationPhase.DISARMED
                end = partial(self._stop_recording, recorder, self._was_started)
                self._background.run("end", end, self._on_stopped, self._warn)

    def close(self) -> None:
        """Wait until everything is written."""
        self._background.end(_CLOSE_TIMEOUT_S)

    def _start_recording(self) -> SessionRecorder | None:
        self._operation.start_recording(name=_RECORDING_NAME)
        return self._operation.recording

    def _on_started(self, recorder: SessionRecorder | None) -> None:
        self._recorder = recorder

    def _stop_recording(self, recorder: SessionRecorder, was_started: bool) -> Path | None:
        if self._operation.recording is not recorder:
            # The operator has ended this recording and may have started another one.
            return None
        path = self._operation.stop_recording()
        if not was_started:
            path.unlink(missing_ok=True)
        return path if was_started else None

    def _on_stopped(self, path: Path | None) -> None:
        if path is not None:
            self.stored.emit(path)
