"""Who drives an axis now: one owner each, told to the operator, taken over only on purpose."""

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType

from rotemina.app.motion.mailbox import RefusedError

OPERATOR = "operator"  # whoever does not say who it is: the pad of the window
PLAYBACK = "playback"
HOMING = "homing"


class Ownership:
    """Owners of axes, by name; every method may be called from any thread.

    An axis at rest is free: whoever moves it owns it until the machine is at rest again.
    """

    def __init__(self) -> None:
        self._owners: dict[str, str] = {}
        self._lock = threading.RLock()

    @property
    def owners(self) -> Mapping[str, str]:
        """The owner of each axis that has one."""
        with self._lock:
            return MappingProxyType(dict(self._owners))

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
            for axis in wanted:
                other = self._owners.get(axis, owner)
                if other != owner:
                    raise RefusedError(
                        f"axis {axis} is driven by {other}; stop it, or take over first"
                    )
            before = dict(self._owners)
            self._owners.update(dict.fromkeys(wanted, owner))
            try:
                yield
            except BaseException:
                self._owners = before
                raise

    def take_over(self, axes: Iterable[str], owner: str) -> None:
        """Make axes an owner's, whoever had them."""
        with self._lock:
            self._owners.update(dict.fromkeys(axes, owner))

    def release(self, waits: Callable[[], bool] = lambda: False) -> None:
        """Free every axis: the machine is at rest, unless somebody's request still waits."""
        with self._lock:
            if not waits():
                self._owners.clear()
