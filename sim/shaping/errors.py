"""What is wrong with a profile that someone asked for."""

from rotemina.sim.errors import InputError


class ShapingError(InputError):
    """A profile, shaper or fit that cannot be made; the message says what, value and bound."""
