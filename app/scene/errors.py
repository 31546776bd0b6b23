"""What can go wrong with the view of the scene."""

from rotemina.sim.errors import InputError


class ViewerError(InputError):
    """The viewer cannot be served or shown."""
