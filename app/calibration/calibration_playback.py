"""Plays a calibration motion through a session and records sensor and laser."""

import threading
from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.motion.live_models import ModelOutputs
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.recorder import PlaybackRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection, Event, PlaybackFinished, StateChanged
from rotemina.app.motion.stop import PROGRAM
from rotemina.drivers.gate import Permit
from rotemina.drivers.samples import Samples
from rotemina.sim.messages import marked, message
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory

NO_LASER = marked(
    "engine",
    "the device provides no laser readings; record the laser with its own program, play the "
    "motion from its file, and fit both records (rotemina calibrate fit --laser)",
)


class Phase(StrEnum):
    """How far a run has come."""

    IDLE = "idle"
    MOVING = "moving"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class RunState:
    """The phase, how much was played, 0 to 1, and why it failed."""

    phase: Phase = Phase.IDLE
    progress: float = 0.0
    message: str = ""


class CalibrationRun:
    """Plays the motion of one axis; every method from any thread.

    A calibration of the axis that is on does not act meanwhile, so that the sensor is seen as it
    is. Whatever stops the machine ends the run; nothing is kept of it then.

    Parameters
    ----------
    session : MotionSession
    axis : str
    motion : CheckedTrajectory
        As a dry run for the session's device allowed it.
    """

    def __init__(self, session: MotionSession, axis: str, motion: CheckedTrajectory) -> None:
        self._session = session
        self._axis = axis
        self._motion = motion
        self._lock = threading.Lock()
        self._state = RunState()
        self._recorder = PlaybackRecorder(motion, session.driver.name, laser=True)
        self._record: Record | None = None
        self._ends = (session.tap(self._on_samples), session.subscribe(self._on_event))

    @property
    def state(self) -> RunState:
        """The present state."""
        with self._lock:
            state = self._state
        if state.phase is not Phase.MOVING:
            return state
        return RunState(Phase.MOVING, self._session.snapshot().progress)

    @property
    def record(self) -> Record | None:
        """The record, once the run is done."""
        with self._lock:
            return self._record

    def start(self, *, permit: Permit | None = None) -> None:
        """Begin, once; ``permit`` is that of the request, where it was made before this call.

        Raises
        ------
        RefusedError
            If it was begun before.
        InputError
            As :meth:`MotionSession.play`.
        """
        permit = self._session.permit() if permit is None else permit
        with self._lock:
            if self._state.phase is not Phase.IDLE:
                raise RefusedError(
                    message("engine", "this run was already started; plan a new one")
                )
            self._state = RunState(Phase.MOVING)
        self._session.corrections.pause(self._axis)
        try:
            self._session.play(self._motion, permit=permit)
        except Exception:
            self._end(Phase.FAILED, marked("engine", "the motion was refused"))
            raise

    def stop(self, *, by: str = PROGRAM) -> None:
        """Stop the machine, and give the run up; ``by`` as of :meth:`MotionSession.stop`."""
        self._session.stop(message("engine", "the calibration was cancelled"), by=by)
        self._end(Phase.FAILED, marked("engine", "stopped; the data are discarded"))

    def close(self) -> None:
        """Have nothing more to do with the session; a run that moves is stopped."""
        if self.state.phase is Phase.MOVING:
            self.stop()
        self._detach()

    def _on_samples(self, samples: Samples, _answers: ModelOutputs) -> None:
        with self._lock:
            if self._state.phase is not Phase.MOVING:
                return
            if samples.reference is not None:
                self._recorder.add(samples)
                return
        self._session.stop(NO_LASER)
        self._end(Phase.FAILED, NO_LASER)

    def _on_event(self, event: Event) -> None:
        if isinstance(event, PlaybackFinished):
            self._finish(event.completed)
        elif isinstance(event, StateChanged) and event.state.connection in (
            Connection.FAILED,
            Connection.DISCONNECTED,
        ):
            self._end(
                Phase.FAILED, marked("engine", "the connection was lost; the data are discarded")
            )

    def _finish(self, completed: bool) -> None:
        with self._lock:
            if self._state.phase is not Phase.MOVING:
                return
            if completed:
                self._record = self._recorder.finish()
        if self._record is not None:
            self._end(Phase.DONE, "")
        else:
            self._end(
                Phase.FAILED, marked("engine", "the motion ended early; the data are discarded")
            )

    def _end(self, phase: Phase, message: str) -> None:
        with self._lock:
            if self._state.phase is not Phase.MOVING:
                return
            self._state = RunState(phase, 1.0 if phase is Phase.DONE else 0.0, message)
        self._session.corrections.resume(self._axis)
        self._detach()

    def _detach(self) -> None:
        for end in self._ends:
            end()
