"""Routing of moves: path segments to targets, with one-sided approaches, checked by the guard."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rotemina.app.motion.device import PLAYBACK, DeviceLink, MoveCommand
from rotemina.app.motion.limits import Guard, PathSegment
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.app.motion.session.backlash import BacklashCompensation
from rotemina.drivers.contract import Permit
from rotemina.sim.errors import OutOfLimitsError

Waypoints = Sequence[Mapping[str, float]]


@dataclass(eq=False)
class MoveRouting:
    """Plans and queues moves; the caller holds the lock of :class:`RequestAdmission`."""

    _link: DeviceLink
    _admission: RequestAdmission
    _guard: Guard
    _backlash: BacklashCompensation

    def plan_to(
        self, targets: Mapping[str, float], owner: str, *, confirmed: bool
    ) -> tuple[PathSegment, ...]:
        """Return the path segments to targets from all positions where the axes may be now.

        Raises
        ------
        OutOfLimitsError
            See :meth:`Guard.plan_move`.
        """
        envelope = self._admission.compute_envelope()
        if confirmed or owner == PLAYBACK or not self._backlash.applied:
            return self._guard.plan_move(envelope, targets, confirmed=confirmed)
        if self._link.worker.at_rest:
            return self.plan_along([targets])
        return self._guard.plan_move(envelope, {**self._find_unfinished_targets(), **targets})

    def plan_along(self, waypoints: Waypoints) -> tuple[PathSegment, ...]:
        """Return the path from the position at rest through waypoints, in their order.

        Raises
        ------
        OutOfLimitsError
            See :meth:`Guard.plan_move`. This also applies to the detours of one-sided approaches.
        """
        envelope, positions = (
            self._admission.compute_envelope(),
            dict(self._link.worker.state.command),
        )
        segments: list[PathSegment] = []
        for targets in self._backlash.add_approaches(waypoints):
            try:
                segments += self._guard.plan_move(envelope, targets)
            except OutOfLimitsError as error:
                if any(dict(targets) == dict(waypoint) for waypoint in waypoints):
                    raise
                raise OutOfLimitsError(
                    "{error}; the one-sided approach begins there: choose the other "
                    "side, or switch it off",
                    error=str(error),
                ) from error
            # The next segment begins where this one ends.
            positions |= targets
            envelope = self._guard.compute_envelope(envelope.deviation, positions)
        return tuple(segments)

    def queue(
        self,
        segments: Sequence[PathSegment],
        permit: Permit,
        owner: str,
        *,
        speeds: Mapping[str, float] | None = None,
        returns: bool = False,
    ) -> None:
        """Queue a move, no faster than ``speeds``.

        ``returns`` marks a move that itself undoes another one, so it is not added to the undo
        history.

        Raises
        ------
        RequestRefusedError
            See :meth:`RequestAdmission.queue`.
        """
        move = MoveCommand(tuple(segment.with_speed_limits(speeds or {}) for segment in segments))
        is_at_rest = self._link.worker.at_rest
        queue = self._admission.queue if returns else self._admission.queue_move
        queue(move, permit, move.targets, owner)
        if is_at_rest and owner != PLAYBACK:
            approached_targets = {
                axis: target
                for axis, target in move.targets.items()
                if axis in self._backlash.applied
            }
            self._admission.note_approached_targets(approached_targets, ())

    def _find_unfinished_targets(self) -> dict[str, float]:
        """Return the final targets of axes that are still in a one-sided approach.

        A new target for another axis would cut off the rest of their move. Therefore the new move
        also brings them to these targets.
        """
        executor = self._link.worker.executor
        final_targets = dict(executor.ends) if executor.between_segments else {}
        for targets in self._link.mailbox.list_pending_targets():
            final_targets |= targets
        return {
            axis: target for axis, target in final_targets.items() if axis in self._backlash.applied
        }
