"""Keyboard and on-screen pad: an input device whose state the program sets."""

import time
from collections import deque
from collections.abc import Sequence
from math import inf
from threading import Lock

from rotemina.drivers.contract import Clock, InputLostError, LimitError, StateError
from rotemina.drivers.inputs.device import (
    KEEPALIVE_PERIOD_S,
    InputDevice,
    InputIdentity,
    InputReading,
    InputSource,
)
from rotemina.sim.messages import marked

# If more readings wait, the oldest are dropped.
_MAX_UNREAD_READINGS = 1024


class InputPad(InputSource):
    """Source of one device, whose state one thread sets and another thread reads.

    The program calls :meth:`release_all` when its window loses the focus, is left or is covered, so
    that no key stays pressed. With a lease, the program must also call :meth:`renew` in time while
    something is held. Otherwise everything is released, so that a program that hangs does not
    steer. During the lease the pad repeats its state regularly. Without a lease it reports only
    changes.

    Parameters
    ----------
    label : str
        Distinguishes several pads, for example "keyboard".
    axes, buttons : sequence of str
        Names of the axes and buttons.
    lease_s : float, optional
        How long something is held without being set or renewed. It may be infinite only if the
        thread that reads cannot continue while the thread that sets the state hangs.
    clock : callable
        Returns the host's time, s.
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
        # Protects the attributes below and the unread readings of the devices.
        self._lock = Lock()
        self._is_plugged_in = True
        self._last_renewal_s = self._last_report_s = -inf
        # If the lease has expired, keys that are still pressed have to be pressed again.
        self._has_lease_expired = False
        self._deflections = dict.fromkeys(self.axes, 0.0)
        self._held_buttons = dict.fromkeys(self.buttons, False)
        self._devices: list[PadDevice] = []

    def deflect(self, axis: str, deflection: float) -> None:
        """Set an axis, −1 to 1; may be called on any thread.

        Raises
        ------
        LimitError
            If there is no such axis, or the deflection is out of range; then nothing changes.
        """
        self._check_name(axis, self.axes, "axis")
        if not -1.0 <= deflection <= 1.0:
            raise LimitError(
                "{name}: {axis} at {deflection}: must be -1 to 1",
                name=self.identity.name,
                axis=axis,
                deflection=deflection,
            )
        with self._lock:
            self._deflections[axis] = float(deflection)
            self._has_lease_expired = False
            self._renew_and_report()

    def hold(self, button: str, held: bool = True) -> None:
        """Hold or release a button; may be called on any thread.

        Raises
        ------
        LimitError
            If there is no such button.
        """
        self._check_name(button, self.buttons, "button")
        with self._lock:
            self._held_buttons[button] = held
            self._has_lease_expired = False
            self._renew_and_report()

    def renew(self) -> bool:
        """Renew the lease; return False if it has expired and everything was released.

        May be called on any thread. A deflection of 0 is held like any other.
        """
        with self._lock:
            self._end_expired_lease()
            self._last_renewal_s = self.clock()
            return not self._has_lease_expired

    def release_all(self) -> None:
        """Set all axes to 0 and release all buttons; may be called on any thread."""
        with self._lock:
            self._has_lease_expired = False
            self._set_to_rest()

    def unplug(self) -> None:
        """Remove the device as if it were unplugged, and release everything; for any thread."""
        with self._lock:
            self._is_plugged_in, self._has_lease_expired = False, True
            self._set_to_rest()
            for device in self._devices:
                device.lost = True
            self._devices.clear()

    def plug_in(self) -> None:
        """Make the device available again; may be called on any thread."""
        with self._lock:
            self._is_plugged_in = True

    def devices(self) -> Sequence[InputIdentity]:
        """Return the device, unless it is unplugged."""
        return (self.identity,) if self._is_plugged_in else ()

    def open(self, identity: InputIdentity) -> "PadDevice":
        """Open the device, whose first reading is its current state; see :class:`InputSource`."""
        with self._lock:
            if not self._is_plugged_in or identity != self.identity:
                raise InputLostError(
                    "{name} ({key}) is not connected", name=identity.name, key=identity.key
                )
            device = PadDevice(self)
            self._devices.append(device)
            device.unread_readings.append(self._make_reading())
        return device

    def take_readings(self, device: "PadDevice") -> tuple[InputReading, ...]:
        """Return the unread readings of a device, and release everything if the lease expired.

        Raises
        ------
        InputLostError
            If the device was unplugged.
        """
        with self._lock:
            if device.lost:
                raise InputLostError("{name} was removed", name=self.identity.name)
            self._end_expired_lease()
            # During a lease the state is certain to be up to date, so it is repeated as a streaming
            # device would do.
            is_lease_running = self._lease_s is not None and self._is_anything_held
            if is_lease_running and self.clock() - self._last_report_s >= KEEPALIVE_PERIOD_S:
                self._report()
            readings = tuple(device.unread_readings)
            device.unread_readings.clear()
        return readings

    def forget_device(self, device: "PadDevice") -> None:
        """Stop adding readings to a closed device."""
        with self._lock:
            if device in self._devices:
                self._devices.remove(device)

    def _check_name(self, name: str, names: tuple[str, ...], kind: str) -> None:
        if name not in names:
            raise LimitError(
                "{name}: no {kind} {wanted}; it has {known}",
                name=self.identity.name,
                kind=kind,
                wanted=repr(name),
                known=", ".join(names) or marked("engine", "none"),
            )

    @property
    def _is_anything_held(self) -> bool:
        return any(self._deflections.values()) or any(self._held_buttons.values())

    def _end_expired_lease(self) -> None:
        lease_s = inf if self._lease_s is None else self._lease_s
        if self._is_anything_held and self.clock() - self._last_renewal_s > lease_s:
            self._has_lease_expired = True
            self._set_to_rest()

    def _set_to_rest(self) -> None:
        self._deflections = dict.fromkeys(self.axes, 0.0)
        self._held_buttons = dict.fromkeys(self.buttons, False)
        self._renew_and_report()

    def _make_reading(self) -> InputReading:
        return InputReading(
            self.clock(), tuple(self._deflections.values()), tuple(self._held_buttons.values())
        )

    def _renew_and_report(self) -> None:
        self._last_renewal_s = self.clock()
        self._report()

    def _report(self) -> None:
        reading = self._make_reading()
        self._last_report_s = reading.host_time_s
        for device in self._devices:
            device.unread_readings.append(reading)


class PadDevice(InputDevice):
    """An open pad.

    Parameters
    ----------
    pad : InputPad
        The lock of the pad protects ``waiting`` and ``lost``.
    """

    def __init__(self, pad: InputPad) -> None:
        self.identity = pad.identity
        self.axes = pad.axes
        self.buttons = pad.buttons
        self.unread_readings: deque[InputReading] = deque(maxlen=_MAX_UNREAD_READINGS)
        self.lost = False
        self._pad = pad
        self._is_open = True

    def read(self) -> tuple[InputReading, ...]:
        """Return the readings since the last call; see :class:`InputDevice`."""
        if not self._is_open:
            raise StateError("{name} was closed; open it again", name=self.identity.name)
        return self._pad.take_readings(self)

    def close(self) -> None:
        """Release the pad; see :class:`InputDevice`."""
        self._is_open = False
        self._pad.forget_device(self)
