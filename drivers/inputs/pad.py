"""Keys and an on-screen pad: a device set by the program itself."""

import time
from collections import deque
from collections.abc import Sequence
from math import inf
from threading import Lock

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.inputs.device import (
    CONFIRM_S,
    InputDevice,
    InputIdentity,
    InputLostError,
    InputReading,
    InputSource,
)
from rotemina.sim.messages import marked, message

_MOST_WAITING = 1024  # readings that nobody has read; the newest are kept


class Pad(InputSource):
    """One device, set by one thread and read by another.

    The program calls :meth:`release_all` when its window loses the focus, is left or is covered, so
    that no key stays down that nobody holds. With a lease it also calls :meth:`renew` in time while
    something is held, or all is released: a program that hangs steers no more. Until then the pad
    confirms what is held. Without a lease it reports only changes.

    Parameters
    ----------
    label : str
        Tells several pads apart, for example "keyboard".
    axes, buttons : sequence of str
        What they are called.
    lease_s : float, optional
        For how long something is held without being set or renewed. Infinite only where what sets
        the pad cannot hang while what reads it goes on.
    clock : callable
        The host's time, s.
    """

    name = marked("engine", "Keys and on-screen pad")

    def __init__(
        self,
        label: str = "pad",
        axes: Sequence[str] = ("x", "y", "z"),
        buttons: Sequence[str] = (),
        *,
        lease_s: float | None = None,
        clock: Clock = time.monotonic,
    ) -> None:
        super().__init__(clock=clock)
        self._lease_s = lease_s
        self.identity = InputIdentity(f"keys:{label}", label, "keys")
        self.axes = tuple(axes)
        self.buttons = tuple(buttons)
        # Guards what follows, and the readings that wait in the devices.
        self._lock = Lock()
        self._there = True
        self._said_s = self._told_s = -inf
        self._let_go = False  # by itself: what was held must be taken anew
        self._deflections = dict.fromkeys(self.axes, 0.0)
        self._held = dict.fromkeys(self.buttons, False)
        self._devices: list[PadDevice] = []

    def deflect(self, axis: str, deflection: float) -> None:
        """Set an axis, −1 to 1; any thread.

        Raises
        ------
        LimitError
            If there is no such axis, or the deflection is beyond; then nothing changes.
        """
        self._require(axis, self.axes, "axis")
        if not -1.0 <= deflection <= 1.0:
            raise LimitError(
                message("engine", "{name}: {axis} at {deflection}: must be -1 to 1").fill(
                    name=self.identity.name, axis=axis, deflection=deflection
                )
            )
        with self._lock:
            self._deflections[axis] = float(deflection)
            self._let_go = False
            self._tell()

    def hold(self, button: str, held: bool = True) -> None:
        """Hold a button, or release it; any thread.

        Raises
        ------
        LimitError
            If there is no such button.
        """
        self._require(button, self.buttons, "button")
        with self._lock:
            self._held[button] = held
            self._let_go = False
            self._tell()

    def renew(self) -> bool:
        """Continue holding what is held; return False where the pad release it. Any thread.

        A deflection of 0 is held like any other.
        """
        with self._lock:
            self._lapse()
            self._said_s = self.clock()
            return not self._let_go

    def release_all(self) -> None:
        """Bring all axes to 0 and release all buttons; any thread."""
        with self._lock:
            self._let_go = False
            self._release()

    def withdraw(self) -> None:
        """Take the device away, as unplugging does; what was held is released. Any thread."""
        with self._lock:
            self._there, self._let_go = False, True
            self._release()
            for device in self._devices:
                device.lost = True
            self._devices.clear()

    def offer(self) -> None:
        """Let the device be there again; any thread."""
        with self._lock:
            self._there = True

    def devices(self) -> Sequence[InputIdentity]:
        """Return the one device, unless it was withdrawn."""
        return (self.identity,) if self._there else ()

    def open(self, identity: InputIdentity) -> "PadDevice":
        """Open the device, which first reports its state; see :class:`InputSource`."""
        with self._lock:
            if not self._there or identity != self.identity:
                raise InputLostError(
                    message("engine", "{name} ({key}) is not connected").fill(
                        name=identity.name, key=identity.key
                    )
                )
            device = PadDevice(self)
            self._devices.append(device)
            device.waiting.append(self._reading())
        return device

    def readings(self, device: "PadDevice") -> tuple[InputReading, ...]:
        """Return the unreported readings of a device, including an expired lease.

        Raises
        ------
        InputLostError
            If it was taken away.
        """
        with self._lock:
            if device.lost:
                raise InputLostError(
                    message("engine", "{name} was removed").fill(name=self.identity.name)
                )
            self._lapse()
            # Within its lease what is held is known to be held, as a device that streams would say.
            leased = self._lease_s is not None and self._holds
            if leased and self.clock() - self._told_s >= CONFIRM_S:
                self._report()
            readings = tuple(device.waiting)
            device.waiting.clear()
        return readings

    def forget(self, device: "PadDevice") -> None:
        """Stop reporting to a closed device."""
        with self._lock:
            if device in self._devices:
                self._devices.remove(device)

    def _require(self, name: str, names: tuple[str, ...], kind: str) -> None:
        if name not in names:
            raise LimitError(
                message("engine", "{name}: no {kind} {wanted}; it has {known}").fill(
                    name=self.identity.name,
                    kind=kind,
                    wanted=repr(name),
                    known=", ".join(names) or marked("engine", "none"),
                )
            )

    @property
    def _holds(self) -> bool:
        return any(self._deflections.values()) or any(self._held.values())

    def _lapse(self) -> None:
        lease_s = inf if self._lease_s is None else self._lease_s
        if self._holds and self.clock() - self._said_s > lease_s:
            self._let_go = True
            self._release()

    def _release(self) -> None:
        self._deflections = dict.fromkeys(self.axes, 0.0)
        self._held = dict.fromkeys(self.buttons, False)
        self._tell()

    def _reading(self) -> InputReading:
        return InputReading(
            self.clock(), tuple(self._deflections.values()), tuple(self._held.values())
        )

    def _tell(self) -> None:
        self._said_s = self.clock()
        self._report()

    def _report(self) -> None:
        reading = self._reading()
        self._told_s = reading.host_time_s
        for device in self._devices:
            device.waiting.append(reading)


class PadDevice(InputDevice):
    """An open pad.

    Parameters
    ----------
    pad : Pad
        Its lock is held while ``waiting`` and ``lost`` are touched.
    """

    def __init__(self, pad: Pad) -> None:
        self.identity = pad.identity
        self.axes = pad.axes
        self.buttons = pad.buttons
        self.waiting: deque[InputReading] = deque(maxlen=_MOST_WAITING)
        self.lost = False
        self._pad = pad
        self._is_open = True

    def read(self) -> tuple[InputReading, ...]:
        """Return what was set since the last call; see :class:`InputDevice`."""
        if not self._is_open:
            raise StateError(
                message("engine", "{name} was closed; open it again").fill(name=self.identity.name)
            )
        return self._pad.readings(self)

    def close(self) -> None:
        """Release it; see :class:`InputDevice`."""
        self._is_open = False
        self._pad.forget(self)
