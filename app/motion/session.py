"""A motion session: the one place through which a program moves a machine."""

from collections.abc import Container, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from rotemina.app.motion.guard import PathSegment, PositionEnvelope
from rotemina.app.motion.mailbox import (
    Drive,
    Home,
    Move,
    Play,
    RefusedError,
)
from rotemina.app.motion.ownership import HOMING, OPERATOR, PLAYBACK
from rotemina.app.motion.regulation import RegulatedRequests
from rotemina.app.motion.safe_path import safe_path
from rotemina.app.motion.state import (
    SessionState,
)
from rotemina.app.motion.undo import Undo
from rotemina.drivers.abilities import (
    Homer,
    TrajectoryPlayer,
    VelocityMover,
)
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Permit, Purpose
from rotemina.drivers.samples import DeviceState
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.checked import CheckedTrajectory, accepted
from rotemina.sim.trajectory.limits import OutOfLimitsError, check_speeds, check_target

LEASE_S = 0.15  # of a speed that nobody renews


class MotionSession(RegulatedRequests):
    """Every motion passes through here: ranges, the tip's bounds and owners hold on every path.

    A request is checked on the caller's thread and refused at once with the reason
    (:class:`rotemina.sim.errors.InputError`), or queued for the worker.

    Parameters are those of :class:`rotemina.app.motion.device_session.DeviceSession`.
    """

    def __init__(self, driver: Driver, **options: Any) -> None:
        super().__init__(driver, **options)
        self._undo = Undo(self.robot)

    # --- motion -----------------------------------------------------------------------------------

    def go_to(
        self,
        targets: Mapping[str, float],
        owner: str = OPERATOR,
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        confirmed: bool = False,
        permit: Permit | None = None,
    ) -> None:
        """Send axes to positions, m or rad; also in mid-move.

        Each goes as fast as it may, or as ``speeds`` (m/s or rad/s) says, where that is slower.
        Close above the tip's floor the move slows down by itself. A ``permit`` is that of the plan
        that this is a part of: a stop since then ends it. A tip that is out of its bounds moves
        only if somebody has ``confirmed`` that, slowly, by axes that each bring it back.

        Raises
        ------
        OutOfLimitsError
            If any target is beyond a limit, or the tip might leave its bounds; then no axis moves.
        RefusedError
            If no motion is possible now: not connected, a fault, a playback, a full queue, an axis
            that another owner drives.
        """
        permit = self._drawn(permit)
        with self._lock:
            self._post_move(dict(targets), owner, speeds, permit, confirmed=confirmed)

    def move_velocity(
        self,
        velocities: Mapping[str, float],
        lease_s: float = LEASE_S,
        owner: str = OPERATOR,
        *,
        permit: Permit | None = None,
    ) -> dict[str, float]:
        """Let axes go at speeds, m/s or rad/s, until the lease runs out; renew it to go on.

        Returns the speeds that are used: close to the tip's bounds they are lower. A speed of 0
        halts an axis.

        Raises
        ------
        OutOfLimitsError
            If there is no such axis, or the tip might leave its bounds within the lease.
        RefusedError
            If the device cannot, or as :meth:`go_to`.
        """
        permit = self._drawn(permit)
        driver = self.driver
        if not isinstance(driver, VelocityMover):
            raise RefusedError(f"driver {driver.name!r} cannot move at a speed; send targets")
        driver.check_velocity(velocities, lease_s)
        with self._lock:
            self._refuse_if_locked()
            guard = self._guard
            used = guard.velocity(self._envelope(velocities), velocities, lease_s)
            ways, braking = guard.ways(used, lease_s), guard.ways(used, 0.0)
            with self._worker.ownership.claimed(velocities, owner):
                self._note_rest()
                asked_s = self._clock()
                self._mailbox.post(
                    Drive(used, lease_s, asked_s, ways, braking),
                    permit.owned(velocities, owner).until(asked_s + lease_s),
                )
        return used

    def home(self, axes: Sequence[str] | None = None) -> None:
        """Find the limit switches of axes, or of all that have some.

        Raises
        ------
        RefusedError
            If the device has none, or is not at rest.
        """
        permit = self.permit(Purpose.HOMING)
        driver = self.driver
        if not isinstance(driver, Homer):
            raise RefusedError(f"driver {driver.name!r} has no switches to be found")
        wanted = driver.homing_axes if axes is None else tuple(axes)
        with self._lock:
            state = self.snapshot()
            why = self._unready(state)
            if why is not None:
                raise RefusedError(f"motion is locked: {why}")
            if state.activity is not DeviceState.IDLE or len(self._mailbox):
                raise RefusedError("the machine is still moving; stop it or wait before homing")
            with self._worker.ownership.claimed(wanted, HOMING):
                self._mailbox.post(Home(wanted), permit.owned(wanted, HOMING))
            self._undo.forget()

    def undo(self, *, permit: Permit | None = None) -> None:
        """Go back to where the axes rested before the latest move: up, across, down.

        Raises
        ------
        OutOfLimitsError, RefusedError
            As :meth:`go_to`, or if there is no move to take back.
        """
        permit = self._drawn(permit)
        with self._lock:
            self._refuse_if_locked()
            self._refuse_in_motion("going back")
            segments = self._segments(self._undo.back(dict(self._worker.state.command)))
            with self._worker.ownership.claimed(_axes(segments), OPERATOR):
                self._mailbox.post(Move(segments), permit.owned(_axes(segments), OPERATOR))

    def go_safely(
        self,
        goal: Mapping[str, float],
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        permit: Permit | None = None,
    ) -> None:
        """Send axes to a place by a safe way: up, across, down; ``speeds`` as in :meth:`go_to`.

        Raises
        ------
        OutOfLimitsError, RefusedError
            As :meth:`go_to`, or if the machine is not at rest; then no axis moves.
        """
        permit = self._drawn(permit)
        with self._lock:
            self._refuse_if_locked()
            self._refuse_in_motion("going there")
            for axis, position in goal.items():
                check_target(self.robot, axis, position)
            self._check_seen(goal)
            ways = safe_path(self.robot, dict(self._worker.state.command), goal)
            segments = tuple(segment.no_faster(speeds) for segment in self._segments(ways))
            with self._worker.ownership.claimed(_axes(segments), OPERATOR):
                self._note_rest()
                self._mailbox.post(Move(segments), permit.owned(_axes(segments), OPERATOR))

    @property
    def undoable(self) -> bool:
        """Whether there is a move to take back."""
        with self._lock:
            return self._undo.leads_from(dict(self._worker.state.command))

    def use(self, driver: Driver) -> None:
        """Stop, let go of the device, and connect to another one; no way leads back to the first.

        Raises
        ------
        RefusedError
            If the other driver is for another robot.
        """
        super().use(driver)
        with self._lock:
            self._undo.forget()

    def take_over(self, axes: Sequence[str], owner: str) -> None:
        """Make axes an owner's that another one drives; they go on until told otherwise."""
        self._worker.ownership.take_over(axes, owner)

    def jog(
        self,
        axis: str,
        distance: float,
        owner: str = OPERATOR,
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        confirmed: bool = False,
        permit: Permit | None = None,
    ) -> None:
        """Move one axis by a distance (m or rad) from where it was last sent.

        ``speeds`` and ``confirmed`` as in :meth:`go_to`.

        Raises
        ------
        OutOfLimitsError, RefusedError
            As :meth:`go_to`.
        """
        permit = self._drawn(permit)
        if axis not in self.robot.axes:
            check_target(self.robot, axis, 0.0)
        with self._lock:
            self._refuse_if_locked()
            target = self._target_of(axis) + distance
            self._post_move({axis: target}, owner, speeds, permit, confirmed=confirmed)

    def play(self, trajectory: Record | CheckedTrajectory, *, permit: Permit | None = None) -> None:
        """Play a trajectory; events tell how it ends, with the record.

        A bare record is checked on the caller's thread, which takes half a second for a million
        rows; what a dry run allowed (``dry_run(…).require()``) is not checked again. The tip's path
        is checked on that thread too, seconds long where it is bounded: a window asks from another.

        Raises
        ------
        OutOfLimitsError, TrajectoryError
            If it exceeds a limit or is not one for this robot.
        RefusedError
            If the device cannot play or is not at rest, or as :meth:`go_to`.
        """
        permit = self._drawn(permit)
        if not isinstance(self.driver, TrajectoryPlayer):
            raise RefusedError(f"driver {self.driver.name!r} cannot play trajectories")
        checked = accepted(self.robot, trajectory, self.setpoint_period_s)
        sent, compensations = self._sent(checked)
        with self._lock:
            self._refuse_if_locked()
            self._refuse_in_motion("playing")
            envelope, checked_for = self._envelope(), self._standing()
        # Neither a stop nor a request waits for a check of the path: no lock is held.
        self._guard.play(envelope, checked)
        if sent is not None:
            self._guard.play(envelope, sent)
        with self._lock:
            self._refuse_if_locked()
            self._refuse_in_motion("playing")
            if self._standing() != checked_for:
                raise RefusedError("the machine or the tip's bounds have changed; play once more")
            with self._worker.ownership.claimed(self.driver.axes, PLAYBACK):
                self._note_rest()
                loops = {axis: one.name for axis, one in self.regulated.items()}
                self._mailbox.post(
                    Play(checked, sent, compensations, loops),
                    permit.owned(self.driver.axes, PLAYBACK),
                )

    # --- bounds and parameters --------------------------------------------------------------------

    @property
    def keep_out(self) -> KeepOutZone | None:
        """The tip's bounds; None where the robot has no tip."""
        return self._guard.zone

    def teach_floor(self, clearance: float = 0.0) -> float:
        """Put the tip's floor where the tip is now, or that much lower; return its height, m.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip, or the height is none that the tip can have.
        RefusedError
            If the machine is not at rest, or motion is locked.
        """
        zone = self._guard.zone
        if zone is None:
            raise OutOfLimitsError(f"robot {self.robot.name!r} has no tip that a floor could hold")
        if not 0.0 <= clearance < float("inf"):
            raise OutOfLimitsError(
                f"tip: a floor {clearance:g} m below the tip: must be a finite number, 0 or more"
            )
        with self._lock:
            self._refuse_unless_at_rest("teaching the floor")
            command = self._worker.state.command
            tip = zone.tip(np.array([command[axis] for axis in self.driver.axes]))
            floor = float(tip[2]) - clearance
            self._guard.teach_floor(floor)
        return floor

    def clear_floor(self) -> None:
        """Take the tip's floor away; the objective stays a bound.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip.
        RefusedError
            If the machine is not at rest, or motion is locked.
        """
        with self._lock:
            self._refuse_unless_at_rest("removing the floor")
            self._guard.teach_floor(None)

    def snapshot(self) -> SessionState:
        """Return the present state; any thread."""
        state = super().snapshot()
        return replace(state, tip=self._tip(state))

    def _post_move(
        self,
        targets: dict[str, float],
        owner: str,
        speeds: Mapping[str, float],
        permit: Permit,
        *,
        confirmed: bool,
    ) -> None:
        self._refuse_if_locked()
        self._check_seen(targets)
        check_speeds(targets, speeds)
        ways = self._guard.move(self._envelope(), targets, confirmed=confirmed)
        segments = tuple(segment.no_faster(speeds) for segment in ways)
        with self._worker.ownership.claimed(targets, owner):
            self._note_rest()
            self._mailbox.post(Move(segments), permit.owned(targets, owner))

    def _envelope(self, driven: Container[str] = ()) -> PositionEnvelope:
        """Return where the axes may be by what they have been told and said last.

        The axes ``driven`` are told a speed anew: their lease from before does not count.
        """
        worker = self._worker
        command = worker.state.command
        ends = [command, worker.targets, *self._mailbox.pending()]
        given = [*worker.drives.items(), *((a, d) for d in self._mailbox.drives() for a in d.ways)]
        for axis, drive in given:
            way = (drive.braking if axis in driven else drive.ways).get(axis, 0.0)
            if axis in command:
                ends.append({axis: command[axis] + way})
        return self._guard.envelope(worker.deviation.now, *ends)

    def _segments(self, ways: Sequence[Mapping[str, float]]) -> tuple[PathSegment, ...]:
        """Return how places are gone to, one after the other, from where the machine rests."""
        envelope, reached = self._envelope(), dict(self._worker.state.command)
        segments: list[PathSegment] = []
        for targets in ways:
            segments += self._guard.move(envelope, targets)
            reached |= targets
            envelope = self._guard.envelope(envelope.deviation, reached)
        return tuple(segments)

    def _standing(self) -> tuple[object, ...]:
        """Return what a check of a path rests on, while the machine rests."""
        return dict(self._worker.state.command), self._guard.zone, dict(self.compensated)

    def _refuse_in_motion(self, before: str) -> None:
        if not self._worker.at_rest:
            raise RefusedError(f"the machine is still moving; stop it or wait before {before}")

    def _note_rest(self) -> None:
        """Keep where the machine rests, to come back to, before it begins to move."""
        if self._worker.state.activity is DeviceState.IDLE and not len(self._mailbox):
            self._undo.note(self._worker.state.command)

    def _forget_way_back(self) -> None:
        self._undo.forget()

    def _tip(self, state: SessionState) -> tuple[float, float, float] | None:
        zone = self._guard.zone
        if zone is None or not state.command:
            return None
        x, y, z = zone.tip(np.array([state.command[axis] for axis in self.driver.axes])).tolist()
        return x, y, z

    def _target_of(self, axis: str) -> float:
        """Return where an axis was last sent by a command that nobody refused, or stands."""
        target = self._mailbox.target_of(axis)
        if target is None:
            target = self._worker.targets.get(axis)
        if target is None:
            target = self._worker.state.command.get(axis, float("nan"))
        return target

    def _refuse_if_locked(self) -> None:
        state = self.snapshot()
        if state.locked is not None:
            raise RefusedError(f"motion is locked: {state.locked}")
        if state.activity is DeviceState.HOMING:
            raise RefusedError("the machine looks for its switches; wait, or stop it first")
        if state.activity is DeviceState.PLAYING or self._mailbox.holds_play():
            raise RefusedError("a trajectory is playing and owns every axis; stop it first")


def _axes(segments: Sequence[PathSegment]) -> set[str]:
    return {axis for segment in segments for axis in segment.targets}
