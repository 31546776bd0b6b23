"""The owner of each axis: one at a time, visible, and changed only deliberately."""

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType

from rotemina.app.motion.mailbox import RefusedError
from rotemina.sim.messages import AxisName, message

OPERATOR = "operator"  # whoever does not say who it is: the pad of the window
PLAYBACK = "playback"
HOMING = "homing"


class Ownership:
    """Owners of axes, by name; every method may be called from any thread.

    An axis at rest is free: whoever moves it owns it until the machine is at rest again. Only an
    axis that is *reserved* stays its owner's at rest too, until it is set free or taken over.
    """

    def __init__(self) -> None:
        # Replaced as a whole: the gate looks without the lock, which a claim holds for longer.
        self._owners: dict[str, str] = {}
        self._reserved: dict[str, str] = {}
        self._lock = threading.RLock()

    @property
    def owners(self) -> Mapping[str, str]:
        """The owner of each axis that has one."""
        with self._lock:
            return MappingProxyType(dict(self._owners))

    def other_than(self, owner: str, axes: Iterable[str]) -> str | None:
        """Return who else drives one of these axes now; any thread, without a lock."""
        owners = self._owners
        return next((owners[a] for a in axes if owners.get(a, owner) != owner), None)

    @contextmanager
    def claimed(self, axes: Iterable[str], owner: str) -> Iterator[None]:
        """Make axes an owner's, or none; nothing is released while the body asks for motion.

        If that is refused, the owners are as before.

        Raises
        ------
        RefusedError
            If one of them is another's: who that is, and what to do.
        """
        wanted = tuple(axes)
        with self._lock:
            self.check(wanted, owner)
            before = self._owners
            self._owners = {**self._owners, **dict.fromkeys(wanted, owner)}
            try:
                yield
            except BaseException:
                self._owners = before
                raise

    def check(self, axes: Iterable[str], owner: str) -> None:
        """Refuse axes if any has another owner; change nothing.

        Raises
        ------
        RefusedError
            As :meth:`claimed`.
        """
        with self._lock:
            for axis in axes:
                other = self._owners.get(axis, owner)
                if other != owner:
                    raise RefusedError(
                        message(
                            "engine",
                            "{other} controls axis {axis}; stop it, or take over first",
                        ).fill(axis=AxisName(axis), other=other)
                    )

    def take_over(self, axes: Iterable[str], owner: str) -> None:
        """Give axes to an owner, regardless of the previous one."""
        wanted = tuple(axes)
        with self._lock:
            self._owners = {**self._owners, **dict.fromkeys(wanted, owner)}
            for axis in wanted:
                if self._reserved.get(axis, owner) != owner:
                    del self._reserved[axis]

    def reserve(self, axes: Iterable[str], owner: str) -> None:
        """Make axes an owner's, also while they rest.

        Raises
        ------
        RefusedError
            As :meth:`claimed`.
        """
        wanted = tuple(axes)
        with self.claimed(wanted, owner):
            self._reserved.update(dict.fromkeys(wanted, owner))

    def has_reserved(self, axes: Iterable[str], owner: str) -> bool:
        """Return whether all these axes are reserved for an owner."""
        with self._lock:
            return all(self._reserved.get(axis) == owner for axis in axes)

    def set_free(self, owner: str) -> None:
        """End an owner's reservations; what still moves is its own until the machine rests."""
        with self._lock:
            self._reserved = {a: name for a, name in self._reserved.items() if name != owner}

    def release(self, waits: Callable[[], bool] = lambda: False) -> None:
        """Free every axis that is not reserved: the machine rests, unless a request waits."""
        with self._lock:
            if not waits():
                self._owners = dict(self._reserved)
