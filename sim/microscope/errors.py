"""What can be wrong with a simulated microscope."""

from rotemina.sim.errors import InputError


class SceneError(InputError):
    """A microscope, a pin or a cell that cannot be drawn."""
