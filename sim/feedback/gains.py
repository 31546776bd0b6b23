"""The settings of a controller: gains, filters, limits.

The outputs of a controller are positions (m or rad; V for an axis that a force moves), so a
proportional gain has no unit on a piezo or a stepper.
"""

from dataclasses import dataclass, fields
from enum import StrEnum
from math import inf, isfinite

from pydantic import ConfigDict

from rotemina.sim.errors import FeedbackError
from rotemina.sim.messages import (
    NumberText,
    format_rounded,
    join_messages,
    marked,
    message,
)

# Unknown keys in a file are an error.
_STRICT_CONFIG = ConfigDict(extra="forbid")
_NON_NEGATIVE_FIELDS = (
    "proportional",
    "integral",
    "double_integral",
    "derivative",
    "derivative_filter_s",
)


class AntiWindup(StrEnum):
    """Treatment of the integral while the output is at a limit.

    ``BACK_CALCULATION``: it is reduced by the excess over the limit, within ``tracking_s`` (Åström
    and Hägglund, "Advanced PID Control" (2006), sec. 3.5). ``CONDITIONAL``: it stops if it would
    drive the output further beyond the limit.
    """

    BACK_CALCULATION = "back_calculation"
    CONDITIONAL = "conditional"


@dataclass(frozen=True, slots=True)
class NotchFilter:
    """A notch filter that removes a resonance from the loop.

    Attributes
    ----------
    frequency_hz : float
    damping : float
        ζ of its poles, which sets its width.
    depth : float
        Its gain at the frequency, less than 1.
    """

    __pydantic_config__ = _STRICT_CONFIG
    frequency_hz: float
    damping: float = 0.7
    depth: float = 0.05

    def __post_init__(self) -> None:
        _check_value(
            marked("engine", "notch frequency"), self.frequency_hz, 0.0, inf, "Hz", open_below=True
        )
        _check_value(
            marked("engine", "notch damping"), self.damping, 0.0, 10.0, "", open_below=True
        )
        _check_value(marked("engine", "notch depth"), self.depth, 0.0, 1.0, "")


@dataclass(frozen=True, slots=True, kw_only=True)
class ControllerGains:
    """Gains of ``u = feed-forward + P e + I ∫e dt + J ∫∫e dt² + D ė``.

    The error e is taken after the notch and the low-pass.

    Attributes
    ----------
    proportional : float
        P.
    integral : float
        I, 1/s.
    double_integral : float
        J, 1/s². It removes the error of a disturbance that grows evenly, such as creep or the
        flanks of a hysteresis during a ramp.
    derivative : float
        D, s.
    derivative_filter_s : float
        Time constant of the first-order filter of ė.
    low_pass_hz : float, optional
        Corner frequency of a second-order low-pass.
    notch : NotchFilter, optional
    anti_windup : AntiWindup
    tracking_s : float
        Time constant of the back-calculation.
    """

    __pydantic_config__ = _STRICT_CONFIG
    proportional: float = 0.0
    integral: float = 0.0
    double_integral: float = 0.0
    derivative: float = 0.0
    derivative_filter_s: float = 0.0
    low_pass_hz: float | None = None
    notch: NotchFilter | None = None
    anti_windup: AntiWindup = AntiWindup.BACK_CALCULATION
    tracking_s: float = 0.01

    def __post_init__(self) -> None:
        for field in fields(self):
            if field.name in _NON_NEGATIVE_FIELDS:
                _check_value(field.name, getattr(self, field.name), 0.0, inf, "")
        _check_value("tracking_s", self.tracking_s, 0.0, inf, "s", open_below=True)
        if self.low_pass_hz is not None:
            _check_value("low_pass_hz", self.low_pass_hz, 0.0, inf, "Hz", open_below=True)


@dataclass(frozen=True, slots=True)
class OutputLimits:
    """Limits of the output and of its rate.

    Attributes
    ----------
    low, high : float
        m or rad (V for an axis that a force moves).
    rate : float
        Largest change per second.
    """

    low: float = -inf
    high: float = inf
    rate: float = inf

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise FeedbackError(
                "output limits: low {low}, high {high}: low must be less than high",
                low=self.low,
                high=self.high,
            )
        if not self.rate > 0.0:
            raise FeedbackError(
                "output limits: rate {rate} per s: must be more than 0", rate=self.rate
            )


def _check_value(
    name: str, value: float, low: float, high: float, unit: str, *, open_below: bool = False
) -> None:
    if isfinite(value) and low <= value <= high and not (open_below and value == low):
        return
    template = (
        message("engine", "{name} {value}: must be finite, more than {low}")
        if open_below
        else message("engine", "{name} {value}: must be finite, at least {low}")
    )
    bound = template.fill(
        name=name, value=NumberText(f"{format_rounded(value, 6)} {unit}".rstrip()), low=low
    )
    if isfinite(high):
        upper_bound = message("engine", "at most {high}").fill(high=high)
        raise FeedbackError(join_messages((bound, upper_bound), ", "))
    raise FeedbackError(bound)
