"""Checks of each motion request on the caller's thread, before it is queued."""

import threading
from collections.abc import Container, Iterable, Mapping
from types import MappingProxyType

from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.guard import Guard
from rotemina.app.motion.mailbox import Command, RefusedError, refuse_overtaken
from rotemina.app.motion.position_envelope import PositionEnvelope
from rotemina.app.motion.undo import Undo
from rotemina.drivers.gate import Permit
from rotemina.drivers.samples import DeviceState
from rotemina.sim.messages import message


class Admission:
    """Checks requests, and queues them with their permit and owner.

    ``way_back`` is where the machine rested before each move.
    """

    def __init__(self, link: DeviceLink, guard: Guard, way_back: Undo) -> None:
        self._link = link
        self._guard = guard
        self.way_back = way_back
        #: Held while a request is checked and queued; never while the driver is called.
        self.lock = threading.Lock()
        #: Where axes were sent last by way of a one-sided approach; replaced as a whole.
        self.approached: Mapping[str, float] = MappingProxyType({})

    def drawn(self, permit: Permit | None) -> Permit:
        """Return the permit of a plan, which still holds, or one of now.

        Raises
        ------
        RefusedError
            If a stop has come since the plan began.
        """
        if permit is None:
            return self._link.gate.permit()
        if not permit.valid:
            refuse_overtaken(permit)
        return permit

    def refuse_if_locked(self) -> None:
        """Refuse motion while it is locked.

        Raises
        ------
        RefusedError
            With what locks it.
        """
        state = self._link.snapshot()
        if state.locked is not None:
            raise RefusedError(
                message("engine", "motion is locked: {locked}").fill(locked=state.locked)
            )
        if state.activity is DeviceState.HOMING:
            raise RefusedError(
                message(
                    "engine",
                    "the machine is searching for its limit switches; wait, or stop it first",
                )
            )
        if state.activity is DeviceState.PLAYING or self._link.mailbox.holds_play():
            raise RefusedError(
                message("engine", "a trajectory is playing and owns every axis; stop it first")
            )

    def refuse_unless_at_rest(self, before: str) -> None:
        """Refuse a request that needs a machine at rest and free to move.

        Raises
        ------
        RefusedError
            As :meth:`refuse_if_locked`, or if it moves.
        """
        self.refuse_if_locked()
        if not self._link.worker.at_rest:
            raise RefusedError(
                message(
                    "engine", "the machine is still moving; stop it or wait before {what}"
                ).fill(what=before)
            )

    def envelope(self, driven: Container[str] = ()) -> PositionEnvelope:
        """Return the possible positions of the axes, by their latest commands and readings.

        The axes ``driven`` get a new speed: their earlier lease does not count.
        """
        worker, mailbox = self._link.worker, self._link.mailbox
        command = worker.state.command
        ends = [command, worker.executor.targets, *mailbox.pending()]
        given = [
            *worker.executor.drives.items(),
            *((a, d) for d in mailbox.drives() for a in d.ways),
        ]
        for axis, drive in given:
            way = (drive.braking if axis in driven else drive.ways).get(axis, 0.0)
            if axis in command:
                ends.append({axis: command[axis] + way})
        return self._guard.envelope(worker.deviation.now, *ends)

    def queue(self, command: Command, permit: Permit, axes: Iterable[str], owner: str) -> None:
        """Make axes an owner's and queue what moves them, or neither.

        Raises
        ------
        RefusedError
            If an axis is another owner's, the permit passes no more, or the queue is full.
        """
        driven = tuple(axes)
        with self._link.worker.ownership.claimed(driven, owner):
            self._link.mailbox.post(command, permit.owned(driven, owner))
        self._link.note_accepted(permit.epoch)
        self.note_approached({}, driven)

    def queue_move(self, command: Command, permit: Permit, axes: Iterable[str], owner: str) -> None:
        """Queue as :meth:`queue` does, and keep where the machine rests, to come back to."""
        worker = self._link.worker
        if worker.state.activity is DeviceState.IDLE and not len(self._link.mailbox):
            self.way_back.note(worker.state.command)
        self.queue(command, permit, axes, owner)

    def note_approached(self, targets: Mapping[str, float], axes: Iterable[str]) -> None:
        """Note the approached targets of axes; ``axes`` without a target have none."""
        kept = {axis: at for axis, at in self.approached.items() if axis not in set(axes)}
        self.approached = MappingProxyType({**kept, **targets})
