"""Errors of effects."""

from rotemina.sim.errors import InputError


class EffectError(InputError):
    """An effect that cannot sit where it is asked to, or one of its parameters out of bounds."""


class BrokenEffectError(EffectError):
    """An effect whose own code fails: its step function does not compile, or returns no numbers."""
