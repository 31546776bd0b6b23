"""Journal of the events at the machine: moves, stops, locks and runs. Does not use Qt."""

import logging
from collections import deque
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from datetime import datetime

from rotemina.app.language import choose_axis_scale, get_axis_label, translate_message
from rotemina.app.motion.device import (
    HOMING,
    OPERATOR,
    PLAYBACK,
)
from rotemina.app.motion.penetration import PenetrationPhase, PenetrationStatus
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import STOP_AND_LOCK_REASON, ConnectionState, SessionState
from rotemina.app.workbench import Level, NoticeMessage
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.events import tr
from rotemina.sim.robot import Robot

logger = logging.getLogger(__name__)

# Older entries are dropped.
MAX_ENTRIES = 500
# A shorter lock is not recorded, because it is only a step of a procedure such as connecting.
_MIN_LOCK_DURATION_S = 0.5
# An axis has moved if its command has changed by more than this fraction of its range.
_MIN_MOVE_FRACTION = 1e-9


@dataclass(frozen=True, slots=True)
class JournalEntry:
    """Entry of the journal.

    Attributes
    ----------
    time : datetime
        Local time; for a repeated notice, the time of the latest repeat.
    level : Level
    text : str
    count : int
        Number of times that the notice was given.
    key : hashable or None
        Identifies the notice: successive notices with equal keys are counted in one entry. None
        for an entry that is not a notice.
    """

    time: datetime
    level: Level
    text: str
    count: int = 1
    key: Hashable | None = None


@dataclass(frozen=True, slots=True)
class MachineSnapshot:
    """Everything that the journal watches, at one instant.

    Attributes
    ----------
    state : SessionState
    playback : PlaybackState
    penetration : PenetrationStatus
    plan, driver, recording, model : str
        Names of the loaded trajectory, the driver, the recording (empty if there is none) and the
        model in use.
    at_s : float
        Time of a monotonic clock, s.
    """

    state: SessionState
    playback: PlaybackState
    penetration: PenetrationStatus
    plan: str = ""
    driver: str = ""
    recording: str = ""
    model: str = ""
    at_s: float = 0.0


class EventJournal:
    """Journal that compares each snapshot with the previous one and records the differences.

    A move is recorded when the machine has come to rest, as the displacement from the previous rest
    position. So every jog is recorded, whether by the operator or by a device, and there is at most
    one entry each time the machine comes to rest.

    Parameters
    ----------
    robot : Robot
    clock : callable
        Returns the local time.
    """

    def __init__(self, robot: Robot, clock: Callable[[], datetime] = datetime.now) -> None:
        self._robot, self._clock = robot, clock
        self.entries: deque[JournalEntry] = deque(maxlen=MAX_ENTRIES)
        # The number of entries added so far. The panel looks for new entries when it changes.
        self.count = 0
        # The number of repeated notices, which were counted in an existing entry.
        self.repeats = 0
        self._previous: MachineSnapshot | None = None
        # The commands when the machine was last at rest, or None if they are unknown.
        self._rest_position: Mapping[str, float] | None = None
        self._mover = ""
        # The reason for the current lock, and the time since which it has not changed, s.
        self._observed_lock: tuple[str | None, float] = (None, 0.0)
        self._recorded_lock: str | None = None

    def add_entry(self, level: Level, text: str) -> None:
        """Add an entry for a message that is already in the program's log."""
        self.entries.append(JournalEntry(self._clock(), level, text))
        self.count += 1

    def add_notice(self, level: Level, notice: NoticeMessage) -> None:
        """Add a notice of the window. If it repeats the latest entry, only increase the count."""
        latest = self.entries[-1] if self.entries else None
        if latest is None or latest.key != notice.key:
            self.add_entry(level, notice)
            count = 1
        else:
            self.repeats += 1
            count = latest.count + 1
        self.entries[-1] = JournalEntry(self._clock(), level, notice, count, notice.key)

    def _add_and_log(self, level: Level, text: str) -> None:
        logger.info("%s", text)
        self.add_entry(level, text)

    def record_changes(self, snapshot: MachineSnapshot) -> None:
        """Record what has changed since the previous snapshot."""
        previous, self._previous = self._previous, snapshot
        self._record_move(snapshot.state)
        self._record_lock(snapshot.state, snapshot.at_s)
        if previous is None:
            return
        self._record_session(previous, snapshot)
        self._record_playback(previous.playback, snapshot.playback, snapshot.plan)
        if snapshot.penetration.phase is not previous.penetration.phase:
            self._record_penetration(snapshot.penetration)
        if snapshot.recording != previous.recording:
            text = (
                tr("Recording {name} started").format(name=snapshot.recording)
                if snapshot.recording
                else tr("Recording {name} ended").format(name=previous.recording)
            )
            self._add_and_log(Level.INFO, text)
        if snapshot.model != previous.model:
            self.add_entry(Level.INFO, tr("Model in use: {name}").format(name=snapshot.model))

    def _record_session(self, previous: MachineSnapshot, snapshot: MachineSnapshot) -> None:
        old, new = previous.state, snapshot.state
        if new.connection is not old.connection and new.connection is ConnectionState.CONNECTED:
            self._add_and_log(Level.GOOD, tr("Connected: {name}").format(name=snapshot.driver))
        if new.connection is not old.connection and new.connection is ConnectionState.DISCONNECTED:
            self._add_and_log(Level.WARNING, tr("Disconnected"))
        if new.stop is not None and new.stop != old.stop:
            self._record_stop(new)
        if old.latch_reason is not None and new.latch_reason is None:
            self._add_and_log(Level.INFO, tr("Lock released"))

    def _record_stop(self, state: SessionState) -> None:
        request = state.stop
        assert request is not None
        is_by_operator = request.by == OPERATOR
        if request.why == STOP_AND_LOCK_REASON and is_by_operator:
            text = tr("Stopped and locked by the operator")
        elif is_by_operator:
            text = tr("Stopped by the operator")
        else:
            text = tr("Stopped by the program")
        if request.why and request.why != STOP_AND_LOCK_REASON:
            text = f"{text}: {translate_message(request.why)}"
        self.add_entry(Level.WARNING, text)

    def _record_lock(self, state: SessionState, at_s: float) -> None:
        """Record a lock that persists, and its end.

        A lock by the operator is recorded as a stop, and a lost connection as such.
        """
        is_recorded_elsewhere = (
            state.latch_reason is not None or state.connection is not ConnectionState.CONNECTED
        )
        lock_reason = None if is_recorded_elsewhere else state.lock_reason
        if lock_reason != self._observed_lock[0]:
            self._observed_lock = lock_reason, at_s
        if (
            lock_reason == self._recorded_lock
            or at_s - self._observed_lock[1] < _MIN_LOCK_DURATION_S
        ):
            return
        self._recorded_lock = lock_reason
        if lock_reason is not None:
            text = tr("Locked: {why}").format(why=translate_message(lock_reason))
            self._add_and_log(Level.WARNING, text)
        elif not is_recorded_elsewhere:
            self._add_and_log(Level.GOOD, tr("Motion is possible"))

    def _record_playback(self, old: PlaybackState, new: PlaybackState, plan: str) -> None:
        if new.phase is old.phase:
            return
        name, row = plan or tr("a trajectory"), max(new.row, 0) + 1
        text = {
            PlaybackPhase.PLAYING: tr("Playing {name}"),
            PlaybackPhase.PAUSED: tr("{name} is paused at row {row}"),
            PlaybackPhase.IDLE: tr("{name} ended"),
        }[new.phase]
        if (old.phase, new.phase) == (PlaybackPhase.PAUSED, PlaybackPhase.PLAYING):
            text = tr("{name} resumed at row {row}")
        self._add_and_log(Level.INFO, text.format(name=name, row=row))

    def _record_penetration(self, status: PenetrationStatus) -> None:
        text = tr("Penetration: {phase}").format(phase=translate_message(status.phase))
        if status.reason:
            text = f"{text}: {translate_message(status.reason)}"
        is_failure = status.phase in (
            PenetrationPhase.ABORTED,
            PenetrationPhase.FAILED,
            PenetrationPhase.HELD,
        )
        self._add_and_log(Level.WARNING if is_failure else Level.INFO, text)

    def _record_move(self, state: SessionState) -> None:
        if state.connection is not ConnectionState.CONNECTED or not state.command:
            # If the position changes while there is no connection, this program did not move it.
            self._rest_position = None
            return
        if state.activity is not DeviceState.IDLE or state.queued or state.stopping:
            self._mover = next(iter(state.owners.values()), self._mover)
            return
        old_position, self._rest_position = self._rest_position, state.command
        mover, self._mover = self._mover, ""
        # The start, pauses and end of a playback are recorded instead.
        if old_position is None or mover == PLAYBACK:
            return
        axes = [
            axis for axis in state.command if self._has_moved(axis, old_position, state.command)
        ]
        if axes:
            self._add_and_log(
                Level.INFO, self._describe_move(axes, old_position, state.command, mover)
            )

    def _has_moved(self, axis: str, old: Mapping[str, float], new: Mapping[str, float]) -> bool:
        return (
            abs(new[axis] - old.get(axis, new[axis]))
            > _MIN_MOVE_FRACTION * self._robot.axes[axis].span
        )

    def _describe_move(
        self, axes: list[str], old: Mapping[str, float], new: Mapping[str, float], mover: str
    ) -> str:
        moves = []
        for axis in axes:
            scale = choose_axis_scale(self._robot.axes[axis])
            start, end = scale.format_value(old[axis]), scale.format_with_unit(new[axis])
            moves.append(f"{get_axis_label(axis)} {start} → {end}")
        text = ", ".join(moves)
        if mover == HOMING:
            return tr("Homed: {moved}").format(moved=text)
        return text if mover in ("", OPERATOR) else f"{translate_message(mover)}: {text}"
