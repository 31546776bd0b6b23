"""How far a diagnosis has come."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Progress:
    """A step of a diagnosis.

    Attributes
    ----------
    stage : str
        What is done now: "where", "screening", "fitting", "selecting", "deciding".
    axis : str, optional
    candidate : str, optional
        The effect that is tried.
    share : float
        Of the whole that is done, 0 to 1, never falling.
    """

    stage: str
    axis: str | None
    candidate: str | None
    share: float


Listener = Callable[[Progress], None]
"""Is told of every step; what it raises ends the diagnosis."""


def unheard(_progress: Progress) -> None:
    """Listen to nothing."""
