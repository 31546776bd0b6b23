"""Playback under the operator's control: speed, pause, single steps, and supervision."""

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from enum import StrEnum
from types import MappingProxyType

import numpy as np

from rotemina.app.errors import RequestRefusedError
from rotemina.app.language import find_noticeable_change
from rotemina.app.motion.device import PLAYBACK
from rotemina.app.motion.model import DeviationWatch, ModelOutputs, PlaybackGap
from rotemina.app.motion.playback.retiming import RetimedSection, check_speed, retime
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    PROGRAM,
    ConnectionState,
    PlaybackFinished,
    SessionEvent,
    StateChanged,
)
from rotemina.drivers.contract import DeviceSamples, DeviceState, Permit
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, message
from rotemina.sim.records import Record, Tap, find_max_speeds
from rotemina.sim.trajectory import (
    CheckedTrajectory,
    check_speeds,
    check_trajectory,
    find_moved_axes,
    with_limits,
)
from rotemina.sim.units import format_quantity

# Times from a device are rounded to multiples of this.
_TIME_ROUNDING_S = 1e-6
# A distance below this fraction of an axis' range is a rounding error.
_MIN_DISTANCE_RATIO = 1e-9
_ALREADY_PLAYING = message("engine", "a trajectory is playing; pause or stop it first")
#: Reason for refusing a request to resume if a stop came after it.
NOT_RESUMED = message("engine", "Not resumed: the machine was stopped again.")
#: Reasons for the stops that pause and end a playback.
PAUSE_REASON = message("engine", "the playback is paused")
END_REASON = message("engine", "the playback is ended")
#: Axes return to the position of a pause at this fraction of their maximum speed.
RETURN_SPEED_RATIO = 0.1


class PlaybackPhase(StrEnum):
    """The phase of a playback."""

    IDLE = "idle"
    PLAYING = "playing"
    PAUSED = "paused"


@dataclass(frozen=True, slots=True)
class PlaybackState:
    """The state of a playback at one moment.

    Attributes
    ----------
    phase : PlaybackPhase
    row, rows : int
        Last row that was reached, −1 before the first one, and the number of rows.
    path_s, duration_s : float
        Time of the reached position in the trajectory, and duration of the trajectory, s.
    speed : float
        Speed factor relative to the times of the trajectory.
    gaps : mapping axis -> PlaybackGap
        Deviation of readings from the model since the beginning of the playback.
    excess : str or None
        Message of the deviation that stopped the playback, or None.
    pausing : bool
        Whether the playback has been paused but the axes have not come to rest yet.
    moved : mapping axis -> float
        Displacement of each axis' command since it came to rest at the pause, m or rad. Only axes
        with a noticeable displacement are listed, and none while an axis moves.
    """

    phase: PlaybackPhase = PlaybackPhase.IDLE
    row: int = -1
    rows: int = 0
    path_s: float = 0.0
    duration_s: float = 0.0
    speed: float = 1.0
    gaps: Mapping[str, PlaybackGap] = field(default_factory=lambda: MappingProxyType({}))
    excess: str | None = None
    pausing: bool = False
    moved: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))


@contextmanager
def _report_later_stop(permit: Permit) -> Iterator[None]:
    """Raise "not resumed" instead of a refusal if a stop came after the permit."""
    try:
        yield
    except InputError as error:
        if permit.epoch.stops == permit.gate.epoch.stops:
            raise
        raise RequestRefusedError(NOT_RESUMED) from error


class Playback:
    """Plays one trajectory at a time through a session; methods may be called from any thread.

    A pause brings the axes to rest at once, each within its own acceleration, so they leave the
    path by their braking distance at most. Resuming returns the axes to the last row that began. If
    they were moved elsewhere during the pause, :meth:`move_back` must first return them slowly.
    Each played section gives a separate record, which the session's ``PlaybackFinished`` reports.
    Any other stop ends a playback, and so do a fault and a lost connection.

    Parameters
    ----------
    session : MotionSession
    on_excess : callable
        Called once, on the session's thread, with the message of the deviation that has stopped
        the playback.
    """

    def __init__(
        self, session: MotionSession, on_excess: Callable[[str], None] = lambda _: None
    ) -> None:
        self._session = session
        self._on_excess = on_excess
        self._lock = threading.Lock()
        self._trajectory: CheckedTrajectory | None = None
        self._section: RetimedSection | None = None
        self._watch: DeviationWatch | None = None
        self._is_pausing = False
        # Whether the device has begun the first row of the section. Deviations count only from
        # then on.
        self._has_begun = False
        # Commands of the axes at rest after the pause; None until the axes have come to rest.
        self._rest_position: Mapping[str, float] | None = None
        self._is_rest_final = False
        self._state_before_resuming: PlaybackState | None = None
        # Speed limits of axes by the digest of a trajectory.
        self._speed_limits: dict[str, dict[str, float]] = {}
        self._state = PlaybackState()
        self._unsubscribers = (session.subscribe(self._on_event), session.tap(self._on_samples))

    def close(self) -> None:
        """Detach from the session; a running playback continues."""
        for unsubscribe in self._unsubscribers:
            unsubscribe()

    @property
    def state(self) -> PlaybackState:
        """The current state."""
        with self._lock:
            state, watch = self._state, self._watch
            section, trajectory = self._section, self._trajectory
            gaps = watch.gaps if watch is not None else state.gaps
            state = replace(state, pausing=self._is_pausing or self._is_coming_to_rest)
        if state.phase is PlaybackPhase.PAUSED:
            state = replace(state, moved=MappingProxyType(self._measure_moved_axes()))
        if state.phase is PlaybackPhase.PLAYING and section is not None and trajectory is not None:
            reported = self._session.reported
            # Until the device begins, it still reports the progress of its previous playback.
            progress = reported.progress if reported.activity is DeviceState.PLAYING else 0.0
            elapsed_s = progress * section.trajectory.duration_s
            state = self._with_position(state, trajectory, section.find_path_time(elapsed_s))
        return replace(state, gaps=MappingProxyType(gaps))

    def limit_speeds(self, trajectory: CheckedTrajectory, speeds: Mapping[str, float]) -> None:
        """Limit the speeds of axes in a trajectory, for the lifetime of this object.

        Parameters
        ----------
        trajectory : CheckedTrajectory
            The limits apply to every trajectory with the same times and commands.
        speeds : mapping axis -> float
            Maximum speeds, m/s or rad/s.

        Raises
        ------
        OutOfLimitsError
            If a speed is not a finite number above 0, or the trajectory does not contain its axis.
        """
        check_speeds(dict.fromkeys(trajectory.commands.axes, 0.0), speeds)
        with self._lock:
            self._speed_limits.setdefault(trajectory.digest, {}).update(speeds)

    def axes_without_speed_limit(self, trajectory: CheckedTrajectory) -> tuple[str, ...]:
        """Return the axes that a trajectory moves and that have no speed limit."""
        axes = self._session.robot.axes
        with self._lock:
            limits = dict(self._speed_limits.get(trajectory.digest, {}))
        return tuple(
            axis
            for axis in find_moved_axes(trajectory.commands)
            if axes[axis].max_speed is None and axis not in limits
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
            Accepted by a dry run.
        speed : float
            Speed factor, 0.01 to 10. A factor other than 1 is checked against all limits.
        bounds : mapping axis -> float
            Largest permitted deviation of readings from the model, m or rad. A larger one stops the
            playback.
        permit : Permit, optional
            Permit of the request, if the request was made before this call.

        Raises
        ------
        InputError
            If speed or bounds are invalid, or an axis would be faster than :meth:`limit_speeds`
            allows. See also :meth:`MotionSession.play`.
        """
        permit = self._session.permit() if permit is None else permit
        commands = trajectory.commands
        watch = DeviationWatch(self._session.robot, bounds)
        state = PlaybackState(
            rows=len(commands.time_s), duration_s=commands.duration_s, speed=check_speed(speed)
        )
        self._begin(trajectory, 0, state, watch, permit)

    def pause(self, *, by: str = PROGRAM) -> None:
        """Bring the axes to rest, to continue later.

        ``by`` has the same meaning as in :meth:`MotionSession.stop`.

        Raises
        ------
        RequestRefusedError
            If nothing is playing.
        """
        with self._lock:
            if self._state.phase is not PlaybackPhase.PLAYING:
                raise RequestRefusedError("nothing is playing")
            self._is_pausing = True
        self._session.stop(PAUSE_REASON, by=by)

    def resume(self, *, speed: float | None = None, permit: Permit | None = None) -> None:
        """Continue from the last row that began, at the previous speed or another one.

        ``permit`` has the same meaning as in :meth:`play`.

        Raises
        ------
        RequestRefusedError
            If nothing is paused, axes were moved since the pause (:meth:`move_back` returns them),
            or a stop came after the permit. See also :meth:`MotionSession.play`.
        """
        permit = self._session.permit() if permit is None else permit
        trajectory, watch, state = self._require_paused("resume")
        new_speed = state.speed if speed is None else check_speed(speed)
        resumed_state = replace(state, speed=new_speed, excess=None)
        with _report_later_stop(permit):
            self._begin(
                trajectory,
                self._find_next_row(state),
                resumed_state,
                watch,
                permit,
                check=self._refuse_if_moved,
            )

    def move_back(self, *, permit: Permit | None = None) -> None:
        """Move axes slowly back to where the paused playback continues.

        The axes of the trajectory move to the commands of the row at which it continues. Other axes
        that were moved return to where they rested. Each axis moves at :data:`RETURN_SPEED_RATIO`
        of its maximum speed, in a checked :meth:`MotionSession.go_to`. The maximum speed comes from
        :meth:`limit_speeds`, from the robot file, or else from the trajectory itself.

        This does not wait: call :meth:`resume` when ``session.at_rest``. ``permit`` has the same
        meaning as in :meth:`play`.

        Raises
        ------
        OutOfLimitsError, RequestRefusedError
            If nothing is paused. See also :meth:`MotionSession.go_to`.
        """
        permit = self._session.permit() if permit is None else permit
        trajectory, _, state = self._require_paused("resume")
        moved = self._measure_moved_axes()
        if not moved:
            return
        rest_position = self._find_rest_position(trajectory, state)
        targets = {axis: rest_position[axis] for axis in moved} | self._read_row_commands(
            trajectory, state
        )
        with _report_later_stop(permit):
            speeds = self._compute_return_speeds(trajectory, targets)
            self._session.go_to(targets, PLAYBACK, speeds, permit=permit)
        with self._lock:
            self._rest_position, self._is_rest_final = {**rest_position, **targets}, True

    def start_over(self, *, speed: float | None = None, permit: Permit | None = None) -> None:
        """Play the paused trajectory again from its first row, with the same bounds.

        ``speed`` and ``permit`` have the same meaning as in :meth:`resume`.

        Raises
        ------
        InputError
            If nothing is paused. See also :meth:`play`.
        """
        trajectory, watch, state = self._require_paused("start over")
        new_speed = state.speed if speed is None else speed
        self.play(trajectory, speed=new_speed, bounds=watch.bounds, permit=permit)

    def step(self, rows: int = 1) -> None:
        """Move some rows forward or back at normal speed, and rest there. This makes no record.

        Raises
        ------
        RequestRefusedError
            If nothing is paused, or axes were moved since the pause. See also
            :meth:`MotionSession.go_to`.
        """
        trajectory, _, state = self._require_paused("step through")
        self._refuse_if_moved()
        row = state.row + rows
        if not 0 <= row < state.rows:
            raise RequestRefusedError(
                "playback: row {row}: the trajectory has rows 0 to {rows}",
                row=row,
                rows=state.rows - 1,
            )
        time_s, new_state = trajectory.commands.time_s, replace(state, row=row)
        targets = self._read_row_commands(trajectory, new_state)
        self._session.go_to(targets)
        with self._lock:
            rest_position = self._rest_position or self._session.reported.command
            self._rest_position, self._is_rest_final = {**rest_position, **targets}, True
            self._state = replace(new_state, path_s=float(time_s[row] - time_s[0]))

    def load_paused(self, trajectory: CheckedTrajectory) -> None:
        """Load a trajectory, paused before its first row, to step through it.

        Raises
        ------
        RequestRefusedError
            If something is playing.
        """
        commands = trajectory.commands
        with self._lock:
            if self._state.phase is PlaybackPhase.PLAYING:
                raise RequestRefusedError(_ALREADY_PLAYING)
            self._trajectory, self._watch = trajectory, DeviationWatch(self._session.robot)
            # Before the first row no axis has a position to return to.
            self._rest_position, self._is_rest_final = {}, True
            self._state = PlaybackState(
                PlaybackPhase.PAUSED, rows=len(commands.time_s), duration_s=commands.duration_s
            )
        self._session.dismiss_stop()

    def end(self, *, by: str = PROGRAM) -> None:
        """Stop, and forget a paused trajectory.

        ``by`` has the same meaning as in :meth:`MotionSession.stop`.
        """
        self._session.stop(END_REASON, by=by)
        with self._lock:
            self._state = replace(self._state, phase=PlaybackPhase.IDLE)

    def _require_paused(
        self, action: str
    ) -> tuple[CheckedTrajectory, DeviationWatch, PlaybackState]:
        with self._lock:
            if self._state.phase is not PlaybackPhase.PAUSED or not (
                self._trajectory and self._watch
            ):
                raise RequestRefusedError("nothing is paused to {what}", what=action)
            return self._trajectory, self._watch, self._state

    @staticmethod
    def _find_next_row(state: PlaybackState) -> int:
        return min(max(state.row, 0), state.rows - 1)

    def _read_row_commands(
        self, trajectory: CheckedTrajectory, state: PlaybackState
    ) -> dict[str, float]:
        commands, row = trajectory.commands, self._find_next_row(state)
        return {axis: float(commands.signal(axis, Tap.CMD)[row]) for axis in commands.axes}

    def _find_rest_position(
        self, trajectory: CheckedTrajectory, state: PlaybackState
    ) -> Mapping[str, float]:
        """Return where the axes rested, or the commands of the next row if that is unknown."""
        rest_position = self._rest_position
        return (
            self._read_row_commands(trajectory, state) if rest_position is None else rest_position
        )

    def _measure_moved_axes(self) -> dict[str, float]:
        """Return the displacements of axes since the pause, or nothing while an axis moves."""
        with self._lock:
            trajectory, state = self._trajectory, self._state
        if trajectory is None or not self._session.at_rest:
            return {}
        command, axes = self._session.reported.command, self._session.robot.axes
        rest_position = self._find_rest_position(trajectory, state)
        distances = {
            axis: command.get(axis, position) - position for axis, position in rest_position.items()
        }
        return {
            axis: distance
            for axis, distance in distances.items()
            if abs(distance)
            > max(find_noticeable_change(axes[axis]), _MIN_DISTANCE_RATIO * axes[axis].span)
        }

    @property
    def _is_coming_to_rest(self) -> bool:
        """Whether the playback is paused and the axes have not come to rest; needs the lock."""
        is_paused = self._state.phase is PlaybackPhase.PAUSED
        return is_paused and self._rest_position is None and not self._is_rest_final

    def _refuse_if_moved(self) -> None:
        moved = self._measure_moved_axes()
        if not moved:
            return
        robot = self._session.robot
        axis, distance = max(
            moved.items(), key=lambda item: abs(item[1]) / robot.axes[item[0]].span
        )
        raise RequestRefusedError(
            "axis {axis} moved {distance} since the pause; move it back first, or play the "
            "trajectory from its first row",
            axis=AxisName(axis),
            distance=format_quantity(abs(distance), robot.unit(axis) or "", digits=2),
        )

    def _compute_return_speeds(
        self, trajectory: CheckedTrajectory, axes: Iterable[str]
    ) -> dict[str, float]:
        """Return the speed of each axis for moving back, unless its maximum is unknown."""
        with self._lock:
            limits = dict(self._speed_limits.get(trajectory.digest, {}))
        peak_speeds = {
            axis: float(peak) for axis, peak in find_max_speeds(trajectory.commands).items()
        }
        robot = self._session.robot.axes
        max_speeds = {
            axis: limits.get(axis) or robot[axis].max_speed or peak_speeds.get(axis)
            for axis in axes
        }
        return {axis: RETURN_SPEED_RATIO * speed for axis, speed in max_speeds.items() if speed}

    def _begin(
        self,
        trajectory: CheckedTrajectory,
        row: int,
        state: PlaybackState,
        watch: DeviationWatch,
        permit: Permit,
        check: Callable[[], None] | None = None,
    ) -> None:
        """Play from a row on. ``check`` is called at the end and may refuse to resume."""
        period_s = self._session.setpoint_period_s
        trajectory_to_play: Record | CheckedTrajectory = trajectory
        section = retime(
            trajectory.commands, row=row, speed=state.speed, setpoint_period_s=period_s
        )
        if row or state.speed != 1.0:
            trajectory_to_play = section.trajectory
        with self._lock:
            speed_limits = dict(self._speed_limits.get(trajectory.digest, {}))
        if speed_limits:
            limited_robot = with_limits(self._session.robot, speed_limits)
            check_trajectory(limited_robot, section.trajectory, setpoint_period_s=period_s)
        with self._lock:
            if self._state.phase is PlaybackPhase.PLAYING:
                raise RequestRefusedError(_ALREADY_PLAYING)
            previous = (self._trajectory, self._section, self._watch, self._state)
            self._trajectory, self._section, self._watch = trajectory, section, watch
            self._state = replace(state, phase=PlaybackPhase.PLAYING)
            self._is_pausing = self._has_begun = False
            self._state_before_resuming = previous[-1] if check is not None else None
            watch.restart()
        try:
            if check is not None:
                check()
            self._session.play(trajectory_to_play, permit=permit)
        except BaseException:
            with self._lock:
                self._is_pausing = False
                self._trajectory, self._section, self._watch, self._state = previous
            raise

    def _on_samples(self, samples: DeviceSamples, model_outputs: ModelOutputs) -> None:
        """Check the deviation during the playback; runs on the session's thread."""
        begun_rows = np.flatnonzero(samples.playback_row >= 0)
        with self._lock:
            if self._state.phase is PlaybackPhase.PAUSED:
                self._update_rest_position()
            is_playing = self._state.phase is PlaybackPhase.PLAYING
            # Ignore deviations during the move to the first row and while the path is checked.
            self._has_begun |= is_playing and len(begun_rows) > 0
            if not is_playing or self._watch is None or not self._has_begun:
                return
            excess = self._watch.add(samples, model_outputs.in_use, model_outputs.nominal)
            if excess is None or self._state.excess is not None:
                return
            self._state = replace(self._state, excess=excess)
            self._is_pausing = True
        self._session.stop(excess)
        self._on_excess(excess)

    def _on_event(self, event: SessionEvent) -> None:
        if isinstance(event, StateChanged):
            is_lost = event.state.connection is not ConnectionState.CONNECTED
            if is_lost or event.state.activity is DeviceState.FAULT:
                # After a fault or a lost connection a playback neither continues nor can be
                # resumed.
                with self._lock:
                    self._is_pausing = False
                    self._state = replace(self._state, phase=PlaybackPhase.IDLE)
            with self._lock:
                if self._state.phase is PlaybackPhase.PAUSED:
                    self._update_rest_position()
        elif isinstance(event, PlaybackFinished):
            with self._lock:
                self._finish(event)

    def _finish(self, event: PlaybackFinished) -> None:
        trajectory, section = self._trajectory, self._section
        if self._state.phase is not PlaybackPhase.PLAYING or trajectory is None or section is None:
            return
        reached_s = (
            section.path_s[0]
            if event.record is None
            else section.find_path_time(event.record.duration_s + _TIME_ROUNDING_S)
        )
        if event.record is not None or self._state.row >= 0:
            self._state = self._with_position(self._state, trajectory, reached_s)
        is_paused = self._is_pausing and not event.completed
        self._is_pausing = False
        phase = PlaybackPhase.PAUSED if is_paused else PlaybackPhase.IDLE
        self._state = replace(self._state, phase=phase)
        if is_paused:
            self._rest_position, self._is_rest_final = None, False
            self._update_rest_position()
        elif event.record is None and self._state_before_resuming is not None:
            # Nothing was played before the stop, so the playback is paused where it was before.
            self._state = self._state_before_resuming

    def _update_rest_position(self) -> None:
        """Update where the axes rest after a pause, until an axis is moved; needs the lock."""
        if self._is_rest_final:
            return
        if not self._session.is_untouched_since_stop:
            self._is_rest_final = True
        elif self._session.reported.activity is DeviceState.IDLE:
            self._rest_position = self._session.reported.command

    @staticmethod
    def _with_position(
        state: PlaybackState, trajectory: CheckedTrajectory, path_s: float
    ) -> PlaybackState:
        time_s = trajectory.commands.time_s
        row = int(np.searchsorted(time_s, time_s[0] + path_s + _TIME_ROUNDING_S, side="right")) - 1
        return replace(state, row=max(row, 0), path_s=path_s)
