"""Owners of axes: each axis has one at a time, which is visible and changes only on purpose."""

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType

from rotemina.app.errors import RequestRefusedError
from rotemina.sim.messages import AxisName

# Default owner, for example of requests of the window.
OPERATOR = "operator"
PLAYBACK = "playback"
HOMING = "homing"


class AxisOwnership:
    """Owners of axes, by name; every method may be called from any thread.

    An axis at rest is free. A request that moves it makes its sender the owner until the machine
    is at rest again. A *reserved* axis stays with its owner at rest too, until the reservation
    ends or another owner takes the axis over.
    """

    def __init__(self) -> None:
        # Replaced as a whole, because the gate reads it without the lock, which a claim may hold
        # for long.
        self._owners: dict[str, str] = {}
        self._reserved: dict[str, str] = {}
        self._lock = threading.RLock()

    @property
    def owners(self) -> Mapping[str, str]:
        """The owner of each axis that has one."""
        with self._lock:
            return MappingProxyType(dict(self._owners))

    def find_other_owner(self, owner: str, axes: Iterable[str]) -> str | None:
        """Return another owner of one of these axes, or None. Takes no lock."""
        owners = self._owners
        return next((owners[axis] for axis in axes if owners.get(axis, owner) != owner), None)

    @contextmanager
    def claim(self, axes: Iterable[str], owner: str) -> Iterator[None]:
        """Make ``owner`` the owner of all these axes; the body of the context queues the motion.

        No axis is freed while the body runs. If the body raises, the previous owners remain.

        Raises
        ------
        RequestRefusedError
            If an axis has another owner. The message names the owner and says what to do.
        """
        names = tuple(axes)
        with self._lock:
            self.check_free(names, owner)
            previous = self._owners
            self._owners = {**self._owners, **dict.fromkeys(names, owner)}
            try:
                yield
            except BaseException:
                self._owners = previous
                raise

    def check_free(self, axes: Iterable[str], owner: str) -> None:
        """Refuse axes if any of them has another owner, without claiming them.

        Raises
        ------
        RequestRefusedError
            See :meth:`claim`.
        """
        with self._lock:
            for axis in axes:
                other_owner = self._owners.get(axis, owner)
                if other_owner != owner:
                    raise RequestRefusedError(
                        "{other} controls axis {axis}; stop it, or take over first",
                        axis=AxisName(axis),
                        other=other_owner,
                    )

    def take_over(self, axes: Iterable[str], owner: str) -> None:
        """Give axes to an owner, regardless of the previous one."""
        names = tuple(axes)
        with self._lock:
            self._owners = {**self._owners, **dict.fromkeys(names, owner)}
            for axis in names:
                if self._reserved.get(axis, owner) != owner:
                    del self._reserved[axis]

    def reserve(self, axes: Iterable[str], owner: str) -> None:
        """Reserve axes for an owner, who then keeps them while they rest.

        Raises
        ------
        RequestRefusedError
            See :meth:`claim`.
        """
        names = tuple(axes)
        with self.claim(names, owner):
            self._reserved.update(dict.fromkeys(names, owner))

    def has_reserved(self, axes: Iterable[str], owner: str) -> bool:
        """Return whether all these axes are reserved for an owner."""
        with self._lock:
            return all(self._reserved.get(axis) == owner for axis in axes)

    def end_reservations(self, owner: str) -> None:
        """End an owner's reservations; the owner keeps moving axes until the machine rests."""
        with self._lock:
            self._reserved = {axis: name for axis, name in self._reserved.items() if name != owner}

    def free_axes(self, has_waiting_request: Callable[[], bool] = lambda: False) -> None:
        """Free every axis that is not reserved, unless a request is waiting.

        Called when the machine rests.
        """
        with self._lock:
            if not has_waiting_request():
                self._owners = dict(self._reserved)
