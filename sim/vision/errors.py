"""What can be wrong with images and with what is concluded from them."""

from rotemina.sim.errors import InputError


class VisionError(InputError):
    """An image, or a set of them, that does not show what is requested."""


class RegistrationError(VisionError):
    """Two images whose shift cannot be determined."""


class CalibrationError(VisionError):
    """Moves and image shifts that give no trustworthy calibration."""
