"""Errors of the application that a user can cause by a file or a request."""

from rotemina.sim.errors import (
    InputError,
)


class BenchError(InputError):
    """A folder that does not hold a machine, or an invalid ``truth.toml``."""


class BlindError(InputError):
    """A blind test that cannot be run because of its folder, cases or labels."""


class CommandError(InputError):
    """Options that cannot be used, or a request that cannot be met."""

    context = "cli"


class DriverUnusableError(InputError):
    """The constructor of a driver failed; the message contains its error."""


class FrameError(InputError):
    """A robot does not have a mode, or the mode cannot begin at the given joints."""


class HealthBookError(InputError):
    """A file of health cards that cannot be read."""


class HiddenMachineError(InputError):
    """A robot for which the generator cannot make a hidden machine."""


class InputCalibrationError(InputError):
    """A calibration cannot be used, or a stick cannot be calibrated."""


class InputProfileError(InputError):
    """A profile cannot be read, saved or used."""


class LibraryError(InputError):
    """The library cannot be read, or a change cannot be stored; the message says what to do."""


class DamagedLibraryError(LibraryError):
    """The database of the library was damaged; it was renamed."""


class MicroscopeError(InputError):
    """A request is refused, or a calibration, a click or a picture does not permit a move."""


class ModelError(InputError):
    """A model cannot be used; the message gives reason and remedy."""


class OffscreenError(InputError):
    """The run without a display could not be completed."""


class PenetrationError(InputError):
    """No penetration is possible with these parameters or this machine.

    The message names the cause and the bound.
    """


class PluginNameError(InputError):
    """A plugin name that is invalid or already in use."""


class PluginWriteError(InputError):
    """A package that cannot be written into the folder."""


class RecentringError(InputError):
    """The nano stage cannot be moved from these joints while the tip stays in place."""


class RecordingError(InputError):
    """A recording cannot be made, recovered, read or used."""


class RequestRefusedError(InputError):
    """A request was refused; the message gives reason and remedy."""


class SavedPositionError(InputError):
    """A position cannot be saved, or a file of positions cannot be used."""


class ScalingError(InputError):
    """A scaling law or its parameters are invalid, or an axis cannot be driven with them."""


class VideoError(InputError):
    """A video cannot be created, or ended too early."""


class ViewerError(InputError):
    """The viewer cannot be served or shown."""


class WorkCancelledError(InputError):
    """The operator cancelled the work."""
