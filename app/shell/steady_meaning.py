"""A control whose meaning changes counts no press that was meant for what it did before."""

import time

from rotemina.drivers.clock import Clock

#: For so long a control shows one meaning before a press counts; a double click is faster.
SETTLE_S = 0.5


class SteadyMeaning:
    """Notes since when a control has had its present meaning.

    Parameters
    ----------
    clock : callable
        The host's time, s.
    meaning : object
        What it means from the beginning, when nobody can have meant anything else.
    """

    def __init__(self, clock: Clock = time.monotonic, meaning: object = None) -> None:
        self._clock = clock
        self._meaning = meaning
        self._since_s = float("-inf")

    def show(self, meaning: object) -> None:
        """Note what a press means from now on."""
        if meaning != self._meaning:
            self._meaning, self._since_s = meaning, self._clock()

    def is_settled(self, meaning: object) -> bool:
        """Return whether this has been shown for long enough that a press was meant for it."""
        return meaning == self._meaning and self._clock() - self._since_s >= SETTLE_S
