"""The state of a motion session, and its events."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from enum import StrEnum
from types import MappingProxyType
from typing import TYPE_CHECKING

from rotemina.app.motion.model import ModelInUse
from rotemina.app.motion.state.recorder import RunModelOutputs
from rotemina.app.motion.state.stop_send_latency import LatencyStatistics
from rotemina.drivers.contract import DeviceState, LinkQuality
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.messages import (
    AxisName,
    join_messages,
    message,
)
from rotemina.sim.records import Record

# Requester of stops that no person has requested.
PROGRAM = "program"
# Reason of a stop by the button or key "Stop and lock".
STOP_AND_LOCK_REASON = message("engine", "stop and lock")
NOT_CONNECTED = message("engine", "not connected; connect first")


@dataclass(frozen=True, slots=True)
class StopRequest:
    """One stop.

    Attributes
    ----------
    by : str
        ``ownership.OPERATOR`` if a person requested it, or else ``PROGRAM``.
    why : str
        The reason. It may be empty for a stop by the operator.
    at : datetime
        Local time of the request.
    """

    by: str
    why: str
    at: datetime

    def __str__(self) -> str:
        """Return a sentence for the operator."""
        time_text = f"{self.at:%H:%M:%S}"
        if self.why:
            return message("engine", "Stopped by the {who} at {time}: {why}").fill(
                who=self.by, time=time_text, why=self.why
            )
        return message("engine", "Stopped by the {who} at {time}").fill(who=self.by, time=time_text)


class ConnectionState(StrEnum):
    """State of the connection between session and device."""

    DISCONNECTED = "disconnected"
    CONNECTING = "connecting"
    CONNECTED = "connected"
    FAILED = "failed"


class SessionPhase(StrEnum):
    """Phase of the session, as shown to the operator."""

    DISCONNECTED = "disconnected"
    CONNECTING = "connecting"
    READY = "ready"
    MOVING = "moving"
    STOPPING = "stopping"
    SHORT_LOSS = "short loss"
    FAULT = "fault"
    POSITION_UNKNOWN = "position unknown"


@dataclass(frozen=True, slots=True)
class SessionState:
    """The state of a session at one moment.

    Attributes
    ----------
    connection : ConnectionState
    activity : DeviceState
        Activity of the device; ``closed`` without a connection.
    measured, command, model, nominal : mapping axis -> float
        Latest reading, applied command, and outputs of the model in use and the nominal one, m or
        rad; empty before the first sample. After a lost connection the last values remain.
    model_id : str
        Id of the model in use.
    unsettled : tuple of str
        Axes whose past is not known well enough for the model in use, so its output may be wrong.
    device_time_s : float or None
        Device time of the latest sample.
    sample_host_time_s : float or None
        Host time at which the latest sample was received.
    age_s : float or None
        Age of the latest sample when the snapshot was taken (host time).
    last_motion_s : float
        Host time at which the device last reported a motion.
    progress : float
        Progress of the current or latest playback, 0 to 1.
    queued : int
        Number of commands that wait for the worker.
    position_known : bool
    fault : str or None
        Reason for the latest failure or device fault, until it is cleared.
    lock_reason : str or None
        Why no motion is accepted now, or None.
    unhomed : tuple of str
        Axes whose position is unknown.
    silent_s : float
        Time for which the device has sent nothing although data were due; 0 if it answers.
    stopping : bool
        Whether a stop was requested and the device has not reported rest since.
    stop : StopRequest or None
        The latest stop: who requested it, why and when.
    halted : bool
        Whether nothing has moved since the latest stop, and no motion, release or connection was
        accepted.
    link_lost : bool
        Whether the connection failed because the device stopped answering.
    latch_reason : str or None
        Reason for the latched emergency stop, until it is released.
    doubt : str or None
        Why the position may be wrong, until it is confirmed or the axes are homed.
    owners : mapping axis -> str
        The owner of each axis that has one.
    differences : tuple of str
        Differences of the device's parameters from the robot file, until they are accepted.
    tip : (x, y, z) or None
        Commanded position of the tip, m; None if there is no tip, or no position is known.
    link : LinkQuality or None
        Quality of the line to the device; None if the device has no line.
    stop_latency : LatencyStatistics or None
        Time from a stop request until its last byte is on the line.
    stop_latency_s : float or None
        Time until the device confirmed the latest stop (host time).
    standstill_s : float or None
        Time from the latest stop until the device reported rest (host time); None while it halts.
    """

    connection: ConnectionState = ConnectionState.DISCONNECTED
    activity: DeviceState = DeviceState.CLOSED
    measured: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    command: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    model: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    nominal: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    model_id: str = ""
    unsettled: tuple[str, ...] = ()
    device_time_s: float | None = None
    sample_host_time_s: float | None = None
    age_s: float | None = None
    last_motion_s: float = float("-inf")
    progress: float = 0.0
    queued: int = 0
    position_known: bool = False
    fault: str | None = None
    lock_reason: str | None = None
    unhomed: tuple[str, ...] = ()
    silent_s: float = 0.0
    stopping: bool = False
    stop: StopRequest | None = None
    halted: bool = False
    link_lost: bool = False
    latch_reason: str | None = None
    doubt: str | None = None
    owners: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    differences: tuple[str, ...] = ()
    tip: tuple[float, float, float] | None = None
    link: LinkQuality | None = None
    stop_latency: LatencyStatistics | None = None
    stop_latency_s: float | None = None
    standstill_s: float | None = None

    @property
    def phase(self) -> SessionPhase:
        """The state in one word; the most serious condition wins."""
        if self.connection is ConnectionState.CONNECTING:
            return SessionPhase.CONNECTING
        if self.connection is not ConnectionState.CONNECTED:
            return SessionPhase.DISCONNECTED
        if self.silent_s > 0.0:
            return SessionPhase.SHORT_LOSS
        if self.fault is not None:
            return SessionPhase.FAULT
        if self.stopping:
            return SessionPhase.STOPPING
        if self.activity is not DeviceState.IDLE:
            return SessionPhase.MOVING
        return SessionPhase.READY if self.position_known else SessionPhase.POSITION_UNKNOWN


def find_lock_reason(state: SessionState) -> str | None:
    """Return why a state does not permit motion, or None if it does."""
    if state.connection is ConnectionState.FAILED:
        return message(
            "engine", "the device failed ({fault}); reconnect, then check its position"
        ).fill(fault=state.fault or "")
    if state.connection is not ConnectionState.CONNECTED:
        return NOT_CONNECTED
    if state.fault is not None:
        return message("engine", "the device reports a fault ({fault}); clear it first").fill(
            fault=state.fault or ""
        )
    if state.silent_s > 0.0:
        return message("engine", "the device does not answer; wait until it does")
    if state.differences:
        return message(
            "engine",
            "the device's parameters differ from the robot file ({difference}); write or "
            "accept them first",
        ).fill(difference=state.differences[0])
    if not state.position_known:
        if not state.unhomed:
            return message("engine", "the position is not known yet")
        unknown = message("engine", "the position of {axes} is not known; home first")
        return unknown.fill(axes=join_messages(map(AxisName, state.unhomed), ", "))
    if state.doubt is not None:
        return message("engine", "{reason}: the position may be wrong; home, or confirm it").fill(
            reason=state.doubt
        )
    return None


@dataclass(frozen=True, slots=True)
class StateChanged:
    """The connection, activity, fault or lock has changed."""

    state: SessionState


@dataclass(frozen=True, slots=True)
class StopRequested:
    """A stop was requested."""

    request: StopRequest


@dataclass(frozen=True, slots=True)
class FaultRaised:
    """Motion is locked until the fault is cleared or the device is reconnected."""

    message: str


@dataclass(frozen=True, slots=True)
class AlarmRaised:
    """A reading is outside its bounds; motion continues."""

    message: str


@dataclass(frozen=True, slots=True)
class CommandRefused:
    """The device has refused an accepted command; nothing has moved."""

    message: str


@dataclass(frozen=True, slots=True)
class PlaybackFinished:
    """A playback has ended.

    Attributes
    ----------
    record : Record or None
        Record of the playback; None if the playback never began.
    completed : bool
    model : ModelInUse or None
        The model in use during the playback.
    model_outputs : RunModelOutputs or None
        Outputs of the model in use and the nominal model for each row of the record.
    shown : bool
        Whether to show the run; False if the playback only moved the machine somewhere.
    """

    record: Record | None
    completed: bool
    model: ModelInUse | None = None
    model_outputs: RunModelOutputs | None = None
    shown: bool = True

    # Former names, which work for one more release.
    answers = FormerMember("model_outputs")


@dataclass(frozen=True, slots=True)
class ModelChanged:
    """Another model is in use; ``why`` is the reason if nobody requested the change."""

    model: ModelInUse
    why: str = ""


SessionEvent = (
    StateChanged
    | StopRequested
    | FaultRaised
    | AlarmRaised
    | CommandRefused
    | PlaybackFinished
    | ModelChanged
)
EventCallback = Callable[[SessionEvent], None]

if not TYPE_CHECKING:
    SessionState.latched = FormerMember("latch_reason")
    SessionState.locked = FormerMember("lock_reason")
    SessionState.moved_s = FormerMember("last_motion_s")
    __getattr__ = serve_former_names(
        __name__,
        Alarmed="AlarmRaised",
        Callback="EventCallback",
        Connection="ConnectionState",
        Event="SessionEvent",
        Faulted="FaultRaised",
        Phase="SessionPhase",
        Stopped="StopRequested",
        lock_reason="find_lock_reason",
    )
