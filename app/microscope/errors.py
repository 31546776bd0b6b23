"""What can be wrong with what somebody asks of the microscope."""

from rotemina.sim.errors import InputError


class MicroscopeError(InputError):
    """A calibration, a click or a picture with which nothing is to be moved."""
