"""Reservation of axes, also at rest, and taking over of axes."""

from collections.abc import Sequence

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.device_link import DeviceLink


class Reservations:
    """Who has every axis for himself; a stop is always possible."""

    def __init__(self, link: DeviceLink, admission: Admission) -> None:
        self._link = link
        self._admission = admission

    def reserve(self, owner: str) -> None:
        """Keep every axis for an owner, at rest too, until it sets them free.

        Nobody else moves the machine meanwhile, unless by taking over. Who has reserved every axis
        may thrust through the slow zone
        (:meth:`~rotemina.app.motion.profile_execution.Profiles.upload`).

        Raises
        ------
        RefusedError
            If motion is locked, the machine moves, or an axis is another owner's.
        """
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("reserving the axes")
            self._link.worker.ownership.reserve(self._link.driver.axes, owner)

    def check(self, owner: str) -> None:
        """Refuse what :meth:`reserve` would refuse now, and reserve nothing.

        Raises
        ------
        RefusedError
            As :meth:`reserve`.
        """
        self._admission.refuse_unless_at_rest("reserving the axes")
        self._link.worker.ownership.check(self._link.driver.axes, owner)

    def held_by(self, owner: str) -> bool:
        """Return whether every axis is reserved for an owner: nobody has taken one over."""
        return self._link.worker.ownership.has_reserved(self._link.driver.axes, owner)

    def set_free(self, owner: str) -> None:
        """End an owner's reservations."""
        self._link.worker.ownership.set_free(owner)

    def take_over(self, axes: Sequence[str], owner: str) -> None:
        """Give axes that another owner drives to an owner; they continue until commanded."""
        self._link.worker.ownership.take_over(axes, owner)
