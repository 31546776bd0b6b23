"""Playback under the operator's control: pace, pause, single steps, supervision."""

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from enum import StrEnum
from types import MappingProxyType

import numpy as np

from rotemina.app.display_units import noticeable
from rotemina.app.motion.live_models import ModelOutputs
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.model_deviation_watch import DeviationWatch, Gap
from rotemina.app.motion.ownership import PLAYBACK
from rotemina.app.motion.retiming import Piece, check_speed, piece
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection, Event, PlaybackFinished, StateChanged
from rotemina.app.motion.stop import PROGRAM
from rotemina.drivers.gate import Permit
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import amount
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.resampling import induced_velocity
from rotemina.sim.trajectory.axis_limits import check_speeds, with_limits
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory
from rotemina.sim.trajectory.dry_run import moved_axes
from rotemina.sim.trajectory.trajectory_excesses import check_trajectory

_ROUNDING_S = 1e-6  # of times that came from a device
_LEAST_SHARE = 1e-9  # of an axis' range: less is the rounding of numbers
_PLAYING = message("engine", "a trajectory is playing; pause or stop it first")
#: Why a request to resume was refused where a stop came after it.
NOT_RESUMED = message("engine", "Not resumed: the machine was stopped again.")
#: Why the machine is stopped by a pause, and by the end of a playback.
PAUSE_REASON = message("engine", "the playback is paused")
END_REASON = message("engine", "the playback is ended")
#: Axes move back to where a playback was paused at this share of their greatest speed.
RETURN_SHARE = 0.1


class PlaybackPhase(StrEnum):
    """What a playback does."""

    IDLE = "idle"
    PLAYING = "playing"
    PAUSED = "paused"


@dataclass(frozen=True, slots=True)
class PlaybackState:
    """One moment of a playback.

    Attributes
    ----------
    phase : PlaybackPhase
    row, rows : int
        The last row that was reached (−1 before the first one), of how many.
    path_s, duration_s : float
        Where that is in the trajectory's own time, of how much.
    speed : float
        Times as fast as the trajectory says.
    gaps : mapping axis -> Gap
        Model against machine since the beginning.
    excess : str or None
        Why it was stopped, if the deviation was excessive.
    pausing : bool
        Whether it plays no longer but the axes have yet to come to rest.
    moved : mapping axis -> float
        How far the commands of axes are from where they rested when it was paused, m or rad, with
        sign; only axes that differ noticeably, and none while anything moves.
    """

    phase: PlaybackPhase = PlaybackPhase.IDLE
    row: int = -1
    rows: int = 0
    path_s: float = 0.0
    duration_s: float = 0.0
    speed: float = 1.0
    gaps: Mapping[str, Gap] = field(default_factory=lambda: MappingProxyType({}))
    excess: str | None = None
    pausing: bool = False
    moved: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))


@contextmanager
def _unless_stopped(permit: Permit) -> Iterator[None]:
    """Say that nothing was resumed, where a request was refused because of a later stop."""
    try:
        yield
    except InputError as error:
        if permit.epoch.stops == permit.gate.epoch.stops:
            raise
        raise RefusedError(NOT_RESUMED) from error


class Playback:
    """Plays one trajectory at a time through a session; every method from any thread.

    A pause brings the axes to rest at once, each within its own acceleration, and so off the path
    by at most their braking distance; resuming returns them to the last row that began. If axes
    were moved elsewhere during the pause, nothing resumes until :meth:`move_back` has returned
    them, slowly. Each played section makes a record of its own, reported by the session's
    ``PlaybackFinished``. Any other stop while it plays, a fault and a lost link end the playback.

    Parameters
    ----------
    session : MotionSession
    exceeded : callable
        Told once which axis deviates, on the session's thread, when that has stopped the playback.
    """

    def __init__(
        self, session: MotionSession, exceeded: Callable[[str], None] = lambda _: None
    ) -> None:
        self._session = session
        self._exceeded = exceeded
        self._lock = threading.Lock()
        self._whole: CheckedTrajectory | None = None
        self._piece: Piece | None = None
        self._watch: DeviationWatch | None = None
        self._pausing = False
        self._has_begun = False  # the section that plays: until then nothing of it is compared
        self._rest: Mapping[str, float] | None = None  # commands at rest after the pause
        self._rest_is_final = False
        self._before_resuming: PlaybackState | None = None
        self._most_speeds: dict[str, dict[str, float]] = {}  # by the digest of a trajectory
        self._state = PlaybackState()
        self._ends = (session.subscribe(self._on_event), session.tap(self._on_samples))

    def close(self) -> None:
        """Detach from the session; a running playback continues."""
        for end in self._ends:
            end()

    @property
    def state(self) -> PlaybackState:
        """The present state."""
        with self._lock:
            state, watch = self._state, self._watch
            piece_, whole = self._piece, self._whole
            gaps = watch.gaps if watch is not None else state.gaps
            state = replace(state, pausing=self._pausing or self._rests_soon)
        if state.phase is PlaybackPhase.PAUSED:
            state = replace(state, moved=MappingProxyType(self._moved()))
        if state.phase is PlaybackPhase.PLAYING and piece_ is not None and whole is not None:
            now = self._session.reported
            # Until the device begins, its progress is that of what it played before.
            share = now.progress if now.activity is DeviceState.PLAYING else 0.0
            elapsed_s = share * piece_.trajectory.duration_s
            state = self._at(state, whole, piece_.path_time(elapsed_s))
        return replace(state, gaps=MappingProxyType(gaps))

    def limit_speeds(self, trajectory: CheckedTrajectory, speeds: Mapping[str, float]) -> None:
        """Limit how fast axes play a trajectory, for as long as this object lives.

        Parameters
        ----------
        trajectory : CheckedTrajectory
            The limits hold for every trajectory with the same times and commands.
        speeds : mapping axis -> float
            Greatest speed, m/s or rad/s.

        Raises
        ------
        OutOfLimitsError
            If a speed is no finite number above 0, or of an axis that the trajectory lacks.
        """
        check_speeds(dict.fromkeys(trajectory.commands.axes, 0.0), speeds)
        with self._lock:
            self._most_speeds.setdefault(trajectory.digest, {}).update(speeds)

    def axes_without_speed_limit(self, trajectory: CheckedTrajectory) -> tuple[str, ...]:
        """Return the axes that a trajectory moves, whose speed nobody has limited."""
        axes = self._session.robot.axes
        with self._lock:
            given = dict(self._most_speeds.get(trajectory.digest, {}))
        return tuple(
            axis
            for axis in moved_axes(trajectory.commands)
            if axes[axis].max_speed is None and axis not in given
        )

    def play(
        self,
        trajectory: CheckedTrajectory,
        *,
        speed: float = 1.0,
        bounds: Mapping[str, float] = MappingProxyType({}),
        permit: Permit | None = None,
    ) -> None:
        """Play a trajectory from its first row.

        Parameters
        ----------
        trajectory : CheckedTrajectory
            As a dry run allowed it.
        speed : float
            Times as fast as it says, 0.01 to 10; another pace than 1 is checked against all limits.
        bounds : mapping axis -> float
            The greatest deviation of readings from the model, m or rad, beyond which it is stopped.
        permit : Permit, optional
            Of the request, where that was made before this call.

        Raises
        ------
        InputError
            If speed or bounds are none, an axis would be faster than :meth:`limit_speeds` allows,
            or as :meth:`MotionSession.play`.
        """
        permit = self._session.permit() if permit is None else permit
        commands = trajectory.commands
        watch = DeviationWatch(self._session.robot, bounds)
        state = PlaybackState(
            rows=len(commands.time_s), duration_s=commands.duration_s, speed=check_speed(speed)
        )
        self._begin(trajectory, 0, state, watch, permit)

    def pause(self, *, by: str = PROGRAM) -> None:
        """Bring the axes to rest, to continue later; ``by`` as of :meth:`MotionSession.stop`.

        Raises
        ------
        RefusedError
            If nothing plays.
        """
        with self._lock:
            if self._state.phase is not PlaybackPhase.PLAYING:
                raise RefusedError(message("engine", "nothing is playing"))
            self._pausing = True
        self._session.stop(PAUSE_REASON, by=by)

    def resume(self, *, speed: float | None = None, permit: Permit | None = None) -> None:
        """Continue from the last row that began, at the speed of before or at another one.

        ``permit`` as in :meth:`play`.

        Raises
        ------
        RefusedError
            If nothing is paused, axes were moved since the pause (:meth:`move_back` returns them),
            a stop came after the permit, or as :meth:`MotionSession.play`.
        """
        permit = self._session.permit() if permit is None else permit
        whole, watch, state = self._paused("resume")
        pace = state.speed if speed is None else check_speed(speed)
        resumed = replace(state, speed=pace, excess=None)
        with _unless_stopped(permit):
            self._begin(
                whole, self._next_row(state), resumed, watch, permit, check=self._refuse_if_moved
            )

    def move_back(self, *, permit: Permit | None = None) -> None:
        """Move axes back, slowly, to where the paused playback goes on; then :meth:`resume`.

        The axes of the trajectory go to the commands of the row at which it goes on, others that
        were moved to where they rested: a checked :meth:`MotionSession.go_to` at
        :data:`RETURN_SHARE` of each axis' greatest speed. That speed is what :meth:`limit_speeds`
        or the robot file says, or else the greatest that the trajectory itself has. This does not
        wait: resume when ``session.at_rest``. ``permit`` as in :meth:`play`.

        Raises
        ------
        OutOfLimitsError, RefusedError
            If nothing is paused, or as :meth:`MotionSession.go_to`.
        """
        permit = self._session.permit() if permit is None else permit
        whole, _, state = self._paused("resume")
        moved = self._moved()
        if not moved:
            return
        rest = self._rest_place(whole, state)
        targets = {axis: rest[axis] for axis in moved} | self._commands(whole, state)
        with _unless_stopped(permit):
            speeds = self._return_speeds(whole, targets)
            self._session.go_to(targets, PLAYBACK, speeds, permit=permit)
        with self._lock:
            self._rest, self._rest_is_final = {**rest, **targets}, True

    def start_over(self, *, speed: float | None = None, permit: Permit | None = None) -> None:
        """Play what is paused again from its first row, with the same bounds.

        ``speed`` as in :meth:`resume`, ``permit`` as in :meth:`play`.

        Raises
        ------
        InputError
            If nothing is paused, or as :meth:`play`.
        """
        whole, watch, state = self._paused("start over")
        pace = state.speed if speed is None else speed
        self.play(whole, speed=pace, bounds=watch.bounds, permit=permit)

    def step(self, rows: int = 1) -> None:
        """Go some rows on, or back, and rest there; at the axes' own speed, without a record.

        Raises
        ------
        RefusedError
            If nothing is paused, axes were moved since the pause, or as
            :meth:`MotionSession.go_to`.
        """
        whole, _, state = self._paused("step through")
        self._refuse_if_moved()
        row = state.row + rows
        if not 0 <= row < state.rows:
            raise RefusedError(
                message("engine", "playback: row {row}: the trajectory has rows 0 to {rows}").fill(
                    row=row, rows=state.rows - 1
                )
            )
        time_s, there = whole.commands.time_s, replace(state, row=row)
        targets = self._commands(whole, there)
        self._session.go_to(targets)
        with self._lock:
            rest = self._rest or self._session.reported.command
            self._rest, self._rest_is_final = {**rest, **targets}, True
            self._state = replace(there, path_s=float(time_s[row] - time_s[0]))

    def load_paused(self, trajectory: CheckedTrajectory) -> None:
        """Load a trajectory before its first row, to step through it.

        Raises
        ------
        RefusedError
            If something plays.
        """
        commands = trajectory.commands
        with self._lock:
            if self._state.phase is PlaybackPhase.PLAYING:
                raise RefusedError(_PLAYING)
            self._whole, self._watch = trajectory, DeviationWatch(self._session.robot)
            self._rest, self._rest_is_final = {}, True  # before its first row it is nowhere
            self._state = PlaybackState(
                PlaybackPhase.PAUSED, rows=len(commands.time_s), duration_s=commands.duration_s
            )
        self._session.dismiss_stop()

    def end(self, *, by: str = PROGRAM) -> None:
        """Stop, and forget a paused trajectory; ``by`` as of :meth:`MotionSession.stop`."""
        self._session.stop(END_REASON, by=by)
        with self._lock:
            self._state = replace(self._state, phase=PlaybackPhase.IDLE)

    def _paused(self, what: str) -> tuple[CheckedTrajectory, DeviationWatch, PlaybackState]:
        with self._lock:
            if self._state.phase is not PlaybackPhase.PAUSED or not (self._whole and self._watch):
                raise RefusedError(message("engine", "nothing is paused to {what}").fill(what=what))
            return self._whole, self._watch, self._state

    @staticmethod
    def _next_row(state: PlaybackState) -> int:
        return min(max(state.row, 0), state.rows - 1)

    def _commands(self, whole: CheckedTrajectory, state: PlaybackState) -> dict[str, float]:
        """Return the commands of the row at which a paused trajectory goes on."""
        commands, row = whole.commands, self._next_row(state)
        return {axis: float(commands.signal(axis, Tap.CMD)[row]) for axis in commands.axes}

    def _rest_place(self, whole: CheckedTrajectory, state: PlaybackState) -> Mapping[str, float]:
        """Return where the axes rested; those of which nothing was seen, where they go on."""
        rest = self._rest
        return self._commands(whole, state) if rest is None else rest

    def _moved(self) -> dict[str, float]:
        """Return how far axes were moved since the pause; nothing while anything moves."""
        with self._lock:
            whole, state = self._whole, self._state
        if whole is None or not self._session.at_rest:
            return {}
        command, axes = self._session.reported.command, self._session.robot.axes
        rest = self._rest_place(whole, state)
        distances = {axis: command.get(axis, at) - at for axis, at in rest.items()}
        return {
            axis: distance
            for axis, distance in distances.items()
            if abs(distance) > max(noticeable(axes[axis]), _LEAST_SHARE * axes[axis].span)
        }

    @property
    def _rests_soon(self) -> bool:
        """Whether it is paused and the axes have yet to come to rest; the lock is held."""
        paused = self._state.phase is PlaybackPhase.PAUSED
        return paused and self._rest is None and not self._rest_is_final

    def _refuse_if_moved(self) -> None:
        moved = self._moved()
        if not moved:
            return
        robot = self._session.robot
        axis, distance = max(
            moved.items(), key=lambda item: abs(item[1]) / robot.axes[item[0]].span
        )
        raise RefusedError(
            message(
                "engine",
                "axis {axis} moved {distance} since the pause; move it back first, or play the "
                "trajectory from its first row",
            ).fill(
                axis=AxisName(axis),
                distance=amount(abs(distance), robot.unit(axis) or "", digits=2),
            )
        )

    def _return_speeds(self, whole: CheckedTrajectory, axes: Iterable[str]) -> dict[str, float]:
        """Return the slow speeds of a way back; an axis of unknown greatest speed has none."""
        with self._lock:
            given = dict(self._most_speeds.get(whole.digest, {}))
        own = {axis: float(peak) for axis, peak in induced_velocity(whole.commands).items()}
        robot = self._session.robot.axes
        greatest = {
            axis: given.get(axis) or robot[axis].max_speed or own.get(axis) for axis in axes
        }
        return {axis: RETURN_SHARE * most for axis, most in greatest.items() if most}

    def _begin(
        self,
        whole: CheckedTrajectory,
        row: int,
        state: PlaybackState,
        watch: DeviationWatch,
        permit: Permit,
        check: Callable[[], None] | None = None,
    ) -> None:
        """Play from a row on; ``check`` is the last thing that may refuse to resume."""
        period_s = self._session.setpoint_period_s
        played: Record | CheckedTrajectory = whole
        part = piece(whole.commands, row=row, speed=state.speed, setpoint_period_s=period_s)
        if row or state.speed != 1.0:
            played = part.trajectory
        with self._lock:
            most = dict(self._most_speeds.get(whole.digest, {}))
        if most:
            limited = with_limits(self._session.robot, most)
            check_trajectory(limited, part.trajectory, setpoint_period_s=period_s)
        with self._lock:
            if self._state.phase is PlaybackPhase.PLAYING:
                raise RefusedError(_PLAYING)
            before = (self._whole, self._piece, self._watch, self._state)
            self._whole, self._piece, self._watch = whole, part, watch
            self._state = replace(state, phase=PlaybackPhase.PLAYING)
            self._pausing = self._has_begun = False
            self._before_resuming = before[-1] if check is not None else None
            watch.restart()
        try:
            if check is not None:
                check()
            self._session.play(played, permit=permit)
        except BaseException:
            with self._lock:
                self._pausing = False
                self._whole, self._piece, self._watch, self._state = before
            raise

    def _on_samples(self, samples: Samples, answers: ModelOutputs) -> None:
        """Watch the gap during the playback; on the session's thread."""
        began = np.flatnonzero(samples.playback_row >= 0)
        with self._lock:
            if self._state.phase is PlaybackPhase.PAUSED:
                self._note_rest()
            playing = self._state.phase is PlaybackPhase.PLAYING
            # Not on the way to its first row, and not while that way is still being checked.
            self._has_begun |= playing and len(began) > 0
            if not playing or self._watch is None or not self._has_begun:
                return
            excess = self._watch.add(samples, answers.in_use, answers.nominal)
            if excess is None or self._state.excess is not None:
                return
            self._state = replace(self._state, excess=excess)
            self._pausing = True
        self._session.stop(excess)
        self._exceeded(excess)

    def _on_event(self, event: Event) -> None:
        if isinstance(event, StateChanged):
            lost = event.state.connection is not Connection.CONNECTED
            if lost or event.state.activity is DeviceState.FAULT:
                with self._lock:  # never goes on by itself, nor from where it was
                    self._pausing = False
                    self._state = replace(self._state, phase=PlaybackPhase.IDLE)
            with self._lock:
                if self._state.phase is PlaybackPhase.PAUSED:
                    self._note_rest()
        elif isinstance(event, PlaybackFinished):
            with self._lock:
                self._finish(event)

    def _finish(self, event: PlaybackFinished) -> None:
        whole, part = self._whole, self._piece
        if self._state.phase is not PlaybackPhase.PLAYING or whole is None or part is None:
            return
        reached_s = (
            part.path_s[0]
            if event.record is None
            else part.path_time(event.record.duration_s + _ROUNDING_S)
        )
        if event.record is not None or self._state.row >= 0:
            self._state = self._at(self._state, whole, reached_s)
        paused = self._pausing and not event.completed
        self._pausing = False
        phase = PlaybackPhase.PAUSED if paused else PlaybackPhase.IDLE
        self._state = replace(self._state, phase=phase)
        if paused:
            self._rest, self._rest_is_final = None, False
            self._note_rest()
        elif event.record is None and self._before_resuming is not None:
            # Stopped before anything was played: it goes on from where it was paused before.
            self._state = self._before_resuming

    def _note_rest(self) -> None:
        """Note where the axes rest after a pause, until anything is moved; the lock is held."""
        if self._rest_is_final:
            return
        if not self._session.is_untouched_since_stop:
            self._rest_is_final = True
        elif self._session.reported.activity is DeviceState.IDLE:
            self._rest = self._session.reported.command

    @staticmethod
    def _at(state: PlaybackState, whole: CheckedTrajectory, path_s: float) -> PlaybackState:
        time_s = whole.commands.time_s
        row = int(np.searchsorted(time_s, time_s[0] + path_s + _ROUNDING_S, side="right")) - 1
        return replace(state, row=max(row, 0), path_s=path_s)
