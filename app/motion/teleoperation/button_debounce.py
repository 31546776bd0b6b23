"""Debouncing of a button, or of an axis used as one."""

BOUNCE_S = 0.02  # after a change no other one is believed for so long


class Button:
    """Debounced: the first change counts at once, its bounces do not.

    A button that is down when it is first seen (stuck, taped, held while plugging in) does nothing
    until it has been released.

    Parameters
    ----------
    at_once : bool
        Count it as pressed even then: for stops.
    """

    def __init__(self, at_once: bool = False) -> None:
        self._usable = at_once
        self._said: bool | None = None
        self._down = False
        self._changed_s = float("-inf")

    @property
    def held(self) -> bool:
        """Whether it is down."""
        return self._down and self._usable

    def feed(self, time_s: float, down: bool) -> bool:
        """Process a reading; return whether it went down by it."""
        self._said = down
        return self.step(time_s)

    def step(self, now_s: float) -> bool:
        """Advance time; return whether it turned out to be down."""
        if self._said is None:
            return False
        if self._said == self._down:
            self._usable = self._usable or not self._down
            return False
        if now_s - self._changed_s < BOUNCE_S:
            return False
        self._down, self._changed_s = self._said, now_s
        self._usable = self._usable or not self._down
        return self.held


class Threshold:
    """A threshold with hysteresis that makes an axis a button.

    Parameters
    ----------
    at : float
        Deflection, −1 to 1 without 0; a negative one is passed downwards.
    hysteresis : float
        How far nearer to the rest it must come back.
    """

    def __init__(self, at: float, hysteresis: float) -> None:
        self._sign = 1.0 if at > 0 else -1.0
        self._at = abs(at)
        self._back = max(abs(at) - hysteresis, 0.0)
        self._prediction = False

    def feed(self, deflection: float) -> bool:
        """Return whether it is beyond now."""
        way = self._sign * deflection
        self._prediction = way > self._back if self._prediction else way >= self._at
        return self._prediction
