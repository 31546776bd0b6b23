"""Errors of recordings."""

from rotemina.sim.errors import InputError


class RecordingError(InputError):
    """A recording that cannot be made, recovered, read or used."""
