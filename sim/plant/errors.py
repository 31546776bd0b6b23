"""Errors of simulation."""

from rotemina.sim.errors import InputError


class PlantError(InputError):
    """A robot and commands that cannot be simulated together."""
