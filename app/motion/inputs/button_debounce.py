"""Debouncing of a button, or of an axis used as one."""

# Changes within this time after a change are ignored.
BOUNCE_PERIOD_S = 0.02


class DebouncedButton:
    """Debounced button: a change counts at once, the bounces after it do not.

    A button that is down in the first reading (stuck, taped, or held while the device is plugged
    in) does nothing until it has been released.

    Parameters
    ----------
    counts_from_start : bool
        Whether a button that is down in the first reading counts as pressed, as for stops.
    """

    def __init__(self, counts_from_start: bool = False) -> None:
        self._is_usable = counts_from_start
        self._is_down_in_reading: bool | None = None
        self._is_down = False
        self._changed_s = float("-inf")

    @property
    def is_held(self) -> bool:
        """Whether the button is down and counts."""
        return self._is_down and self._is_usable

    def feed(self, time_s: float, down: bool) -> bool:
        """Process a reading; return whether the button has just been pressed."""
        self._is_down_in_reading = down
        return self.step(time_s)

    def step(self, now_s: float) -> bool:
        """Advance to a time; return whether the button has just been pressed."""
        if self._is_down_in_reading is None:
            return False
        if self._is_down_in_reading == self._is_down:
            self._is_usable = self._is_usable or not self._is_down
            return False
        if now_s - self._changed_s < BOUNCE_PERIOD_S:
            return False
        self._is_down, self._changed_s = self._is_down_in_reading, now_s
        self._is_usable = self._is_usable or not self._is_down
        return self.is_held


class AxisThreshold:
    """Threshold with hysteresis that turns an axis into a button.

    Parameters
    ----------
    threshold : float
        Deflection, −1 to 1 but not 0. A negative threshold is crossed downwards.
    hysteresis : float
        Distance from the threshold towards the rest at which the axis counts as released.
    """

    def __init__(self, threshold: float, hysteresis: float) -> None:
        self._sign = 1.0 if threshold > 0 else -1.0
        self._threshold = abs(threshold)
        self._release_level = max(abs(threshold) - hysteresis, 0.0)
        self._is_beyond = False

    def feed(self, deflection: float) -> bool:
        """Process a deflection; return whether it is beyond the threshold."""
        level = self._sign * deflection
        self._is_beyond = (
            level > self._release_level if self._is_beyond else level >= self._threshold
        )
        return self._is_beyond
