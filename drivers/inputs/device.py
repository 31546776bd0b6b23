"""The contract of input devices: a source finds a device, which is then opened and read.

A source is a plugin (``rotemina.inputs``). Readings are not calibrated or checked here:
:mod:`rotemina.app.motion.teleoperation` knows the centre and the range of a stick, and the axis
that it moves.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, ClassVar, Protocol, Self

from rotemina.drivers.contract import Clock
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.plugin_points import API_VERSIONS

#: Period at which a device that always knows its state reports an unchanged state again, s.
KEEPALIVE_PERIOD_S = 0.1


@dataclass(frozen=True, slots=True)
class InputIdentity:
    """Identity of a device. The ``key`` stays the same when the device is restarted or replugged.

    Attributes
    ----------
    key : str
        For example ``hid:046d:c215:0001``. Calibrations and profiles are stored under this key.
    name : str
        The manufacturer's name of the device, for display.
    source : str
        Name of the source's entry point.
    """

    key: str
    name: str
    source: str


class ControlNames(Protocol):
    """Names of axes and buttons, in the order of the readings."""

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the axes."""

    @property
    def buttons(self) -> tuple[str, ...]:
        """Names of the buttons."""


@dataclass(frozen=True, slots=True)
class InputReading:
    """One reading of a device.

    Attributes
    ----------
    host_time_s : float
        Time of arrival on the host's monotonic clock.
    axes : tuple of float
        −1 to 1 each, over the whole range that the device declares. A hat is two axes with the
        values −1, 0, 1. NaN means that the device has not reported the axis yet, because a device
        with several reports sends only some axes at a time. Such an axis must not be taken as
        centred.
    buttons : tuple of bool
        Whether each button is held.
    fault : str or None
        Why the received data could not be decoded; None if they could. With a fault the device
        counts as released: every axis is NaN, and no button is held.
    """

    host_time_s: float
    axes: tuple[float, ...]
    buttons: tuple[bool, ...]
    fault: str | None = None

    @classmethod
    def make_unusable(cls, host_time_s: float, device: "ControlNames", fault: str) -> Self:
        """Return a reading for data that could not be decoded."""
        return cls(host_time_s, (nan,) * len(device.axes), (False,) * len(device.buttons), fault)

    # Former names, which work for one more release.
    unusable = FormerMember("make_unusable")


class InputDevice(ABC):
    """An open input device. One thread creates, reads and closes it."""

    identity: InputIdentity
    #: Names of the axes and buttons, in the order of the readings.
    axes: tuple[str, ...]
    buttons: tuple[str, ...]
    #: Whether the device is certain to keep reporting while nothing changes, so that a quarter of a
    #: second without a reading is a fault even at rest. If False, the program detects whether the
    #: device keeps reporting. In both cases a silent device soon stops moving anything.
    streams: bool = False

    @abstractmethod
    def read(self) -> tuple[InputReading, ...]:
        """Return the readings since the last call, oldest first; never waits.

        A device that reports only changes returns nothing while it is not touched. Never repeat an
        old reading if the device may be gone: silence ends a motion, but a repeated reading counts
        as a new one. For a report that cannot be decoded, return :meth:`InputReading.make_unusable`
        instead of omitting the report.

        Raises
        ------
        InputLostError
            If the device is gone. The caller must then close it.
        StateError
            If the device was closed.
        """

    @abstractmethod
    def close(self) -> None:
        """Release the device; safe to call twice."""


class RumbleDevice(InputDevice, ABC):
    """An input device with a rumble motor."""

    @abstractmethod
    def rumble(self, strength: float) -> None:
        """Rumble with a strength from 0 (off) to 1 until the next call; never waits."""


class InputSource(ABC):
    """Base class of sources, which find input devices of one kind.

    The entry points of ``rotemina.inputs`` are subclasses.

    Parameters
    ----------
    clock : callable
        Returns the host's time, s, for the time stamps of readings. The class of an entry point is
        called with only this argument.
    """

    #: The version of this interface for which the class was written.
    api_version: ClassVar[int] = API_VERSIONS["rotemina.inputs"]
    #: Name of this kind of device for display.
    name: ClassVar[str] = "input"

    def __init__(self, *, clock: Clock = time.monotonic) -> None:
        self.clock = clock

    @property
    def problem(self) -> str | None:
        """A message for the operator that says why no devices are found; None if there is none."""
        return None

    @abstractmethod
    def devices(self) -> Sequence[InputIdentity]:
        """Return the devices that are plugged in, if any; called about once per second."""

    @abstractmethod
    def open(self, identity: InputIdentity) -> InputDevice:
        """Open a device that :meth:`devices` has returned.

        Raises
        ------
        InputLostError
            If it is no longer plugged in.
        DriverError
            If it cannot be opened, for example for lack of permission, because another program
            uses it, or because its descriptor is unreadable.
        """


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        CONFIRM_S="KEEPALIVE_PERIOD_S",
        HasControls="ControlNames",
        InputLostError="rotemina.drivers.contract.errors.InputLostError",
        Rumbler="RumbleDevice",
    )
