"""Whether an input axis may move anything: seen at rest, and plausible.

An axis begins untrusted and is trusted when it has been in its dead zone for a moment. It loses
that trust when its numbers cannot come from a hand.
"""

from collections import deque
from math import isfinite, isnan

from rotemina.app.motion.teleoperation.axis_calibration import AxisCalibration
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

SETTLE_S = 0.1  # in the dead zone
LEAP = 0.1  # of the range, between two readings
REVERSALS = 10  # leaps to and fro
WITHIN_S = 0.5  # for no hand moves to and fro ten times a second
CALM_S = 1.0  # without leaps, until a jittering axis is looked at again

NOT_CENTRED = message("engine", "not at rest yet: release it")
NOTHING_SAID = message("engine", "has not reported yet: move and release it")


class AxisTrust:
    """Watches one axis.

    Parameters
    ----------
    calibration : AxisCalibration
        Where its dead zone and its ends are.
    """

    def __init__(self, calibration: AxisCalibration) -> None:
        self._calibration = calibration
        self._jitter = _Jitter(LEAP * (calibration.high - calibration.low))
        self._why: str | None = NOT_CENTRED
        self._said: float | None = None
        self._centred_since_s: float | None = None
        self._at_end_only = True

    def reset(self, why: str) -> None:
        """Distrust the axis until it is at rest; ``why`` is shown to the operator."""
        self._why = why

    def forget(self, why: str) -> None:
        """Distrust the axis until it has reported being at rest again."""
        self._why = why
        self._said = None
        self._centred_since_s = None

    @property
    def plausible(self) -> bool:
        """Whether its numbers could come from a hand; they may do so without being centred."""
        return self._said is not None and _possible(self._said) and not self._jitter.found

    @property
    def reason(self) -> str | None:
        """Why it is not trusted, in words; None if it is."""
        if self._said is not None and not _possible(self._said):
            return message(
                "engine", "reports {raw}, outside −1 to 1: disconnect and check it"
            ).fill(raw=rounded(self._said, 6))
        if self._jitter.found:
            return message(
                "engine", "jitters from end to end: its potentiometer or cable is faulty"
            )
        if self._why is not None and self._said is not None and self._at_end_only:
            return message(
                "engine",
                "has been at its end from the start: free it; if it rests there, calibrate "
                "it as one-sided",
            )
        return NOTHING_SAID if self._said is None and self._why == NOT_CENTRED else self._why

    def feed(self, time_s: float, raw: float) -> None:
        """Process a reading and the time when it came in; NaN says nothing."""
        if isnan(raw):
            self.forget(NOT_CENTRED)
            return
        self._said = raw
        if not _possible(raw):
            self._lose()
            return
        if self._jitter.feed(time_s, raw):
            self._lose()
        if not self._calibration.at_end(raw):
            self._at_end_only = False
        if self._calibration.deflection(raw) != 0.0:
            self._centred_since_s = None
        elif self._centred_since_s is None:
            self._centred_since_s = time_s
        # A batch may hold both the rest and what came after it.
        self._settle(time_s)

    def step(self, now_s: float) -> None:
        """Advance time: a device that says nothing may still be at rest."""
        self._jitter.step(now_s)
        self._settle(now_s)

    def _settle(self, time_s: float) -> None:
        since_s = self._centred_since_s
        if since_s is not None and time_s - since_s >= SETTLE_S and not self._jitter.found:
            self._why = None

    def _lose(self) -> None:
        self._why = NOT_CENTRED
        self._centred_since_s = None


class _Jitter:
    """Finds leaps to and fro, faster than a hand can make them."""

    def __init__(self, leap: float) -> None:
        self.found = False
        self._leap = leap
        self._raw: float | None = None
        self._rose = False
        self._reversals_s: deque[float] = deque(maxlen=REVERSALS)

    def feed(self, time_s: float, raw: float) -> bool:
        """Process a reading; return whether it is one leap to and fro too many."""
        before, self._raw = self._raw, raw
        if before is None or abs(raw - before) < self._leap:
            return False
        rose, self._rose = self._rose, raw > before
        if self._rose is rose:
            return False
        self._reversals_s.append(time_s)
        times = self._reversals_s
        if len(times) < REVERSALS or times[-1] - times[0] > WITHIN_S:
            return False
        self.found = True
        return True

    def step(self, now_s: float) -> None:
        if self.found and now_s - self._reversals_s[-1] >= CALM_S:
            self.found = False
            self._reversals_s.clear()


def _possible(raw: float) -> bool:
    return isfinite(raw) and abs(raw) <= 1.0
