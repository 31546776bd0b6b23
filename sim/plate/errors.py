"""Errors of the holding plate."""

from rotemina.sim.errors import InputError


class PlateError(InputError):
    """A plate, mesh or load that cannot be computed or used."""
