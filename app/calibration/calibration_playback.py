"""Playback of a calibration motion through a session, with recording of sensor and laser."""

import threading
from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.model import ModelOutputs
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    PROGRAM,
    ConnectionState,
    PlaybackFinished,
    PlaybackRecorder,
    SessionEvent,
    StateChanged,
)
from rotemina.drivers.contract import DeviceSamples, Permit
from rotemina.sim.messages import marked, message
from rotemina.sim.records import Record
from rotemina.sim.trajectory import CheckedTrajectory

NO_LASER = marked(
    "engine",
    "the device provides no laser readings; record the laser with its own program, play the "
    "motion from its file, and fit both records (rotemina calibrate fit --laser)",
)


class CalibrationPlaybackPhase(StrEnum):
    """The phase of a calibration playback."""

    IDLE = "idle"
    MOVING = "moving"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class CalibrationPlaybackState:
    """The phase, the fraction played (0 to 1), and why the playback failed."""

    phase: CalibrationPlaybackPhase = CalibrationPlaybackPhase.IDLE
    progress: float = 0.0
    message: str = ""


class CalibrationPlayback:
    """Plays the calibration motion of one axis; methods may be called from any thread.

    If a calibration of the axis is in use, it is suspended during the playback, so that the raw
    sensor is recorded. A stop of the machine ends the playback, and its data are discarded.

    Parameters
    ----------
    session : MotionSession
    axis : str
    motion : CheckedTrajectory
        Accepted by a dry run for the session's device.
    """

    def __init__(self, session: MotionSession, axis: str, motion: CheckedTrajectory) -> None:
        self._session = session
        self._axis = axis
        self._motion = motion
        self._lock = threading.Lock()
        self._state = CalibrationPlaybackState()
        self._recorder = PlaybackRecorder(motion, session.driver.name, laser=True)
        self._record: Record | None = None
        self._unsubscribers = (session.tap(self._on_samples), session.subscribe(self._on_event))

    @property
    def state(self) -> CalibrationPlaybackState:
        """The present state."""
        with self._lock:
            state = self._state
        if state.phase is not CalibrationPlaybackPhase.MOVING:
            return state
        return CalibrationPlaybackState(
            CalibrationPlaybackPhase.MOVING, self._session.snapshot().progress
        )

    @property
    def record(self) -> Record | None:
        """The record, once the playback is complete."""
        with self._lock:
            return self._record

    def start(self, *, permit: Permit | None = None) -> None:
        """Start the playback; call this once.

        If the operator requested the playback before this call, ``permit`` is the one that was
        issued at the request. By default, one is issued now.

        Raises
        ------
        RequestRefusedError
            If the playback was started before.
        InputError
            See :meth:`MotionSession.play`.
        """
        permit = self._session.permit() if permit is None else permit
        with self._lock:
            if self._state.phase is not CalibrationPlaybackPhase.IDLE:
                raise RequestRefusedError("this run was already started; plan a new one")
            self._state = CalibrationPlaybackState(CalibrationPlaybackPhase.MOVING)
        self._session.corrections.pause(self._axis)
        try:
            self._session.play(self._motion, permit=permit)
        except Exception:
            self._end(CalibrationPlaybackPhase.FAILED, marked("engine", "the motion was refused"))
            raise

    def stop(self, *, by: str = PROGRAM) -> None:
        """Stop the machine and cancel the playback; ``by`` as in :meth:`MotionSession.stop`."""
        self._session.stop(message("engine", "the calibration was cancelled"), by=by)
        self._end(
            CalibrationPlaybackPhase.FAILED, marked("engine", "stopped; the data are discarded")
        )

    def close(self) -> None:
        """Detach from the session; a playback under way is stopped."""
        if self.state.phase is CalibrationPlaybackPhase.MOVING:
            self.stop()
        self._detach()

    def _on_samples(self, samples: DeviceSamples, _model_outputs: ModelOutputs) -> None:
        with self._lock:
            if self._state.phase is not CalibrationPlaybackPhase.MOVING:
                return
            # The reference is the laser.
            if samples.reference is not None:
                self._recorder.add(samples)
                return
        self._session.stop(NO_LASER)
        self._end(CalibrationPlaybackPhase.FAILED, NO_LASER)

    def _on_event(self, event: SessionEvent) -> None:
        if isinstance(event, PlaybackFinished):
            self._finish(event.completed)
        elif isinstance(event, StateChanged) and event.state.connection in (
            ConnectionState.FAILED,
            ConnectionState.DISCONNECTED,
        ):
            self._end(
                CalibrationPlaybackPhase.FAILED,
                marked("engine", "the connection was lost; the data are discarded"),
            )

    def _finish(self, completed: bool) -> None:
        with self._lock:
            if self._state.phase is not CalibrationPlaybackPhase.MOVING:
                return
            if completed:
                self._record = self._recorder.finish()
        if self._record is not None:
            self._end(CalibrationPlaybackPhase.DONE, "")
        else:
            self._end(
                CalibrationPlaybackPhase.FAILED,
                marked("engine", "the motion ended early; the data are discarded"),
            )

    def _end(self, phase: CalibrationPlaybackPhase, reason: str) -> None:
        with self._lock:
            if self._state.phase is not CalibrationPlaybackPhase.MOVING:
                return
            self._state = CalibrationPlaybackState(
                phase, 1.0 if phase is CalibrationPlaybackPhase.DONE else 0.0, reason
            )
        self._session.corrections.resume(self._axis)
        self._detach()

    def _detach(self) -> None:
        for unsubscribe in self._unsubscribers:
            unsubscribe()
