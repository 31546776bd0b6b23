"""An open joystick or gamepad."""

import logging

from rotemina.drivers.contract import Clock, InputLostError, StateError
from rotemina.drivers.inputs.device import InputDevice, InputIdentity, InputReading
from rotemina.drivers.inputs.hid_decoder import HidDecoder, IgnoredCounts
from rotemina.drivers.inputs.hid_library import HidHandle
from rotemina.sim.errors import describe_exception

_LOG = logging.getLogger(__name__)
_MAX_REPORT_BYTES = 4096
# The system buffers at most 64 reports. This limit ends a read if a device never stops sending.
_MAX_REPORTS_PER_READ = 256


class HidDevice(InputDevice):
    """An open joystick or gamepad.

    Parameters
    ----------
    identity : InputIdentity
    handle : HidHandle
        An open, non-blocking handle.
    decoder : HidDecoder
        Created from the device's report descriptor.
    clock : callable
        Returns the host's time, s.
    """

    def __init__(
        self, identity: InputIdentity, handle: HidHandle, decoder: HidDecoder, clock: Clock
    ) -> None:
        self.identity = identity
        self.axes = decoder.axes
        self.buttons = decoder.buttons
        self._handle: HidHandle | None = handle
        self._decoder = decoder
        self._clock = clock

    @property
    def ignored(self) -> IgnoredCounts:
        """Counts of received data that do not match the descriptor."""
        return self._decoder.ignored

    def read(self) -> tuple[InputReading, ...]:
        """Return a reading for each report that has arrived; see :class:`InputDevice`."""
        if self._handle is None:
            raise StateError("{name} was closed; open it again", name=self.identity.name)
        readings = []
        for _ in range(_MAX_REPORTS_PER_READ):
            report = self._receive(self._handle)
            if not report:
                break
            state = self._decoder.decode(report)
            if state is not None:
                readings.append(InputReading(self._clock(), *state, self._decoder.fault))
        return tuple(readings)

    def close(self) -> None:
        """Release the device; see :class:`InputDevice`."""
        handle, self._handle = self._handle, None
        if handle is not None:
            try:
                handle.close()
            # Closing an unplugged device fails, which does no harm.
            except OSError as error:
                _LOG.info("%s: closing it: %s", self.identity.name, error)
            if self.ignored != IgnoredCounts():
                _LOG.info("%s: %s", self.identity.name, self.ignored)

    def _receive(self, handle: HidHandle) -> bytes:
        """Return the next waiting report; empty if there is none."""
        try:
            return bytes(handle.read(_MAX_REPORT_BYTES))
        except (OSError, ValueError) as error:
            raise InputLostError(
                "{name} was unplugged, or lost its power or radio link ({error})",
                name=self.identity.name,
                error=describe_exception(error),
            ) from error
