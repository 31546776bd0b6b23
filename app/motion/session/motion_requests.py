"""Motion requests: targets, speeds, safe paths, homing, trajectories, voltages."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import (
    HOMING,
    OPERATOR,
    PLAYBACK,
    DeviceLink,
    HomeCommand,
    PlayCommand,
    VelocityCommand,
    VoltageCommand,
    require_ability,
)
from rotemina.app.motion.limits import Guard, PositionEnvelope, TipPath, check_rows
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.app.motion.session.compensation import AxisInverses
from rotemina.app.motion.session.regulation import FeedbackLoops
from rotemina.app.motion.session.routing import MoveRouting
from rotemina.app.motion.session.undo import plan_safe_path
from rotemina.drivers.abilities import (
    AxisHomer,
    TrajectoryPlayer,
    VelocityMover,
    VoltageOutput,
)
from rotemina.drivers.contract import DeviceState, Permit, PermitPurpose
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.messages import AxisName, format_rounded, message
from rotemina.sim.records import Record
from rotemina.sim.robot import PiezoAxis
from rotemina.sim.trajectory import CheckedTrajectory, accept_trajectory, check_speeds, check_target

# A motion at a set speed ends after this time if it is not renewed.
DEFAULT_LEASE_S = 0.15


@dataclass(eq=False)
class MotionRequests:
    """Requests that move axes. All of them respect ranges, the bounds of the tip, and owners."""

    _link: DeviceLink
    _admission: RequestAdmission
    _guard: Guard
    _inverses: AxisInverses
    _loops: FeedbackLoops
    _routing: MoveRouting

    def go_to(
        self,
        targets: Mapping[str, float],
        owner: str = OPERATOR,
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        confirmed: bool = False,
        permit: Permit | None = None,
    ) -> None:
        """Move axes to positions, m or rad. This is also possible during a move.

        Each axis moves at its maximum speed, or at ``speeds`` (m/s or rad/s) if lower. Close to the
        tip's floor the move slows down. If the move belongs to a longer plan, pass the ``permit``
        that was taken when the plan began: the move is refused if a stop has come since then. A tip
        outside its bounds moves only if the move is ``confirmed``; then it moves slowly, and only
        with axes that bring it back.

        Raises
        ------
        OutOfLimitsError
            If any target is beyond a limit, or the tip might leave its bounds; then no axis moves.
        RequestRefusedError
            If no motion is possible now: not connected, a fault, a playback, a full queue, or an
            axis with another owner.
        """
        permit = self._admission.resolve_permit(permit)
        with self._admission.lock:
            self._queue_targets(dict(targets), owner, speeds, permit, confirmed=confirmed)

    def move_velocity(
        self,
        velocities: Mapping[str, float],
        lease_s: float = DEFAULT_LEASE_S,
        owner: str = OPERATOR,
        *,
        permit: Permit | None = None,
    ) -> dict[str, float]:
        """Move axes at speeds, m/s or rad/s, until the lease runs out; renew it to continue.

        A speed of 0 halts an axis.

        Returns
        -------
        dict axis -> float
            The velocities that are used; close to the tip's bounds they are lower than requested.

        Raises
        ------
        OutOfLimitsError
            If there is no such axis, or the tip might leave its bounds within the lease.
        RequestRefusedError
            If the device cannot move at a set speed. See also :meth:`go_to`.
        """
        permit = self._admission.resolve_permit(permit)
        refusal = message(
            "engine", "driver {name} cannot move at a set speed; send targets instead"
        )
        require_ability(self._link.driver, VelocityMover, refusal).check_velocity(
            velocities, lease_s
        )
        with self._admission.lock:
            self._admission.refuse_if_motion_blocked()
            guard = self._guard
            position_limits = self._inverses.position_limits
            limited_velocities = guard.limit_velocities(
                self._admission.compute_envelope(velocities), velocities, lease_s, position_limits
            )
            travels, braking_travels = (
                guard.compute_travels(limited_velocities, lease_s),
                guard.compute_travels(limited_velocities, 0.0),
            )
            requested_s = self._link.clock()
            command = VelocityCommand(
                limited_velocities, lease_s, requested_s, travels, braking_travels
            )
            permit = permit.with_deadline(requested_s + lease_s)
            self._admission.queue_move(command, permit, velocities, owner)
        return limited_velocities

    def home(self, axes: Sequence[str] | None = None) -> None:
        """Search for the limit switches of axes, or of all axes that have limit switches.

        Raises
        ------
        RequestRefusedError
            If the device has no limit switches, or is not at rest.
        """
        permit = self._link.gate.permit(PermitPurpose.HOMING)
        refusal = message("engine", "driver {name} has no limit switches")
        driver = require_ability(self._link.driver, AxisHomer, refusal)
        homed_axes = driver.homing_axes if axes is None else tuple(axes)
        with self._admission.lock:
            state = self._link.snapshot()
            reason = self._link.find_unready_reason(state)
            if reason is not None:
                raise RequestRefusedError("motion is locked: {locked}", locked=reason)
            if state.activity is not DeviceState.IDLE or len(self._link.mailbox):
                raise RequestRefusedError(
                    "the machine is still moving; stop it or wait before homing"
                )
            self._admission.queue(HomeCommand(homed_axes), permit, homed_axes, HOMING)
            self._admission.undo_history.forget()

    def undo(self, *, permit: Permit | None = None) -> None:
        """Return to where the axes rested before the latest move, on a safe path: up, across, down.

        Raises
        ------
        OutOfLimitsError, RequestRefusedError
            See :meth:`go_to`. Also if there is no previous position.
        """
        permit = self._admission.resolve_permit(permit)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("going back")
            waypoints = self._admission.undo_history.plan_return(
                dict(self._link.worker.state.command)
            )
            self._routing.queue(self._routing.plan_along(waypoints), permit, OPERATOR, returns=True)

    def go_safely(
        self,
        goal: Mapping[str, float],
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        permit: Permit | None = None,
    ) -> None:
        """Move axes to a position on a safe path: up, across, down.

        ``speeds`` has the same meaning as in :meth:`go_to`.

        Raises
        ------
        OutOfLimitsError, RequestRefusedError
            See :meth:`go_to`. Also if the machine is not at rest; then no axis moves.
        """
        permit = self._admission.resolve_permit(permit)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("going there")
            for axis, position in goal.items():
                check_target(self._link.robot, axis, position)
            self._inverses.check_targets(goal)
            waypoints = plan_safe_path(
                self._link.robot, dict(self._link.worker.state.command), goal
            )
            self._routing.queue(
                self._routing.plan_along(waypoints), permit, OPERATOR, speeds=speeds
            )

    @property
    def can_undo(self) -> bool:
        """Whether there is a previous position to go back to."""
        with self._admission.lock:
            return self._admission.undo_history.has_previous(dict(self._link.worker.state.command))

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
        """Move one axis by a distance (m or rad) from its latest target.

        ``speeds`` and ``confirmed`` have the same meaning as in :meth:`go_to`.

        Raises
        ------
        OutOfLimitsError, RequestRefusedError
            See :meth:`go_to`.
        """
        self.move_by({axis: distance}, owner, speeds, confirmed=confirmed, permit=permit)

    def move_by(
        self,
        distances: Mapping[str, float],
        owner: str = OPERATOR,
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        confirmed: bool = False,
        permit: Permit | None = None,
    ) -> None:
        """Move axes by distances (m or rad), each from its latest target; all of them or none.

        ``speeds`` and ``confirmed`` have the same meaning as in :meth:`go_to`.

        Raises
        ------
        OutOfLimitsError, RequestRefusedError
            See :meth:`go_to`.
        """
        permit = self._admission.resolve_permit(permit)
        for axis in distances:
            if axis not in self._link.robot.axes:
                check_target(self._link.robot, axis, 0.0)
        with self._admission.lock:
            self._admission.refuse_if_motion_blocked()
            targets = {
                axis: self._find_target(axis) + distance for axis, distance in distances.items()
            }
            self._queue_targets(targets, owner, speeds, permit, confirmed=confirmed)

    def play(
        self,
        trajectory: Record | CheckedTrajectory,
        *,
        permit: Permit | None = None,
        shown: bool = True,
    ) -> None:
        """Play a trajectory; events report its end, with the record.

        If ``shown`` is false, the playback only moves the machine somewhere; its record is not kept
        or compared with the model.

        The caller's thread checks the limits of a plain record, which takes half a second for a
        million rows. A trajectory from a dry run (``dry_run(…).require()``) is not checked again.
        The same thread checks the path of the tip, which takes seconds if the tip has bounds. A
        window must therefore not call this from its own thread.

        Raises
        ------
        OutOfLimitsError, TrajectoryError
            If the trajectory exceeds a limit or does not fit this robot.
        RequestRefusedError
            If the device cannot play or is not at rest. See also :meth:`go_to`.
        """
        permit = self._admission.resolve_permit(permit)
        checked = self._require_playable(trajectory)
        converted, compensations = self._inverses.convert_trajectory(checked)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("playing")
            envelope, basis = self._admission.compute_envelope(), self._read_path_check_basis()
        # The check of the path may take seconds. It holds no lock, so no other request waits.
        self._check_path(envelope, checked, converted)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("playing")
            if self._read_path_check_basis() != basis:
                raise RequestRefusedError(
                    "the machine or the bounds of the tip have changed; play again"
                )
            loops = {axis: loop.name for axis, loop in self._loops.applied.items()}
            play = PlayCommand(checked, converted, compensations, loops, shown)
            self._admission.queue_move(play, permit, self._link.driver.axes, PLAYBACK)

    def check_play(self, trajectory: Record | CheckedTrajectory) -> None:
        """Refuse a trajectory that :meth:`play` would refuse from the current position.

        A lock or a running motion is no reason to refuse here, because both are temporary. The
        bounds of the tip are not checked while the position is unknown.

        Raises
        ------
        OutOfLimitsError, TrajectoryError, RequestRefusedError
            See :meth:`play`.
        """
        checked = self._require_playable(trajectory)
        converted, _ = self._inverses.convert_trajectory(checked)
        with self._admission.lock:
            envelope, is_position_known = (
                self._admission.compute_envelope(),
                bool(self._link.worker.state.command),
            )
        if is_position_known:
            self._check_path(envelope, checked, converted)

    def tip_path(self, commands: Record) -> TipPath | None:
        """Return the path of the tip along a trajectory from the current position.

        Returns
        -------
        TipPath or None
            None if the robot has no tip, or the position is unknown.

        Raises
        ------
        TrajectoryError
            If the trajectory does not fit this robot.
        """
        with self._admission.lock:
            envelope, is_position_known = (
                self._admission.compute_envelope(),
                bool(self._link.worker.state.command),
            )
        return self._guard.compute_tip_path(envelope, commands) if is_position_known else None

    @property
    def path_check_basis(self) -> tuple[object, ...]:
        """All values that a path check depends on; the check stays valid while they are equal."""
        with self._admission.lock:
            return self._read_path_check_basis()

    def set_voltage(
        self, axis: str, voltage: float, owner: str = OPERATOR, *, permit: Permit | None = None
    ) -> None:
        """Set a piezo's voltage, V; the resulting position is checked against all limits.

        Raises
        ------
        OutOfLimitsError
            If the voltage or its position is beyond a limit, or the tip might leave its bounds.
        RequestRefusedError
            If the device cannot set voltages, the machine is not at rest, the tip is so low that it
            must move slowly, or for the same reasons as any move.
        """
        permit = self._admission.resolve_permit(permit)
        refusal = message("engine", "driver {name} cannot set a voltage")
        require_ability(self._link.driver, VoltageOutput, refusal)
        axis_model = self._link.robot.axes.get(axis)
        if not isinstance(axis_model, PiezoAxis) or axis_model.controller is not None:
            raise OutOfLimitsError("axis {axis} has no amplifier for a voltage", axis=repr(axis))
        voltage_range = axis_model.voltage_range
        if voltage_range is not None and not voltage_range[0] <= voltage <= voltage_range[1]:
            raise OutOfLimitsError(
                "axis {axis}: {voltage} V: must be {low} to {high} V",
                axis=AxisName(axis),
                voltage=format_rounded(voltage, 6),
                low=format_rounded(voltage_range[0], 6),
                high=format_rounded(voltage_range[1], 6),
            )
        targets = {axis: voltage * axis_model.gain}
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("setting a voltage")
            segments = self._guard.plan_move(self._admission.compute_envelope(), targets)
            if len(segments) > 1 or segments[0].speeds:
                raise RequestRefusedError(
                    "axis {axis}: a voltage acts at once, which is too fast this close "
                    "to the floor of the tip; move the axis instead",
                    axis=AxisName(axis),
                )
            command = VoltageCommand(axis, voltage, targets)
            self._admission.queue_move(command, permit, (axis,), owner)

    def _require_playable(self, trajectory: Record | CheckedTrajectory) -> CheckedTrajectory:
        refusal = message("engine", "driver {name} cannot play trajectories")
        require_ability(self._link.driver, TrajectoryPlayer, refusal)
        return accept_trajectory(self._link.robot, trajectory, self._link.setpoint_period_s)

    def _check_path(
        self,
        envelope: PositionEnvelope,
        checked: CheckedTrajectory,
        converted: CheckedTrajectory | None,
    ) -> None:
        """Refuse a trajectory that leaves a narrowed range or, also converted, the tip's bounds."""
        check_rows(self._link.robot, self._guard.narrowed_ranges, checked.commands)
        self._guard.check_trajectory(envelope, checked)
        if converted is not None:
            self._guard.check_trajectory(envelope, converted)

    def _queue_targets(
        self,
        targets: dict[str, float],
        owner: str,
        speeds: Mapping[str, float],
        permit: Permit,
        *,
        confirmed: bool,
    ) -> None:
        self._admission.refuse_if_motion_blocked()
        self._inverses.check_targets(targets)
        check_speeds(targets, speeds)
        segments = self._routing.plan_to(targets, owner, confirmed=confirmed)
        self._routing.queue(segments, permit, owner, speeds=speeds)

    def _read_path_check_basis(self) -> tuple[object, ...]:
        guard, state = self._guard, self._link.worker.state
        return dict(state.command), guard.zone, guard.narrowed_ranges, dict(self._inverses.applied)

    def _find_target(self, axis: str) -> float:
        """Return the latest accepted target of an axis, or else its current position."""
        pending, worker = self._link.mailbox.list_pending_targets(), self._link.worker
        candidates = (*reversed(pending), worker.executor.ends, worker.state.command)
        return next(
            (positions[axis] for positions in candidates if axis in positions), float("nan")
        )
