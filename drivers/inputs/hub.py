"""All available input devices: arrivals, removals, and opening by key."""

import logging
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from threading import Lock
from types import MappingProxyType
from typing import Self

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError
from rotemina.drivers.inputs.device import (
    InputDevice,
    InputIdentity,
    InputLostError,
    InputSource,
)
from rotemina.drivers.registry import make_sources
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import marked, message

_LOG = logging.getLogger(__name__)

INPUTS = "rotemina.inputs"

# The system gives permissions a moment after a device has appeared.
_MOST_TRIES = 4


@dataclass(frozen=True, slots=True)
class Changes:
    """What has changed since the poll before.

    Attributes
    ----------
    arrived, left : tuple of InputIdentity
        One that was unplugged and came back between two polls has arrived, if it was open. One that
        could not be opened is told a few times: it may be ready a moment later.
    """

    arrived: tuple[InputIdentity, ...] = ()
    left: tuple[InputIdentity, ...] = ()


class InputHub:
    """Finds the devices of all sources.

    It has no thread: :meth:`poll` is called about once a second. That may take some ms and be done
    by another thread than the one that opens, reads and closes devices.

    Parameters
    ----------
    sources : mapping of str to InputSource
        By the name of their entry point, or one that the program gives.
    broken : mapping of str to str
        Sources that could not be loaded, and why.
    """

    def __init__(
        self,
        sources: Mapping[str, InputSource],
        broken: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self._sources = dict(sources)
        self._broken = dict(broken)
        # Guards what follows; never held while a source is called.
        self._lock = Lock()
        self._there: dict[str, tuple[InputIdentity, InputSource]] = {}
        self._lost: set[str] = set()
        self._source_problems: dict[str, str] = {}
        self._device_problems: dict[str, str] = {}
        self._failed: Counter[str] = Counter()  # how often each could not be opened

    @classmethod
    def installed(
        cls,
        own: Mapping[str, InputSource] = MappingProxyType({}),
        *,
        clock: Clock = time.monotonic,
    ) -> Self:
        """Return a hub of all installed sources and those that the program makes itself."""
        return cls(*make_sources(INPUTS, InputSource, own, clock=clock))

    @property
    def devices(self) -> tuple[InputIdentity, ...]:
        """What was plugged in at the latest poll."""
        with self._lock:
            return tuple(identity for identity, _ in self._there.values())

    @property
    def problems(self) -> Mapping[str, str]:
        """Problems by source name or device key."""
        with self._lock:
            return MappingProxyType(
                {**self._broken, **self._source_problems, **self._device_problems}
            )

    def poll(self) -> Changes:
        """Look what is plugged in; return what has changed. A bad source is named and left out."""
        there: dict[str, tuple[InputIdentity, InputSource]] = {}
        problems: dict[str, str] = {}
        for name, source in self._sources.items():
            try:
                found = [_checked(identity) for identity in source.devices()]
                problem = source.problem
            except Exception as error:  # a plugin may raise anything; the others are to be found
                problems[name] = f"it cannot look for devices: {type(error).__name__}: {error}"
                continue
            if problem is not None:
                problems[name] = problem
            for identity in found:
                other = there.setdefault(identity.key, (identity, source))[1]
                if other is not source:
                    problems[name] = f"{identity.key}: another source already has this device"
        return self._exchange(there, problems)

    def open(self, key: str) -> InputDevice:
        """Open a device that is plugged in.

        Raises
        ------
        InputLostError
            If there is none of this key.
        DriverError
            If it cannot be opened; :attr:`problems` keeps the reason until it can, or has left.
        """
        with self._lock:
            found = self._there.get(key)
            keys = ", ".join(self._there) or marked("engine", "none")
        if found is None:
            raise InputLostError(
                message("engine", "input device {key} is not plugged in; available: {keys}").fill(
                    key=repr(key), keys=keys
                )
            )
        identity, source = found
        try:
            device = source.open(identity)
        except DriverError as error:
            self._note(key, str(error))
            raise
        except Exception as error:  # a plugin may raise anything
            self._note(key, f"{type(error).__name__}: {error}")
            raise DriverError(
                message("engine", "{name} ({key}) cannot be opened: {type_name}: {error}").fill(
                    name=identity.name,
                    key=key,
                    type_name=type(error).__name__,
                    error=reason_of(error),
                )
            ) from error
        with self._lock:
            self._clear(key)
        return device

    def lost(self, key: str) -> None:
        """Note that an open device raised :class:`InputLostError`.

        The next poll tells that it has left, or, where it is back already, that it has arrived.
        """
        with self._lock:
            self._lost.add(key)

    def _exchange(
        self, there: dict[str, tuple[InputIdentity, InputSource]], problems: dict[str, str]
    ) -> Changes:
        with self._lock:
            before, self._there = self._there, there
            for name, problem in problems.items():
                if self._source_problems.get(name) != problem:
                    _LOG.warning("input devices of %s: %s", name, problem)
            self._source_problems = problems
            again = {key for key, count in self._failed.items() if count < _MOST_TRIES}
            new = (there.keys() - before.keys()) | (there.keys() & (self._lost | again))
            self._lost.clear()
            arrived = tuple(one for key, (one, _) in there.items() if key in new)
            left = tuple(one for key, (one, _) in before.items() if key not in there)
            for one in left:
                self._clear(one.key)
        return Changes(arrived, left)

    def _note(self, key: str, problem: str) -> None:
        with self._lock:
            self._device_problems[key] = problem
            self._failed[key] += 1

    def _clear(self, key: str) -> None:
        self._device_problems.pop(key, None)
        self._failed.pop(key, None)


def _checked(identity: object) -> InputIdentity:
    if not isinstance(identity, InputIdentity):
        raise TypeError(f"{identity!r} is no InputIdentity")
    return identity
