"""Protection of a control whose meaning changes, against presses meant for the old meaning."""

import time

from rotemina.drivers.contract import Clock

#: A press counts only after a control has had its meaning for this long; a double click is faster.
SETTLING_TIME_S = 0.5


class ButtonMeaning:
    """The current meaning of a control, and the time since which it has had it.

    Parameters
    ----------
    clock : callable
        Returns the host's time, s.
    meaning : object
        The initial meaning, which counts as settled from the start.
    """

    def __init__(self, clock: Clock = time.monotonic, meaning: object = None) -> None:
        self._clock = clock
        self._meaning = meaning
        self._since_s = float("-inf")

    def set_meaning(self, meaning: object) -> None:
        """Set what a press means from now on."""
        if meaning != self._meaning:
            self._meaning, self._since_s = meaning, self._clock()

    def is_settled(self, meaning: object) -> bool:
        """Return whether a control has had this meaning long enough to accept a press."""
        return meaning == self._meaning and self._clock() - self._since_s >= SETTLING_TIME_S
