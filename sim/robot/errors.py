"""Errors of robot files."""

from rotemina.sim.errors import InputError


class RobotFileError(InputError):
    """A robot file that cannot be read or describes no possible machine."""
