"""The contract of input devices: found by a source, opened, and read.

A source is a plugin (``rotemina.inputs``). Readings are what the device says, neither calibrated
nor trusted: that a stick stands at its centre, which axis it is for and how far it goes is the
business of :mod:`rotemina.app.motion.teleoperation`.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from math import nan
from typing import ClassVar, Protocol, Self

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError
from rotemina.sim.plugin_points import API_VERSIONS

#: How often a source that knows the state of its device at any moment confirms it, s.
CONFIRM_S = 0.1


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


class HasControls(Protocol):
    """Names of axes and buttons, in the order of the readings."""

    @property
    def axes(self) -> tuple[str, ...]:
        """What the axes are called."""

    @property
    def buttons(self) -> tuple[str, ...]:
        """What the buttons are called."""


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
    fault : str or None
        Why what came in could not be understood; None if it could. The device then counts as
        released: every axis is NaN and no button is held.
    """

    host_time_s: float
    axes: tuple[float, ...]
    buttons: tuple[bool, ...]
    fault: str | None = None

    @classmethod
    def unusable(cls, host_time_s: float, device: "HasControls", fault: str) -> Self:
        """Return the reading for something that came in and could not be understood."""
        return cls(host_time_s, (nan,) * len(device.axes), (False,) * len(device.buttons), fault)


class InputDevice(ABC):
    """One open input device. It is made, read and closed by one thread."""

    #: Which device this is.
    identity: InputIdentity
    #: What its axes and buttons are called, in the order of the readings.
    axes: tuple[str, ...]
    buttons: tuple[str, ...]
    #: Whether it goes on reporting while nothing changes, so that a quarter of a second without a
    #: reading is a fault even at rest. Only where that is certain. The program finds out by itself
    #: which devices keep reporting, and never lets a silent device move anything for long.
    streams: bool = False

    @abstractmethod
    def read(self) -> tuple[InputReading, ...]:
        """Return what came in since the last call, oldest first; never waits.

        A device that says something only when it changes returns nothing while it is left alone.
        Never repeat an old reading for a device that may be gone: silence ends a motion, and what
        is repeated counts as said anew. A report that cannot be understood is returned as
        :meth:`InputReading.unusable`, never left out.

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
