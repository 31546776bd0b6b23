"""Checks that a motion request must pass on the caller's thread before it is queued."""

import threading
from collections.abc import Container, Iterable, Mapping
from types import MappingProxyType

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import Command, DeviceLink, refuse_invalidated_permit
from rotemina.app.motion.limits import Guard, PositionEnvelope
from rotemina.app.motion.session.undo import UndoHistory
from rotemina.drivers.contract import DeviceState, Permit


class RequestAdmission:
    """Checks requests, and queues them with their permit and owner.

    ``undo_history`` holds the positions at which the machine rested before each move.
    """

    def __init__(self, link: DeviceLink, guard: Guard, undo_history: UndoHistory) -> None:
        self._link = link
        self._guard = guard
        self.undo_history = undo_history
        #: Held while a request is checked and queued, but never while the driver is called.
        self.lock = threading.Lock()
        #: Target of each axis whose latest move ended with a one-sided approach. Replaced as a
        #: whole, so any thread may read it.
        self.one_sided_targets: Mapping[str, float] = MappingProxyType({})

    def resolve_permit(self, permit: Permit | None) -> Permit:
        """Return ``permit`` if it is still valid, or a new permit if ``permit`` is None.

        Raises
        ------
        RequestRefusedError
            If a stop has invalidated the permit.
        """
        if permit is None:
            return self._link.gate.permit()
        if not permit.is_valid:
            refuse_invalidated_permit(permit)
        return permit

    def refuse_if_motion_blocked(self) -> None:
        """Refuse motion while it is locked, or while the machine homes or plays a trajectory.

        Raises
        ------
        RequestRefusedError
            If no motion is possible now. The message says why.
        """
        state = self._link.snapshot()
        if state.lock_reason is not None:
            raise RequestRefusedError("motion is locked: {locked}", locked=state.lock_reason)
        if state.activity is DeviceState.HOMING:
            raise RequestRefusedError(
                "the machine is searching for its limit switches; wait, or stop it first"
            )
        if state.activity is DeviceState.PLAYING or self._link.mailbox.has_waiting_play():
            raise RequestRefusedError("a trajectory is playing and owns every axis; stop it first")

    def refuse_unless_at_rest(self, action: str) -> None:
        """Refuse a request that needs a machine at rest and free to move.

        ``action`` names the request in the message, for example "homing".

        Raises
        ------
        RequestRefusedError
            See :meth:`refuse_if_motion_blocked`. Also if the machine is still moving.
        """
        self.refuse_if_motion_blocked()
        if not self._link.worker.at_rest:
            raise RequestRefusedError(
                "the machine is still moving; stop it or wait before {what}", what=action
            )

    def compute_envelope(self, superseded_axes: Container[str] = ()) -> PositionEnvelope:
        """Return bounds of the axis positions, from the latest commands and readings.

        A new speed command is about to replace those of ``superseded_axes``, so only their braking
        distances count.
        """
        worker, mailbox = self._link.worker, self._link.mailbox
        position = worker.state.command
        positions = [position, worker.executor.targets, *mailbox.list_pending_targets()]
        # An axis that moves at a speed may continue until its lease ends and it has braked.
        velocity_commands = [
            *worker.executor.velocity_commands.items(),
            *(
                (axis, queued)
                for queued in mailbox.list_velocity_commands()
                for axis in queued.travels
            ),
        ]
        for axis, command in velocity_commands:
            travels = command.braking_travels if axis in superseded_axes else command.travels
            if axis in position:
                positions.append({axis: position[axis] + travels.get(axis, 0.0)})
        return self._guard.compute_envelope(worker.deviation.current_deviation, *positions)

    def queue(self, command: Command, permit: Permit, axes: Iterable[str], owner: str) -> None:
        """Make ``owner`` the owner of axes and queue the command; on a refusal do neither.

        Raises
        ------
        RequestRefusedError
            If an axis has another owner, the permit is no longer valid, or the queue is full.
        """
        moved_axes = tuple(axes)
        with self._link.worker.ownership.claim(moved_axes, owner):
            self._link.mailbox.post(command, permit.with_owner(moved_axes, owner))
        self._link.record_accepted_epoch(permit.epoch)
        self.note_approached_targets({}, moved_axes)

    def queue_move(self, command: Command, permit: Permit, axes: Iterable[str], owner: str) -> None:
        """Queue as :meth:`queue` does, and remember for undo where the machine rests."""
        worker = self._link.worker
        if worker.state.activity is DeviceState.IDLE and not len(self._link.mailbox):
            self.undo_history.note(worker.state.command)
        self.queue(command, permit, axes, owner)

    def note_approached_targets(self, targets: Mapping[str, float], axes: Iterable[str]) -> None:
        """Remember the targets that axes approach from one side.

        The earlier targets of all ``axes`` are forgotten.
        """
        replaced_axes = set(axes)
        others = {
            axis: target
            for axis, target in self.one_sided_targets.items()
            if axis not in replaced_axes
        }
        self.one_sided_targets = MappingProxyType({**others, **targets})
