"""Errors of devices. Each is also the matching builtin error."""

from rotemina.sim.errors import InputError, ToldError


class DriverError(ToldError):
    """A device did not do what it was asked; the message says what, where and what to do."""


class ConnectionLostError(DriverError, ConnectionError):
    """The device cannot be reached, or no longer: its position is not to be trusted."""


class DeviceResetError(ConnectionLostError):
    """The line works, but the device has restarted: what it knew, as its position, is gone."""


class DriverTimeoutError(DriverError, TimeoutError):
    """The device did not answer in time."""


class ProtocolError(DriverError):
    """The device, or a driver, answered something that makes no sense."""


class LimitError(DriverError, InputError):
    """A target or trajectory beyond the limits of the machine; nothing has moved."""


class StateError(DriverError):
    """A request that the device's present state does not allow; nothing has changed."""
