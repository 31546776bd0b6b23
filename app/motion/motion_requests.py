"""Motion requests: single axes, speeds, safe paths, homing, trajectories, voltages."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.compensation import Inverses
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.guard import Guard, TipPath
from rotemina.app.motion.mailbox import Drive, Home, Play, RefusedError, SetVoltage, able
from rotemina.app.motion.ownership import HOMING, OPERATOR, PLAYBACK
from rotemina.app.motion.position_envelope import PositionEnvelope
from rotemina.app.motion.ranges import check_rows
from rotemina.app.motion.regulation import Loops
from rotemina.app.motion.routing import Routing
from rotemina.app.motion.undo import safe_path
from rotemina.drivers.abilities import Homer, TrajectoryPlayer, VelocityMover, VoltageOutput
from rotemina.drivers.gate import Permit, Purpose
from rotemina.drivers.samples import DeviceState
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import PiezoAxis
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError, check_speeds, check_target
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory, accepted

LEASE_S = 0.15  # of a speed that nobody renews


@dataclass(eq=False)
class Moves:
    """What moves axes; ranges, the tip's bounds and owners hold on every path."""

    _link: DeviceLink
    _admission: Admission
    _guard: Guard
    _inverses: Inverses
    _loops: Loops
    _routing: Routing

    def go_to(
        self,
        targets: Mapping[str, float],
        owner: str = OPERATOR,
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        confirmed: bool = False,
        permit: Permit | None = None,
    ) -> None:
        """Send axes to positions, m or rad; also during a move.

        Each axis moves at its maximum speed, or at ``speeds`` (m/s or rad/s) if lower. Close to the
        tip's floor the move slows down. A ``permit`` belongs to the plan that includes this move: a
        stop since then ends it. A tip outside its bounds moves only if ``confirmed``, slowly, by
        axes that each bring it back.

        Raises
        ------
        OutOfLimitsError
            If any target is beyond a limit, or the tip might leave its bounds; then no axis moves.
        RefusedError
            If no motion is possible now: not connected, a fault, a playback, a full queue, an axis
            that another owner drives.
        """
        permit = self._admission.drawn(permit)
        with self._admission.lock:
            self._send(dict(targets), owner, speeds, permit, confirmed=confirmed)

    def move_velocity(
        self,
        velocities: Mapping[str, float],
        lease_s: float = LEASE_S,
        owner: str = OPERATOR,
        *,
        permit: Permit | None = None,
    ) -> dict[str, float]:
        """Move axes at speeds, m/s or rad/s, until the lease runs out; renew it to continue.

        Returns the speeds that are used: close to the tip's bounds they are lower. A speed of 0
        halts an axis.

        Raises
        ------
        OutOfLimitsError
            If there is no such axis, or the tip might leave its bounds within the lease.
        RefusedError
            If the device cannot, or as :meth:`go_to`.
        """
        permit = self._admission.drawn(permit)
        refusal = message(
            "engine", "driver {name} cannot move at a set speed; send targets instead"
        )
        able(self._link.driver, VelocityMover, refusal).check_velocity(velocities, lease_s)
        with self._admission.lock:
            self._admission.refuse_if_locked()
            guard = self._guard
            ends = self._inverses.ends
            used = guard.velocity(self._admission.envelope(velocities), velocities, lease_s, ends)
            ways, braking = guard.ways(used, lease_s), guard.ways(used, 0.0)
            asked_s = self._link.clock()
            drive = Drive(used, lease_s, asked_s, ways, braking)
            permit = permit.until(asked_s + lease_s)
            self._admission.queue_move(drive, permit, velocities, owner)
        return used

    def home(self, axes: Sequence[str] | None = None) -> None:
        """Find the limit switches of axes, or of all that have some.

        Raises
        ------
        RefusedError
            If the device has none, or is not at rest.
        """
        permit = self._link.gate.permit(Purpose.HOMING)
        refusal = message("engine", "driver {name} has no limit switches")
        driver = able(self._link.driver, Homer, refusal)
        wanted = driver.homing_axes if axes is None else tuple(axes)
        with self._admission.lock:
            state = self._link.snapshot()
            why = self._link.unready(state)
            if why is not None:
                raise RefusedError(message("engine", "motion is locked: {locked}").fill(locked=why))
            if state.activity is not DeviceState.IDLE or len(self._link.mailbox):
                raise RefusedError(
                    message("engine", "the machine is still moving; stop it or wait before homing")
                )
            self._admission.queue(Home(wanted), permit, wanted, HOMING)
            self._admission.way_back.forget()

    def undo(self, *, permit: Permit | None = None) -> None:
        """Go back to where the axes rested before the latest move: up, across, down.

        Raises
        ------
        OutOfLimitsError, RefusedError
            As :meth:`go_to`, or if there is no move to take back.
        """
        permit = self._admission.drawn(permit)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("going back")
            ways = self._admission.way_back.back(dict(self._link.worker.state.command))
            self._routing.queue(self._routing.along(ways), permit, OPERATOR, returns=True)

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
        permit = self._admission.drawn(permit)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("going there")
            for axis, position in goal.items():
                check_target(self._link.robot, axis, position)
            self._inverses.check(goal)
            ways = safe_path(self._link.robot, dict(self._link.worker.state.command), goal)
            self._routing.queue(self._routing.along(ways), permit, OPERATOR, speeds=speeds)

    @property
    def undoable(self) -> bool:
        """Whether there is a move to take back."""
        with self._admission.lock:
            return self._admission.way_back.leads_from(dict(self._link.worker.state.command))

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
        """Move axes by distances (m or rad), each from where it was last sent; all of them or none.

        ``speeds`` and ``confirmed`` as in :meth:`go_to`.

        Raises
        ------
        OutOfLimitsError, RefusedError
            As :meth:`go_to`.
        """
        permit = self._admission.drawn(permit)
        for axis in distances:
            if axis not in self._link.robot.axes:
                check_target(self._link.robot, axis, 0.0)
        with self._admission.lock:
            self._admission.refuse_if_locked()
            targets = {axis: self._target_of(axis) + way for axis, way in distances.items()}
            self._send(targets, owner, speeds, permit, confirmed=confirmed)

    def play(
        self,
        trajectory: Record | CheckedTrajectory,
        *,
        permit: Permit | None = None,
        shown: bool = True,
    ) -> None:
        """Play a trajectory; events report its end, with the record.

        Without ``shown`` it is a way to somewhere, and no run to keep and compare.

        A bare record is checked on the caller's thread, which takes half a second for a million
        rows; a trajectory from a dry run (``dry_run(…).require()``) is not checked again. The tip's
        path is also checked on that thread, which takes seconds if the tip has bounds: call it from
        a thread of its own in a window.

        Raises
        ------
        OutOfLimitsError, TrajectoryError
            If it exceeds a limit or is not one for this robot.
        RefusedError
            If the device cannot play or is not at rest, or as :meth:`go_to`.
        """
        permit = self._admission.drawn(permit)
        checked = self._playable(trajectory)
        sent, compensations = self._inverses.sent(checked)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("playing")
            envelope, checked_for = self._admission.envelope(), self._standing()
        # Neither a stop nor a request waits for a check of the path: no lock is held.
        self._check_path(envelope, checked, sent)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("playing")
            if self._standing() != checked_for:
                raise RefusedError(
                    message(
                        "engine", "the machine or the bounds of the tip have changed; play again"
                    )
                )
            loops = {axis: one.name for axis, one in self._loops.applied.items()}
            play = Play(checked, sent, compensations, loops, shown)
            self._admission.queue_move(play, permit, self._link.driver.axes, PLAYBACK)

    def check_play(self, trajectory: Record | CheckedTrajectory) -> None:
        """Refuse a trajectory that :meth:`play` would refuse from where the axes rest; none moves.

        That motion is locked, or under way, is no reason here: it passes. Nor are the tip's bounds
        while no position is known.

        Raises
        ------
        OutOfLimitsError, TrajectoryError, RefusedError
            As :meth:`play`.
        """
        checked = self._playable(trajectory)
        sent, _ = self._inverses.sent(checked)
        with self._admission.lock:
            envelope, known = self._admission.envelope(), bool(self._link.worker.state.command)
        if known:
            self._check_path(envelope, checked, sent)

    def tip_path(self, commands: Record) -> TipPath | None:
        """Return the path of the tip for a trajectory's commands from the present position.

        None without a tip, or if no position is known.

        Raises
        ------
        TrajectoryError
            If it is none of this robot's.
        """
        with self._admission.lock:
            envelope, known = self._admission.envelope(), bool(self._link.worker.state.command)
        return self._guard.tip_path(envelope, commands) if known else None

    @property
    def standing(self) -> tuple[object, ...]:
        """What a check of a path rests on; it is equal as long as that holds."""
        with self._admission.lock:
            return self._standing()

    def set_voltage(
        self, axis: str, voltage: float, owner: str = OPERATOR, *, permit: Permit | None = None
    ) -> None:
        """Set a piezo's voltage, V; the resulting position is checked against all limits.

        Raises
        ------
        OutOfLimitsError
            If the voltage or its position is beyond a limit, or the tip might leave its bounds.
        RefusedError
            If the device cannot, the machine is not at rest, the tip is so low that it must go
            slowly, or as for any move.
        """
        permit = self._admission.drawn(permit)
        refusal = message("engine", "driver {name} cannot set a voltage")
        able(self._link.driver, VoltageOutput, refusal)
        model = self._link.robot.axes.get(axis)
        if not isinstance(model, PiezoAxis) or model.controller is not None:
            raise OutOfLimitsError(
                message("engine", "axis {axis} has no amplifier for a voltage").fill(
                    axis=repr(axis)
                )
            )
        bounds = model.voltage_range
        if bounds is not None and not bounds[0] <= voltage <= bounds[1]:
            raise OutOfLimitsError(
                message("engine", "axis {axis}: {voltage} V: must be {low} to {high} V").fill(
                    axis=AxisName(axis),
                    voltage=rounded(voltage, 6),
                    low=rounded(bounds[0], 6),
                    high=rounded(bounds[1], 6),
                )
            )
        targets = {axis: voltage * model.gain}
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("setting a voltage")
            segments = self._guard.move(self._admission.envelope(), targets)
            if len(segments) > 1 or segments[0].speeds:
                raise RefusedError(
                    message(
                        "engine",
                        "axis {axis}: a voltage acts at once, which is too fast this close "
                        "to the floor of the tip; move the axis instead",
                    ).fill(axis=AxisName(axis))
                )
            command = SetVoltage(axis, voltage, targets)
            self._admission.queue_move(command, permit, (axis,), owner)

    def _playable(self, trajectory: Record | CheckedTrajectory) -> CheckedTrajectory:
        refusal = message("engine", "driver {name} cannot play trajectories")
        able(self._link.driver, TrajectoryPlayer, refusal)
        return accepted(self._link.robot, trajectory, self._link.setpoint_period_s)

    def _check_path(
        self, envelope: PositionEnvelope, checked: CheckedTrajectory, sent: CheckedTrajectory | None
    ) -> None:
        """Refuse a path that leaves a narrowed range, or the tip's bounds as wanted or as sent."""
        check_rows(self._link.robot, self._guard.narrowed, checked.commands)
        self._guard.play(envelope, checked)
        if sent is not None:
            self._guard.play(envelope, sent)

    def _send(
        self,
        targets: dict[str, float],
        owner: str,
        speeds: Mapping[str, float],
        permit: Permit,
        *,
        confirmed: bool,
    ) -> None:
        self._admission.refuse_if_locked()
        self._inverses.check(targets)
        check_speeds(targets, speeds)
        segments = self._routing.to(targets, owner, confirmed=confirmed)
        self._routing.queue(segments, permit, owner, speeds=speeds)

    def _standing(self) -> tuple[object, ...]:
        """Return the state on which the check of a path relies, while the machine rests."""
        guard, state = self._guard, self._link.worker.state
        return dict(state.command), guard.zone, guard.narrowed, dict(self._inverses.applied)

    def _target_of(self, axis: str) -> float:
        """Return the latest accepted target of an axis, or its present position."""
        pending, worker = self._link.mailbox.pending(), self._link.worker
        places = (*reversed(pending), worker.executor.ends, worker.state.command)
        return next((place[axis] for place in places if axis in place), float("nan"))
