"""Errors of a calibration."""

from rotemina.sim.errors import InputError


class CalibrationError(InputError):
    """A calibration that cannot be made, read or used."""
