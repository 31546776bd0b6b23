"""An open joystick or gamepad."""

import logging

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import StateError
from rotemina.drivers.inputs.device import (
    InputDevice,
    InputIdentity,
    InputLostError,
    InputReading,
)
from rotemina.drivers.inputs.hid.decoder import Decoder, Ignored
from rotemina.drivers.inputs.hid.hidapi import Handle
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import message

_LOG = logging.getLogger(__name__)
_REPORT_BYTES = 4096
# The system holds 64 reports at most; a device that never stops must not keep us here.
_MOST_WAITING = 256


class HidDevice(InputDevice):
    """A joystick or gamepad.

    Parameters
    ----------
    identity : InputIdentity
    handle : Handle
        Open, and set not to wait.
    decoder : Decoder
        Of its report descriptor.
    clock : callable
        The host's time, s.
    """

    def __init__(
        self, identity: InputIdentity, handle: Handle, decoder: Decoder, clock: Clock
    ) -> None:
        self.identity = identity
        self.axes = decoder.axes
        self.buttons = decoder.buttons
        self._handle: Handle | None = handle
        self._decoder = decoder
        self._clock = clock

    @property
    def ignored(self) -> Ignored:
        """Counts of data that contradict the descriptor."""
        return self._decoder.ignored

    def read(self) -> tuple[InputReading, ...]:
        """Return a reading for each report that has come in; see :class:`InputDevice`."""
        if self._handle is None:
            raise StateError(
                message("engine", "{name} was closed; open it again").fill(name=self.identity.name)
            )
        readings = []
        for _ in range(_MOST_WAITING):
            report = self._receive(self._handle)
            if not report:
                break
            state = self._decoder.decode(report)
            if state is not None:
                readings.append(InputReading(self._clock(), *state, self._decoder.fault))
        return tuple(readings)

    def close(self) -> None:
        """Release it; see :class:`InputDevice`."""
        handle, self._handle = self._handle, None
        if handle is not None:
            try:
                handle.close()
            except OSError as error:  # one that was pulled out cannot be closed either
                _LOG.info("%s: closing it: %s", self.identity.name, error)
            if self.ignored != Ignored():
                _LOG.info("%s: %s", self.identity.name, self.ignored)

    def _receive(self, handle: Handle) -> bytes:
        """Return the next report that waits; nothing if there is none."""
        try:
            return bytes(handle.read(_REPORT_BYTES))
        except (OSError, ValueError) as error:
            raise InputLostError(
                message(
                    "engine",
                    "{name} was unplugged, or lost its power or radio link ({error})",
                ).fill(name=self.identity.name, error=reason_of(error))
            ) from error
