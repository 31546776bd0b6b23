"""The state of a motion session, and its events."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType

from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.recorder import RunAnswers
from rotemina.app.motion.stop import StopRequest
from rotemina.app.motion.stop_send_latency import Latency
from rotemina.drivers.line_quality import LinkQuality
from rotemina.drivers.samples import DeviceState
from rotemina.sim.messages import AxisName, joined, message
from rotemina.sim.records.record import Record

NOT_CONNECTED = message("engine", "not connected; connect first")


class Connection(StrEnum):
    """State of the connection between session and device."""

    DISCONNECTED = "disconnected"
    CONNECTING = "connecting"
    CONNECTED = "connected"
    FAILED = "failed"


class Phase(StrEnum):
    """The phase of the session for the operator."""

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
    connection : Connection
    activity : DeviceState
        What the device does, ``closed`` while there is none.
    measured, command, model, nominal : mapping axis -> float
        Latest reading, command applied and answers of the model in use and of the nominal one, m
        or rad; empty before the first sample. Values of a lost device stay, with their age.
    model_id : str
        Of the model in use.
    unsettled : tuple of str
        Axes of whose past that model knows too little: its answer may be off by what it remembers.
    device_time_s : float or None
        Device time of the latest sample.
    sample_host_time_s : float or None
        Host time at which it was received.
    age_s : float or None
        How long ago that was when the snapshot was taken (host time).
    moved_s : float
        Host time of the latest report of a motion.
    progress : float
        0 to 1, of the present or latest playback.
    queued : int
        Commands that wait for the worker.
    position_known : bool
    fault : str or None
        The reason for the last failure or device fault; it stays until it is cleared.
    locked : str or None
        Why no motion is accepted now, or None.
    unhomed : tuple of str
        Axes whose position is unknown.
    silent_s : float
        For how long the device has said nothing though it should have.
    stopping : bool
        Whether a stop was requested and the device has not been seen at rest since.
    stop : StopRequest or None
        The latest stop: who asked, why and when.
    halted : bool
        Whether that stop is the last thing that happened: nothing has moved since, and no motion,
        release or connection was accepted.
    link_lost : bool
        Whether the connection failed because the device stopped answering, not for another reason.
    latched : str or None
        Why the emergency stop is latched, until it is released.
    doubt : str or None
        Why the position may be wrong, until it is confirmed or the axes are homed.
    owners : mapping axis -> str
        Who drives each axis that someone drives.
    differences : tuple of str
        Where the device's parameters differ from the robot file, until they are accepted.
    tip : (x, y, z) or None
        The tip, m, as commanded; None where there is none, or nothing is known.
    link : LinkQuality or None
        How the line does; None where there is none.
    stop_latency : Latency or None
        How long a stop takes to be out on the line, as of all the time.
    stop_latency_s : float or None
        How long the device took to confirm the latest stop (host time).
    standstill_s : float or None
        From that stop until the device was seen at rest (host time); None while it still halts.
    """

    connection: Connection = Connection.DISCONNECTED
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
    moved_s: float = float("-inf")
    progress: float = 0.0
    queued: int = 0
    position_known: bool = False
    fault: str | None = None
    locked: str | None = None
    unhomed: tuple[str, ...] = ()
    silent_s: float = 0.0
    stopping: bool = False
    stop: StopRequest | None = None
    halted: bool = False
    link_lost: bool = False
    latched: str | None = None
    doubt: str | None = None
    owners: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    differences: tuple[str, ...] = ()
    tip: tuple[float, float, float] | None = None
    link: LinkQuality | None = None
    stop_latency: Latency | None = None
    stop_latency_s: float | None = None
    standstill_s: float | None = None

    @property
    def phase(self) -> Phase:
        """The state in one word, the gravest first."""
        if self.connection is Connection.CONNECTING:
            return Phase.CONNECTING
        if self.connection is not Connection.CONNECTED:
            return Phase.DISCONNECTED
        if self.silent_s > 0.0:
            return Phase.SHORT_LOSS
        if self.fault is not None:
            return Phase.FAULT
        if self.stopping:
            return Phase.STOPPING
        if self.activity is not DeviceState.IDLE:
            return Phase.MOVING
        return Phase.READY if self.position_known else Phase.POSITION_UNKNOWN


def lock_reason(state: SessionState) -> str | None:
    """Return why no motion is possible by a state; else None."""
    if state.connection is Connection.FAILED:
        return message(
            "engine", "the device failed ({fault}); reconnect, then check its position"
        ).fill(fault=state.fault or "")
    if state.connection is not Connection.CONNECTED:
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
        return unknown.fill(axes=joined(map(AxisName, state.unhomed), ", "))
    if state.doubt is not None:
        return message("engine", "{reason}: the position may be wrong; home, or confirm it").fill(
            reason=state.doubt
        )
    return None


@dataclass(frozen=True, slots=True)
class StateChanged:
    """Connection, activity, fault or lock changed."""

    state: SessionState


@dataclass(frozen=True, slots=True)
class Stopped:
    """A stop was requested."""

    request: StopRequest


@dataclass(frozen=True, slots=True)
class Faulted:
    """Motion is locked for this reason, until it is cleared or the device reconnected."""

    message: str


@dataclass(frozen=True, slots=True)
class Alarmed:
    """A reading is outside its bounds; motion continues."""

    message: str


@dataclass(frozen=True, slots=True)
class CommandRefused:
    """The device refused an accepted command; nothing moved."""

    message: str


@dataclass(frozen=True, slots=True)
class PlaybackFinished:
    """A playback ended; ``record`` is what was played, None if that never began.

    ``model`` is the one that was in use, and ``answers`` what it and the nominal one said of each
    row of the record. Without ``shown`` it was a way to somewhere, whose record nobody wants.
    """

    record: Record | None
    completed: bool
    model: ModelInUse | None = None
    answers: RunAnswers | None = None
    shown: bool = True


@dataclass(frozen=True, slots=True)
class ModelChanged:
    """Another model is in use; ``why`` gives the reason if it was not requested."""

    model: ModelInUse
    why: str = ""


Event = (
    StateChanged | Stopped | Faulted | Alarmed | CommandRefused | PlaybackFinished | ModelChanged
)
Callback = Callable[[Event], None]
