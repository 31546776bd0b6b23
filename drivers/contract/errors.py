"""Errors of the driver layer; a failure of a device is also the corresponding built-in error."""

from rotemina.sim.errors import InputError, MessageError


class DriverError(MessageError):
    """A failure of a device; the message says what happened, where, and what to do."""


class ConnectionLostError(DriverError, ConnectionError):
    """The device cannot be reached, or no longer. Its position must not be trusted."""


class DeviceResetError(ConnectionLostError):
    """The connection works, but the device has restarted and lost its state and position."""


class DriverTimeoutError(DriverError, TimeoutError):
    """The device did not answer in time."""


class ProtocolError(DriverError):
    """The device or its driver returned invalid data."""


class LimitError(DriverError, InputError):
    """A target or trajectory is beyond the machine's limits; nothing has moved."""


class StateError(DriverError):
    """The current state of the device does not permit the request; nothing has changed."""


class GateError(StateError, InputError):
    """The gate blocked a request; nothing was sent to the device."""


class StalePermitError(GateError):
    """The request is outdated by a stop, release or connection, or its lease has expired."""


class DriverSettingError(InputError):
    """A driver does not have a setting, or does not accept its value."""


class CameraLostError(DriverError, ConnectionError):
    """The camera was unplugged, its video has ended, or it has changed. It must be closed."""


class CameraReadError(DriverError):
    """One picture could not be read; the next one may succeed."""


class CameraRefusedError(DriverError, InputError):
    """There is no camera, video or picture at the address, or it cannot be opened."""


class CameraSettingError(DriverError, InputError):
    """The camera does not support a setting; no setting has changed."""


class InputLostError(DriverError, ConnectionError):
    """The input device was unplugged, or no longer responds."""


class DescriptorError(DriverError):
    """A report descriptor is invalid."""


class ScriptError(InputError):
    """A script is invalid."""


class BudgetError(InputError):
    """Error in assembling the firmware or counting its cycles."""


class FaultCommandError(InputError):
    """Error in a command for fault injection. The command had no effect."""
