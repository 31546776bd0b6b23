"""Errors of cameras."""

from rotemina.drivers.errors import DriverError
from rotemina.sim.errors import InputError


class CameraLostError(DriverError, ConnectionError):
    """The camera was unplugged, has ended or gives something else than before; close it."""


class CameraReadError(DriverError):
    """One picture could not be read; the next one may be good."""


class CameraRefusedError(DriverError, InputError):
    """What was named is no camera, no video or no picture, or cannot be opened."""


class CameraSettingError(DriverError, InputError):
    """A setting that the camera cannot take; nothing has changed."""
