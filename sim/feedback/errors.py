"""Errors of the feedback of an axis."""

from rotemina.sim.errors import InputError


class FeedbackError(InputError):
    """Gains, limits or a loop that cannot be used."""


class LostLoopError(FeedbackError):
    """A loop whose sensor or actuator does not answer it."""
