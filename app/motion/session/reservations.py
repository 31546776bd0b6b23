"""Requests to reserve all axes, which also holds at rest, and to take over axes."""

from collections.abc import Sequence

from rotemina.app.motion.device import DeviceLink
from rotemina.app.motion.session.admission import RequestAdmission


class AxisReservations:
    """Exclusive reservation of all axes. It does not prevent a stop."""

    def __init__(self, link: DeviceLink, admission: RequestAdmission) -> None:
        self._link = link
        self._admission = admission

    def reserve(self, owner: str) -> None:
        """Reserve all axes for an owner, also at rest, until the owner ends the reservation.

        Meanwhile nobody else can move the machine without taking over axes. An owner who has
        reserved all axes may thrust through the slow zone
        (:meth:`~rotemina.app.motion.session.profile_execution.ProfileRequests.upload`).

        Raises
        ------
        RequestRefusedError
            If motion is locked, the machine is moving, or an axis has another owner.
        """
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("reserving the axes")
            self._link.worker.ownership.reserve(self._link.driver.axes, owner)

    def check(self, owner: str) -> None:
        """Make the same checks as :meth:`reserve`, but reserve nothing.

        Raises
        ------
        RequestRefusedError
            See :meth:`reserve`.
        """
        self._admission.refuse_unless_at_rest("reserving the axes")
        self._link.worker.ownership.check_free(self._link.driver.axes, owner)

    def is_reserved_by(self, owner: str) -> bool:
        """Return whether all axes are reserved for an owner, and none has been taken over."""
        return self._link.worker.ownership.has_reserved(self._link.driver.axes, owner)

    def end_reservations(self, owner: str) -> None:
        """End an owner's reservations."""
        self._link.worker.ownership.end_reservations(owner)

    def take_over(self, axes: Sequence[str], owner: str) -> None:
        """Make ``owner`` the owner of axes. They continue their motion until the next command."""
        self._link.worker.ownership.take_over(axes, owner)
