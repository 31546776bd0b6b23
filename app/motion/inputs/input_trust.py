"""Trust in input axes: only trusted axes may move the machine.

An axis is untrusted at first. It is trusted once it has been in its dead zone for a moment, and
no longer trusted when its values cannot come from a hand.
"""

from collections import deque
from math import isfinite, isnan

from rotemina.app.motion.inputs.axis_calibration import InputAxisCalibration
from rotemina.sim.messages import format_rounded, message

# An axis is trusted once it has been in its dead zone for this long.
MIN_CENTRED_S = 0.1
# A change of the raw value by this fraction of the range between two readings is a leap.
MIN_LEAP_RANGE_RATIO = 0.1
# This many leaps in alternating directions within this time are jitter, because no hand moves to
# and fro ten times a second.
JITTER_REVERSAL_COUNT = 10
JITTER_WINDOW_S = 0.5
# An axis no longer counts as jittering after this time without leaps.
JITTER_RECOVERY_S = 1.0

NOT_CENTRED_REASON = message("engine", "not at rest yet: release it")
NO_REPORT_REASON = message("engine", "has not reported yet: move and release it")


class AxisTrust:
    """Trust in one axis, decided from its readings.

    Parameters
    ----------
    calibration : InputAxisCalibration
        Contains the dead zone and the ends of the axis.
    """

    def __init__(self, calibration: InputAxisCalibration) -> None:
        self._calibration = calibration
        self._jitter = _JitterDetector(MIN_LEAP_RANGE_RATIO * (calibration.high - calibration.low))
        self._distrust_reason: str | None = NOT_CENTRED_REASON
        self._latest_raw: float | None = None
        self._centred_since_s: float | None = None
        self._has_been_only_at_end = True

    def distrust(self, reason: str) -> None:
        """Distrust the axis until it is at rest; ``reason`` is shown to the operator."""
        self._distrust_reason = reason

    def forget_reports(self, reason: str) -> None:
        """Forget the reports, and distrust the axis until new reports show it at rest."""
        self._distrust_reason = reason
        self._latest_raw = None
        self._centred_since_s = None

    @property
    def is_plausible(self) -> bool:
        """Whether the values could come from a hand, whether centred or not."""
        return (
            self._latest_raw is not None
            and _is_possible(self._latest_raw)
            and not self._jitter.is_jittering
        )

    @property
    def reason(self) -> str | None:
        """Message on why the axis is not trusted; None if it is trusted."""
        if self._latest_raw is not None and not _is_possible(self._latest_raw):
            return message(
                "engine", "reports {raw}, outside −1 to 1: disconnect and check it"
            ).fill(raw=format_rounded(self._latest_raw, 6))
        if self._jitter.is_jittering:
            return message(
                "engine", "jitters from end to end: its potentiometer or cable is faulty"
            )
        if (
            self._distrust_reason is not None
            and self._latest_raw is not None
            and self._has_been_only_at_end
        ):
            return message(
                "engine",
                "has been at its end from the start: free it; if it rests there, calibrate "
                "it as one-sided",
            )
        return (
            NO_REPORT_REASON
            if self._latest_raw is None and self._distrust_reason == NOT_CENTRED_REASON
            else self._distrust_reason
        )

    def feed(self, time_s: float, raw: float) -> None:
        """Process a raw value, and the time of its reading; NaN stands for no value."""
        if isnan(raw):
            self.forget_reports(NOT_CENTRED_REASON)
            return
        self._latest_raw = raw
        if not _is_possible(raw):
            self._restart_centring()
            return
        if self._jitter.feed(time_s, raw):
            self._restart_centring()
        if not self._calibration.is_at_end(raw):
            self._has_been_only_at_end = False
        if self._calibration.compute_deflection(raw) != 0.0:
            self._centred_since_s = None
        elif self._centred_since_s is None:
            self._centred_since_s = time_s
        # A batch of readings may contain both the rest and the motion after it.
        self._trust_if_centred(time_s)

    def step(self, now_s: float) -> None:
        """Advance to a time, because a device at rest may not report."""
        self._jitter.step(now_s)
        self._trust_if_centred(now_s)

    def _trust_if_centred(self, time_s: float) -> None:
        since_s = self._centred_since_s
        if (
            since_s is not None
            and time_s - since_s >= MIN_CENTRED_S
            and not self._jitter.is_jittering
        ):
            self._distrust_reason = None

    def _restart_centring(self) -> None:
        self._distrust_reason = NOT_CENTRED_REASON
        self._centred_since_s = None


class _JitterDetector:
    """Detects leaps to and fro that are faster than a hand can move."""

    def __init__(self, min_leap: float) -> None:
        self.is_jittering = False
        self._min_leap = min_leap
        self._latest_raw: float | None = None
        self._has_risen = False
        self._reversals_s: deque[float] = deque(maxlen=JITTER_REVERSAL_COUNT)

    def feed(self, time_s: float, raw: float) -> bool:
        """Process a raw value; return whether the axis counts as jittering from now on."""
        previous, self._latest_raw = self._latest_raw, raw
        if previous is None or abs(raw - previous) < self._min_leap:
            return False
        had_risen, self._has_risen = self._has_risen, raw > previous
        if self._has_risen is had_risen:
            return False
        self._reversals_s.append(time_s)
        times = self._reversals_s
        if len(times) < JITTER_REVERSAL_COUNT or times[-1] - times[0] > JITTER_WINDOW_S:
            return False
        self.is_jittering = True
        return True

    def step(self, now_s: float) -> None:
        if self.is_jittering and now_s - self._reversals_s[-1] >= JITTER_RECOVERY_S:
            self.is_jittering = False
            self._reversals_s.clear()


def _is_possible(raw: float) -> bool:
    return isfinite(raw) and abs(raw) <= 1.0
