"""Routing of single targets: path segments that pass the guard, with one-sided approaches."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.backlash import Backlash
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.guard import Guard, PathSegment
from rotemina.app.motion.mailbox import Move
from rotemina.app.motion.ownership import PLAYBACK
from rotemina.drivers.gate import Permit
from rotemina.sim.messages import message
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

Ways = Sequence[Mapping[str, float]]


@dataclass(eq=False)
class Routing:
    """Makes moves of targets; the lock of :class:`Admission` is held in all calls."""

    _link: DeviceLink
    _admission: Admission
    _guard: Guard
    _backlash: Backlash

    def to(
        self, targets: Mapping[str, float], owner: str, *, confirmed: bool
    ) -> tuple[PathSegment, ...]:
        """Return how targets are gone to from where the axes are, or may be, now.

        Raises
        ------
        OutOfLimitsError
            As :meth:`Guard.move`.
        """
        envelope = self._admission.envelope()
        if confirmed or owner == PLAYBACK or not self._backlash.applied:
            return self._guard.move(envelope, targets, confirmed=confirmed)
        if self._link.worker.at_rest:
            return self.along([targets])
        return self._guard.move(envelope, {**self._unfinished(), **targets})

    def along(self, ways: Ways) -> tuple[PathSegment, ...]:
        """Return the path through positions, one after the other, from where the machine rests.

        Raises
        ------
        OutOfLimitsError
            As :meth:`Guard.move`, also on what an approach adds.
        """
        envelope, reached = self._admission.envelope(), dict(self._link.worker.state.command)
        segments: list[PathSegment] = []
        for targets in self._backlash.ways(ways):
            try:
                segments += self._guard.move(envelope, targets)
            except OutOfLimitsError as error:
                if any(dict(targets) == dict(way) for way in ways):
                    raise
                raise OutOfLimitsError(
                    message(
                        "engine",
                        "{error}; the one-sided approach begins there: choose the other "
                        "side, or switch it off",
                    ).fill(error=str(error))
                ) from error
            reached |= targets
            envelope = self._guard.envelope(envelope.deviation, reached)
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
        """Queue a move, no faster than ``speeds``; one that ``returns`` leads not back itself.

        Raises
        ------
        RefusedError
            As :meth:`Admission.queue`.
        """
        move = Move(tuple(segment.no_faster(speeds or {}) for segment in segments))
        rests = self._link.worker.at_rest
        queue = self._admission.queue if returns else self._admission.queue_move
        queue(move, permit, move.targets, owner)
        if rests and owner != PLAYBACK:
            came = {axis: at for axis, at in move.targets.items() if axis in self._backlash.applied}
            self._admission.note_approached(came, ())

    def _unfinished(self) -> dict[str, float]:
        """Return where axes are still to come to that have gone beyond it, to come from one side.

        Whoever sends another axis meanwhile takes them along: the rest of their move ends with it.
        """
        executor = self._link.worker.executor
        ends = dict(executor.ends) if executor.between_segments else {}
        for each in self._link.mailbox.pending():
            ends |= each
        return {axis: at for axis, at in ends.items() if axis in self._backlash.applied}
