"""Errors of a requested penetration."""

from rotemina.sim.errors import InputError


class PenetrationError(InputError):
    """Parameters, or a machine, with which no penetration is possible; says what and the bound."""
