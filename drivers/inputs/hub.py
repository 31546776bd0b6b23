"""The input devices of all sources: finds added and removed devices, and opens them by key."""

import logging
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from threading import Lock
from types import MappingProxyType
from typing import Self

from rotemina.drivers.contract import Clock, DriverError, InputLostError, make_sources
from rotemina.drivers.inputs.device import InputDevice, InputIdentity, InputSource
from rotemina.sim.errors import describe_exception
from rotemina.sim.messages import marked

_LOG = logging.getLogger(__name__)

INPUT_GROUP = "rotemina.inputs"

# A new device that cannot be opened is reported again, because the system may grant the permission
# a moment later.
_MAX_OPEN_TRIES = 4


@dataclass(frozen=True, slots=True)
class InputChanges:
    """Changes since the previous poll.

    Attributes
    ----------
    added, removed : tuple of InputIdentity
        An open device that was unplugged and plugged in again between two polls counts as added. A
        device that could not be opened is reported as added a few times, because it may be ready a
        moment later.
    """

    added: tuple[InputIdentity, ...] = ()
    removed: tuple[InputIdentity, ...] = ()


class InputHub:
    """Access to the devices of all sources.

    The hub has no thread; the program calls :meth:`poll` about once per second. A poll may take a
    few milliseconds, and may run on another thread than opening, reading and closing devices.

    Parameters
    ----------
    sources : mapping of str to InputSource
        By the name of the entry point, or by a name that the program chooses.
    broken : mapping of str to str
        Why a source could not be loaded, by its name.
    """

    def __init__(
        self,
        sources: Mapping[str, InputSource],
        broken: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self._sources = dict(sources)
        self._broken = dict(broken)
        # Protects the attributes below; never held while a source is called.
        self._lock = Lock()
        self._available: dict[str, tuple[InputIdentity, InputSource]] = {}
        self._lost_keys: set[str] = set()
        self._source_problems: dict[str, str] = {}
        self._device_problems: dict[str, str] = {}
        # How often a device could not be opened, by key.
        self._failure_counts: Counter[str] = Counter()

    @classmethod
    def from_plugins(
        cls,
        program_sources: Mapping[str, InputSource] = MappingProxyType({}),
        *,
        clock: Clock = time.monotonic,
    ) -> Self:
        """Create a hub of all installed sources and the program's own sources."""
        return cls(*make_sources(INPUT_GROUP, InputSource, program_sources, clock=clock))

    @property
    def devices(self) -> tuple[InputIdentity, ...]:
        """The devices that were plugged in at the latest poll."""
        with self._lock:
            return tuple(identity for identity, _ in self._available.values())

    @property
    def problems(self) -> Mapping[str, str]:
        """Problems by the name of the source or the key of the device."""
        with self._lock:
            return MappingProxyType(
                {**self._broken, **self._source_problems, **self._device_problems}
            )

    def poll(self) -> InputChanges:
        """Search for devices and return the changes; a source that fails becomes a problem."""
        available: dict[str, tuple[InputIdentity, InputSource]] = {}
        problems: dict[str, str] = {}
        for name, source in self._sources.items():
            try:
                identities = [_check_identity(identity) for identity in source.devices()]
                problem = source.problem
            # A plugin may raise any exception; the devices of other sources must still be found.
            except Exception as error:
                problems[name] = f"it cannot search for devices: {type(error).__name__}: {error}"
                continue
            if problem is not None:
                problems[name] = problem
            for identity in identities:
                _, owner = available.setdefault(identity.key, (identity, source))
                if owner is not source:
                    problems[name] = f"{identity.key}: another source already has this device"
        return self._update_devices(available, problems)

    def open(self, key: str) -> InputDevice:
        """Open a device that is plugged in.

        Raises
        ------
        InputLostError
            If there is no device with this key.
        DriverError
            If it cannot be opened. :attr:`problems` gives the reason until the device is opened or
            removed.
        """
        with self._lock:
            entry = self._available.get(key)
            available_keys = ", ".join(self._available) or marked("engine", "none")
        if entry is None:
            raise InputLostError(
                "input device {key} is not plugged in; available: {keys}",
                key=repr(key),
                keys=available_keys,
            )
        identity, source = entry
        try:
            device = source.open(identity)
        except DriverError as error:
            self._record_problem(key, str(error))
            raise
        # A plugin may raise any exception.
        except Exception as error:
            self._record_problem(key, f"{type(error).__name__}: {error}")
            raise DriverError(
                "{name} ({key}) cannot be opened: {type_name}: {error}",
                name=identity.name,
                key=key,
                type_name=type(error).__name__,
                error=describe_exception(error),
            ) from error
        with self._lock:
            self._clear_problem(key)
        return device

    def note_loss(self, key: str) -> None:
        """Register that an open device raised :class:`InputLostError`.

        The next poll reports the device as removed, or as added if it is already back.
        """
        with self._lock:
            self._lost_keys.add(key)

    def _update_devices(
        self, available: dict[str, tuple[InputIdentity, InputSource]], problems: dict[str, str]
    ) -> InputChanges:
        with self._lock:
            previous, self._available = self._available, available
            for name, problem in problems.items():
                if self._source_problems.get(name) != problem:
                    _LOG.warning("input devices of %s: %s", name, problem)
            self._source_problems = problems
            retry_keys = {
                key for key, count in self._failure_counts.items() if count < _MAX_OPEN_TRIES
            }
            returned_keys = available.keys() & (self._lost_keys | retry_keys)
            added_keys = (available.keys() - previous.keys()) | returned_keys
            self._lost_keys.clear()
            added = tuple(identity for key, (identity, _) in available.items() if key in added_keys)
            removed = tuple(
                identity for key, (identity, _) in previous.items() if key not in available
            )
            for identity in removed:
                self._clear_problem(identity.key)
        return InputChanges(added, removed)

    def _record_problem(self, key: str, problem: str) -> None:
        with self._lock:
            self._device_problems[key] = problem
            self._failure_counts[key] += 1

    def _clear_problem(self, key: str) -> None:
        self._device_problems.pop(key, None)
        self._failure_counts.pop(key, None)


def _check_identity(identity: object) -> InputIdentity:
    if not isinstance(identity, InputIdentity):
        raise TypeError(f"{identity!r} is no InputIdentity")
    return identity
