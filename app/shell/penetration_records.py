"""The records of penetrations: each is recorded by itself where nothing records all anyway."""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from rotemina.app.motion.operation import Operation
from rotemina.app.motion.penetration.status import UNDER_WAY, Phase
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.app.shell.background import Background
from rotemina.drivers.clock import Clock

_AFTER_S = 0.5  # for which the gap counts on after a motion
_CLOSING_S = 5.0
_NAME = "penetration"
_RECORDED = UNDER_WAY | {Phase.ARMED}


class PenetrationRecords(QObject):
    """Records each penetration, from its arming until it has ended or is held.

    What was armed and never started is not kept. A recording that runs already holds it, and is
    left alone.

    Signals
    -------
    stored(Path) : a penetration is in a file of its own.
    """

    stored = Signal(object)

    def __init__(
        self,
        operation: Operation,
        told: Callable[[str], None],
        clock: Clock = time.monotonic,
    ) -> None:
        super().__init__()
        self._operation, self._told, self._clock = operation, told, clock
        self._background = Background(self)
        self._phase = Phase.DISARMED
        self._own: SessionRecorder | None = None
        self._ran = False  # whether anything was started in what is recorded
        self._ended_s: float | None = None

    def look(self) -> None:
        """Begin or end what is to be recorded; to be called in every frame."""
        if self._background.busy:
            return
        before, self._phase = self._phase, self._operation.penetration.status.phase
        running = self._operation.recording
        if self._own is not None and running is not self._own:
            self._own = None  # somebody ended it
        self._ran |= self._phase in UNDER_WAY
        if self._phase in _RECORDED:
            self._ended_s = None
            if before not in _RECORDED and running is None:
                self._ran = self._phase in UNDER_WAY
                self._background.run("begin", self._begin, self._begun, self._told)
        elif self._own is not None:
            now_s = self._clock()
            self._ended_s = now_s if self._ended_s is None else self._ended_s
            if now_s - self._ended_s >= _AFTER_S:
                own, self._own = self._own, None
                self._phase = Phase.DISARMED  # the next one may begin meanwhile
                end = partial(self._end, own, self._ran)
                self._background.run("end", end, self._kept, self._told)

    def close(self) -> None:
        """Wait for what is being written."""
        self._background.end(_CLOSING_S)

    def _begin(self) -> SessionRecorder | None:
        self._operation.start_recording(name=_NAME)
        return self._operation.recording

    def _begun(self, recorder: SessionRecorder | None) -> None:
        self._own = recorder

    def _end(self, own: SessionRecorder, ran: bool) -> Path | None:
        if self._operation.recording is not own:
            return None  # the operator has ended it since, and may record something else
        path = self._operation.stop_recording()
        if not ran:
            path.unlink(missing_ok=True)
        return path if ran else None

    def _kept(self, path: Path | None) -> None:
        if path is not None:
            self.stored.emit(path)
