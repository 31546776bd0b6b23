"""What the tuning of a loop refuses."""

from rotemina.sim.errors import InputError


class TuningError(InputError):
    """A search, a point or a file of a tuning that cannot be used."""
