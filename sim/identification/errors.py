"""Errors of identification: signals or settings from which nothing can be concluded."""

from rotemina.sim.errors import InputError


class IdentificationError(InputError):
    """Signals or settings from which no model can be identified."""


class TimeGridError(IdentificationError):
    """The record is not sampled at equal intervals."""


class TooShortError(IdentificationError):
    """There are too few samples, segments, periods or experiments."""


class ExcitationError(IdentificationError):
    """The input does not move, or not in enough ways to determine the result."""


class SettingError(IdentificationError):
    """An order, a delay, a factor or a band that makes no sense."""


class ModelFileError(InputError):
    """A file of published models that cannot be read."""
