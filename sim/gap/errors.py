"""Errors of the diagnosis."""

from rotemina.sim.errors import InputError


class GapError(InputError):
    """Records and a robot that cannot be diagnosed together."""
