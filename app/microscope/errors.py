"""Errors of requests to the microscope."""

from rotemina.sim.errors import InputError


class MicroscopeError(InputError):
    """A calibration, a click or a picture with which nothing is to be moved."""
