"""Events at the machine in the operator's words: moves, stops, locks, runs. Free of Qt."""

import logging
from collections import deque
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from datetime import datetime

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.ownership import HOMING, OPERATOR, PLAYBACK
from rotemina.app.motion.penetration.status import PenetrationStatus, Phase
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.motion.stop import LOCKED
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.help_topics import Explained
from rotemina.app.shell.workbench import Level
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.events import tr
from rotemina.sim.robot.model import Robot

logger = logging.getLogger(__name__)

MOST = 500  # entries that are kept
_LASTING_S = 0.5  # a lock that ends sooner is a step on the way, as while connecting
_SAME = 1e-9  # of an axis' range


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing that happened, in local time."""

    time: datetime
    level: Level
    text: str
    count: int = 1  # how often, at last then
    key: Hashable | None = None  # what it has in common with its repeats; a move has none


@dataclass(frozen=True, slots=True)
class Moment:
    """All that the journal looks at, together.

    Attributes
    ----------
    state : SessionState
    playback : PlaybackState
    penetration : PenetrationStatus
    plan, driver, recording, model : str
        What is played, connected, recorded (empty: nothing) and predicted with, by name.
    at_s : float
        On any clock.
    """

    state: SessionState
    playback: PlaybackState
    penetration: PenetrationStatus
    plan: str = ""
    driver: str = ""
    recording: str = ""
    model: str = ""
    at_s: float = 0.0


class Journal:
    """Compares each moment with the one before, and keeps what is different.

    A move is told when the machine rests again, from where it rested before: every jog, whoever
    asked for it, and no more entries than there were rests.

    Parameters
    ----------
    robot : Robot
    clock : callable
        Returns the local time.
    """

    def __init__(self, robot: Robot, clock: Callable[[], datetime] = datetime.now) -> None:
        self._robot, self._clock = robot, clock
        self.entries: deque[Entry] = deque(maxlen=MOST)
        # How many there were; another number means that there is something new.
        self.count = 0
        # Repeats of the latest entry, which make no new one.
        self.repeats = 0
        self._before: Moment | None = None
        self._rested: Mapping[str, float] | None = None  # commands
        self._mover = ""
        self._locked: tuple[str | None, float] = (None, 0.0)  # why, since when
        self._told_lock: str | None = None

    def tell(self, level: Level, text: str) -> None:
        """Add an entry for an already logged message."""
        self.entries.append(Entry(self._clock(), level, text))
        self.count += 1

    def tell_notice(self, level: Level, notice: Explained) -> None:
        """Add what the window has told; a repeat of the latest entry is counted there."""
        latest = self.entries[-1] if self.entries else None
        if latest is None or latest.key != notice.key:
            self.tell(level, notice)
            count = 1
        else:
            self.repeats += 1
            count = latest.count + 1
        self.entries[-1] = Entry(self._clock(), level, notice, count, notice.key)

    def _note(self, level: Level, text: str) -> None:
        """Add an entry, and log it: so it is in recordings and the support bundle too."""
        logger.info("%s", text)
        self.tell(level, text)

    def look(self, now: Moment) -> None:
        """Take the next moment."""
        before, self._before = self._before, now
        self._look_at_moves(now.state)
        self._look_at_lock(now.state, now.at_s)
        if before is None:
            return
        self._look_at_session(before, now)
        self._look_at_playback(before.playback, now.playback, now.plan)
        if now.penetration.phase is not before.penetration.phase:
            self._tell_penetration(now.penetration)
        if now.recording != before.recording:
            text = (
                tr("Recording {name} started").format(name=now.recording)
                if now.recording
                else tr("Recording {name} ended").format(name=before.recording)
            )
            self._note(Level.INFO, text)
        if now.model != before.model:
            self.tell(Level.INFO, tr("Model in use: {name}").format(name=now.model))

    def _look_at_session(self, before: Moment, now: Moment) -> None:
        old, new = before.state, now.state
        if new.connection is not old.connection and new.connection is Connection.CONNECTED:
            self._note(Level.GOOD, tr("Connected: {name}").format(name=now.driver))
        if new.connection is not old.connection and new.connection is Connection.DISCONNECTED:
            self._note(Level.WARNING, tr("Disconnected"))
        if new.stop is not None and new.stop != old.stop:
            self._tell_stop(new)
        if old.latched is not None and new.latched is None:
            self._note(Level.INFO, tr("Lock released"))

    def _tell_stop(self, state: SessionState) -> None:
        request = state.stop
        assert request is not None
        by_operator = request.by == OPERATOR
        if request.why == LOCKED and by_operator:
            text = tr("Stopped and locked by the operator")
        elif by_operator:
            text = tr("Stopped by the operator")
        else:
            text = tr("Stopped by the program")
        if request.why and request.why != LOCKED:
            text = f"{text}: {spoken(request.why)}"
        self.tell(Level.WARNING, text)

    def _look_at_lock(self, state: SessionState, at_s: float) -> None:
        """Tell a lock that lasts, and its end; that by the operator is told with the stop."""
        mine = state.latched is not None or state.connection is not Connection.CONNECTED
        why = None if mine else state.locked
        if why != self._locked[0]:
            self._locked = why, at_s
        if why == self._told_lock or at_s - self._locked[1] < _LASTING_S:
            return
        self._told_lock = why
        if why is not None:
            text = tr("Locked: {why}").format(why=spoken(why))
            self._note(Level.WARNING, text)
        elif not mine:
            self._note(Level.GOOD, tr("Motion is possible"))

    def _look_at_playback(self, old: PlaybackState, new: PlaybackState, plan: str) -> None:
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
        self._note(Level.INFO, text.format(name=name, row=row))

    def _tell_penetration(self, status: PenetrationStatus) -> None:
        text = tr("Penetration: {phase}").format(phase=spoken(status.phase))
        if status.reason:
            text = f"{text}: {spoken(status.reason)}"
        grave = status.phase in (Phase.ABORTED, Phase.FAILED, Phase.HELD)
        self._note(Level.WARNING if grave else Level.INFO, text)

    # --- moves ------------------------------------------------------------------------------------

    def _look_at_moves(self, state: SessionState) -> None:
        if state.connection is not Connection.CONNECTED or not state.command:
            self._rested = None  # what happens meanwhile is nobody's move
            return
        if state.activity is not DeviceState.IDLE or state.queued or state.stopping:
            self._mover = next(iter(state.owners.values()), self._mover)
            return
        rested, self._rested = self._rested, state.command
        mover, self._mover = self._mover, ""
        if rested is None or mover == PLAYBACK:  # which has entries of its own
            return
        moved = [axis for axis in state.command if self._differs(axis, rested, state.command)]
        if moved:
            self._note(Level.INFO, self._way(moved, rested, state.command, mover))

    def _differs(self, axis: str, old: Mapping[str, float], new: Mapping[str, float]) -> bool:
        return abs(new[axis] - old.get(axis, new[axis])) > _SAME * self._robot.axes[axis].span

    def _way(
        self, axes: list[str], old: Mapping[str, float], new: Mapping[str, float], mover: str
    ) -> str:
        parts = []
        for axis in axes:
            scale = axis_scale(self._robot.axes[axis])
            parts.append(f"{label(axis)} {scale.number(old[axis])} → {scale.text(new[axis])}")
        text = ", ".join(parts)
        if mover == HOMING:
            return tr("Homed: {moved}").format(moved=text)
        return text if mover in ("", OPERATOR) else f"{spoken(mover)}: {text}"
