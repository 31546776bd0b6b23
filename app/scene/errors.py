"""Errors of the 3-D view."""

from rotemina.sim.errors import InputError


class ViewerError(InputError):
    """The viewer cannot be served or shown."""
