"""The contract of input devices: found by a source, opened, and read.

A source is a plugin (``rotemina.inputs``). Readings are what the device says, neither calibrated
nor trusted: that a stick stands at its centre, which axis it is for and how far it goes is the
business of :mod:`rotemina.app.motion.teleoperation`.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError
from rotemina.sim.plugin_points import API_VERSIONS


class InputLostError(DriverError, ConnectionError):
    """The input device was unplugged, or no longer responds."""


@dataclass(frozen=True, slots=True)
class InputIdentity:
    """Which device it is: ``key`` stays the same over restarts and replugging.

    Attributes
    ----------
    key : str
        For example ``hid:046d:c215:0001``; calibrations and profiles are kept under it.
    name : str
        What its maker calls it, for screens.
    source : str
        The entry point of the source that found it.
    """

    key: str
    name: str
    source: str


@dataclass(frozen=True, slots=True)
class InputReading:
    """The latest reading of a device.

    Attributes
    ----------
    host_time_s : float
        When it came in, on the host's monotonic clock.
    axes : tuple of float
        −1 to 1 each, of the whole range that the device declares; a hat is two axes of −1, 0, 1.
        NaN: the device has not told this axis yet (one with several reports tells a few at a time);
        it is nowhere, and not to be taken for centred.
    buttons : tuple of bool
        Whether each is held.
    """

    host_time_s: float
    axes: tuple[float, ...]
    buttons: tuple[bool, ...]


class InputDevice(ABC):
    """One open input device. It is made, read and closed by one thread."""

    #: Which device this is.
    identity: InputIdentity
    #: What its axes and buttons are called, in the order of the readings.
    axes: tuple[str, ...]
    buttons: tuple[str, ...]
    #: Whether it goes on talking while nothing changes, so that a quarter of a second without a
    #: reading is a fault. Only where that is certain: one that speaks of changes alone, and is left
    #: alone, would be lost. It may turn out, or turn out wrong, while the device is open.
    streams: bool = False

    @abstractmethod
    def read(self) -> tuple[InputReading, ...]:
        """Return what came in since the last call, oldest first; never waits.

        A device that says something only when it changes returns nothing while it is left alone.

        Raises
        ------
        InputLostError
            If the device has gone; it is then to be closed.
        StateError
            If it was closed.
        """

    @abstractmethod
    def close(self) -> None:
        """Release the device; safe to call twice."""


class Rumbler(InputDevice, ABC):
    """An input device that can shake in the hand."""

    @abstractmethod
    def rumble(self, strength: float) -> None:
        """Rumble with a strength of 0 (off) to 1 until changed; never waits."""


class InputSource(ABC):
    """Finds input devices of one kind; what an entry point of ``rotemina.inputs`` names.

    Parameters
    ----------
    clock : callable
        The host's time, s: what readings are stamped with. An entry point's class is made with
        this alone.
    """

    #: The version of this interface that the class was written for.
    api_version: ClassVar[int] = API_VERSIONS["rotemina.inputs"]
    #: How screens call this kind of device.
    name: ClassVar[str] = "input"

    def __init__(self, *, clock: Clock = time.monotonic) -> None:
        self.clock = clock

    @property
    def problem(self) -> str | None:
        """Why it can find nothing at the moment, in words for the operator; None if it can."""
        return None

    @abstractmethod
    def devices(self) -> Sequence[InputIdentity]:
        """Return what is plugged in now; asked about once a second, never raises for none."""

    @abstractmethod
    def open(self, identity: InputIdentity) -> InputDevice:
        """Open one of :meth:`devices`.

        Raises
        ------
        InputLostError
            If it is there no more.
        DriverError
            If it cannot be opened: permission, used by another program, an unreadable descriptor.
        """
