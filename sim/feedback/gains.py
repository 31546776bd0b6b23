"""The settings of a controller: gains, filters, limits.

The controller gives positions to ask for (m or rad; V of an axis that a force moves), so that a
proportional gain has no unit on a piezo or a stepper.
"""

from dataclasses import dataclass, fields
from enum import StrEnum
from math import inf, isfinite

from pydantic import ConfigDict

from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.messages import joined, marked, message
from rotemina.sim.quantities import Number, rounded

_STRICT = ConfigDict(extra="forbid")  # where a file is read
_AMOUNTS = ("proportional", "integral", "double_integral", "derivative", "derivative_filter_s")


class AntiWindup(StrEnum):
    """What the integral does while the output is at a limit.

    ``BACK_CALCULATION``: it is led back by what the limit cuts off, within ``tracking_s``
    (Åström and Hägglund, "Advanced PID Control" (2006), sec. 3.5). ``CONDITIONAL``: it stands
    still where it would drive the output further beyond.
    """

    BACK_CALCULATION = "back_calculation"
    CONDITIONAL = "conditional"


@dataclass(frozen=True, slots=True)
class Notch:
    """Takes a resonance out of the loop.

    Attributes
    ----------
    frequency_hz : float
    damping : float
        ζ of its poles: how wide it is.
    depth : float
        Its gain at the frequency, less than 1.
    """

    __pydantic_config__ = _STRICT
    frequency_hz: float
    damping: float = 0.7
    depth: float = 0.05

    def __post_init__(self) -> None:
        _check(
            marked("engine", "notch frequency"), self.frequency_hz, 0.0, inf, "Hz", open_below=True
        )
        _check(marked("engine", "notch damping"), self.damping, 0.0, 10.0, "", open_below=True)
        _check(marked("engine", "notch depth"), self.depth, 0.0, 1.0, "")


@dataclass(frozen=True, slots=True, kw_only=True)
class Gains:
    """Of ``u = feed-forward + P e + I ∫e dt + J ∫∫e dt² + D ė``, e behind notch and low-pass.

    Attributes
    ----------
    proportional : float
        P.
    integral : float
        I, 1/s.
    double_integral : float
        J, 1/s²: leaves nothing of a disturbance that grows evenly, as creep and the flanks of a
        hysteresis do under a ramp.
    derivative : float
        D, s.
    derivative_filter_s : float
        Time constant of the first-order filter of ė.
    low_pass_hz : float, optional
        Of second order.
    notch : Notch, optional
    anti_windup : AntiWindup
    tracking_s : float
        Of the back-calculation.
    """

    __pydantic_config__ = _STRICT
    proportional: float = 0.0
    integral: float = 0.0
    double_integral: float = 0.0
    derivative: float = 0.0
    derivative_filter_s: float = 0.0
    low_pass_hz: float | None = None
    notch: Notch | None = None
    anti_windup: AntiWindup = AntiWindup.BACK_CALCULATION
    tracking_s: float = 0.01

    def __post_init__(self) -> None:
        for field in fields(self):
            if field.name in _AMOUNTS:
                _check(field.name, getattr(self, field.name), 0.0, inf, "")
        _check("tracking_s", self.tracking_s, 0.0, inf, "s", open_below=True)
        if self.low_pass_hz is not None:
            _check("low_pass_hz", self.low_pass_hz, 0.0, inf, "Hz", open_below=True)


@dataclass(frozen=True, slots=True)
class OutputLimits:
    """Between what, and how fast, the output may move.

    Attributes
    ----------
    low, high : float
        m or rad (V of an axis that a force moves).
    rate : float
        Greatest change per second.
    """

    low: float = -inf
    high: float = inf
    rate: float = inf

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise FeedbackError(
                message(
                    "engine", "output limits: low {low}, high {high}: low must be less than high"
                ).fill(low=self.low, high=self.high)
            )
        if not self.rate > 0.0:
            raise FeedbackError(
                message("engine", "output limits: rate {rate} per s: must be more than 0").fill(
                    rate=self.rate
                )
            )


def _check(
    name: str, value: float, low: float, high: float, unit: str, *, open_below: bool = False
) -> None:
    if isfinite(value) and low <= value <= high and not (open_below and value == low):
        return
    template = (
        message("engine", "{name} {value}: must be finite, more than {low}")
        if open_below
        else message("engine", "{name} {value}: must be finite, at least {low}")
    )
    bound = template.fill(name=name, value=Number(f"{rounded(value, 6)} {unit}".rstrip()), low=low)
    if isfinite(high):
        most = message("engine", "at most {high}").fill(high=high)
        raise FeedbackError(joined((bound, most), ", "))
    raise FeedbackError(bound)
