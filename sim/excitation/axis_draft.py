"""A draft of the excitation of one axis: its limits, and the reductions that they require."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, isfinite, pi, sqrt

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation.moves import compute_shortest_duration
from rotemina.sim.excitation.quantity import Amount, CapabilityShare
from rotemina.sim.messages import (
    FieldList,
    Message,
    format_rounded,
    message,
)
from rotemina.sim.robot import Axis
from rotemina.sim.trajectory import compute_reachable_range
from rotemina.sim.units import format_exact

# Default amplitude, to each side of the offset, as a fraction of the range.
DEFAULT_AMPLITUDE_SHARE = 0.3
MAX_ROWS = 20_000_000
# An axis without a declared speed crosses its range in this time.
_DEFAULT_CROSSING_S = 1.0
# Amplitudes below this fraction of the range are not worth measuring.
_MIN_AMPLITUDE_SHARE = 1e-4
# Default bands end at this multiple of the natural frequency, or at this fraction of the rate.
_BAND_END_TO_RESONANCE_RATIO = 2.0
_BAND_END_TO_RATE_RATIO = 0.2
# Relative differences below this are rounding errors and not reductions.
_ROUNDING_RATIO = 1e-9


@dataclass(frozen=True, slots=True)
class ParameterAdjustment:
    """A parameter that differs from the requested value.

    Attributes
    ----------
    axis, parameter : name of the axis and of the changed parameter.
    requested, used : requested value and the value used instead, in ``unit``.
    cause : limit or rounding that required the change.
    """

    axis: str
    parameter: str
    requested: float
    used: float
    unit: str
    cause: str

    @property
    def message(self) -> Message:
        """Text with the change, its factor and its cause."""
        return message(
            "engine", "axis {axis}: {parameter} {asked} → {used} (× {factor}), for {cause}"
        ).fill(
            axis=self.axis,
            parameter=self.parameter,
            asked=format_exact(self.requested, self.unit),
            used=format_exact(self.used, self.unit, size=self.requested),
            factor=format_rounded(self.used / self.requested),
            cause=self.cause,
        )


@dataclass(frozen=True, slots=True)
class AxisSignal:
    """The commands of one axis: positions (n,), m or rad, one per row.

    ``parameters`` are those actually used. ``period`` is the number of rows after which the signal
    repeats, or None.
    """

    values: FloatArray
    parameters: Mapping[str, object]
    period: int | None = None


@dataclass(slots=True, eq=False)
class AxisDraft:
    """One axis, its limits (SI, infinite if not declared), and the adjustments so far.

    ``max_amplitude`` is the largest amplitude with which the axis is expected to stay in its range.
    ``choose_offset`` and ``choose_amplitude`` set ``chosen_offset`` and ``chosen_amplitude``. A
    ``strict`` draft raises an error where it would have to change a value.
    """

    axis: str
    unit: str
    low: float
    high: float
    span: float
    speed: float
    acceleration: float
    natural_hz: float | None
    rate_hz: float
    rng: np.random.Generator
    strict: bool = False
    max_amplitude: float = inf
    chosen_offset: float = 0.0
    chosen_amplitude: float = 0.0
    adjustments: list[ParameterAdjustment] = field(default_factory=list)

    @classmethod
    def of(
        cls,
        name: str,
        axis: Axis,
        rate_hz: float,
        rng: np.random.Generator,
        *,
        strict: bool = False,
        max_amplitude: float = inf,
    ) -> "AxisDraft":
        """Start the draft of an axis, with the part of its range that its voltage can reach."""
        low, high = compute_reachable_range(axis)
        return cls(
            axis=name,
            unit=axis.unit or "m",
            low=low,
            high=high,
            span=axis.span,
            speed=axis.max_speed or inf,
            acceleration=axis.max_acceleration or inf,
            natural_hz=compute_natural_frequency(axis),
            rate_hz=rate_hz,
            rng=rng,
            strict=strict,
            max_amplitude=max_amplitude,
        )

    def limit_value(
        self, parameter: str, requested: float, allowed: Mapping[str, float], unit: str
    ) -> float:
        """Return ``requested``, or the smallest limit in ``allowed`` if that is smaller.

        ``allowed`` maps the cause of each limit to its value.

        Raises
        ------
        ExcitationRequestError
            If the value would be reduced in a strict draft.
        """
        cause = min(allowed, key=lambda name: allowed[name])
        limit = allowed[cause]
        if requested <= limit * (1.0 + _ROUNDING_RATIO):
            return min(requested, limit)
        return self._adjust(parameter, requested, limit, unit, cause)

    def raise_to_minimum(
        self, parameter: str, requested: float, needed: float, unit: str, cause: str
    ) -> float:
        """Return ``requested``, or ``needed`` if that is larger.

        Raises
        ------
        ExcitationRequestError
            If the value would be raised in a strict draft.
        """
        if requested >= needed * (1.0 - _ROUNDING_RATIO):
            return requested
        return self._adjust(parameter, requested, needed, unit, cause)

    def note_rounding(
        self, parameter: str, requested: float, used: float, unit: str, cause: str
    ) -> float:
        """Record an adjustment if rounding changed the parameter, and return the rounded value."""
        if abs(used - requested) > 1e-6 * abs(requested):
            self.adjustments.append(
                ParameterAdjustment(self.axis, parameter, requested, used, unit, cause)
            )
        return used

    def choose_offset(self, requested: Amount | None) -> float:
        """Choose and return the centre of the motion, m or rad.

        A ``CapabilityShare`` is a fraction of the range.

        Raises
        ------
        ExcitationRequestError
            If the offset is not inside the range.
        """
        self.chosen_offset = (
            (self.low + self.high) / 2.0 if requested is None else self._resolve_offset(requested)
        )
        return self.chosen_offset

    def make_signal(
        self, values: FloatArray, period: int | None = None, /, **parameters: object
    ) -> AxisSignal:
        """Return a signal whose parameters begin with the chosen amplitude and offset."""
        common = {
            f"amplitude_{self.unit}": self.chosen_amplitude,
            f"offset_{self.unit}": self.chosen_offset,
        }
        return AxisSignal(values, common | parameters, period)

    def _resolve_offset(self, requested: Amount) -> float:
        is_fraction = isinstance(requested, CapabilityShare)
        value = (
            self.low + requested.of_whole * self.span
            if isinstance(requested, CapabilityShare)
            else requested
        )
        if not (isfinite(value) and self.low < value < self.high):
            percentage = (
                f"{format_rounded(100 * requested.of_whole, 6)} %"
                if isinstance(requested, CapabilityShare)
                else value
            )
            offset_text = (
                percentage if is_fraction else format_exact(value, self.unit, size=self.high)
            )
            raise ExcitationRequestError(
                "axis {axis}: offset {said} leaves no room to move between {low} and {high}",
                axis=self.axis,
                said=offset_text,
                low=format_exact(self.low, self.unit, size=self.high),
                high=format_exact(self.high, self.unit),
            )
        return value

    def choose_amplitude(
        self, requested: Amount | None, offset: float, allowed: Mapping[str, float] | None = None
    ) -> float:
        """Choose and return the amplitude about ``offset``, m or rad, within all limits.

        The limits are the range and ``allowed``, which maps the cause of each limit to its value.

        Raises
        ------
        ExcitationRequestError
            If the requested amplitude is not positive, or is too large in a strict draft.
        """
        distance = min(offset - self.low, self.high - offset)
        limits = {self._describe_range(): distance, **(allowed or {})}
        if self.max_amplitude < inf:
            predicted = message("engine", "{range} of the motion that the model predicts")
            limits[predicted.fill(range=self._describe_range())] = self.max_amplitude
        self.chosen_amplitude = self._resolve_amplitude(requested, limits)
        return self.chosen_amplitude

    def _resolve_amplitude(self, requested: Amount | None, limits: Mapping[str, float]) -> float:
        if requested is None:
            return min(DEFAULT_AMPLITUDE_SHARE * self.span, *limits.values())
        value = (
            requested.of_whole * self.span if isinstance(requested, CapabilityShare) else requested
        )
        if not (isfinite(value) and value > 0):
            raise ExcitationRequestError(
                "axis {axis}: amplitude {value} must be above 0",
                axis=self.axis,
                value=format_exact(value, self.unit),
            )
        return self.limit_value("amplitude", value, limits, self.unit)

    def compute_max_amplitudes(self, shape: FloatArray) -> dict[str, float]:
        """Return the largest permitted amplitude of a unit shape (n,) for each limit.

        The axis rests before and after the shape, as in the check of limits.
        """
        allowed: dict[str, float] = {}
        steps = np.diff(np.pad(shape, 1, mode="edge")) * self.rate_hz
        if self.speed < inf:
            peak = float(np.abs(steps).max())
            allowed[self.describe_speed_limit()] = self.speed / max(peak, np.finfo(np.float64).tiny)
        if self.acceleration < inf:
            # Single rows suffice: the check of limits uses averages of these over wider windows.
            peak = float(np.abs(np.diff(steps)).max()) * self.rate_hz
            allowed[self.describe_acceleration_limit()] = self.acceleration / peak
        return allowed

    def describe_stroke_limits(self) -> Message:
        """Return a text that names the limits of a move from rest to rest."""
        causes: list[str] = []
        if self.speed < inf:
            causes.append(self.describe_speed_limit())
        if self.acceleration < inf:
            causes.append(self.describe_acceleration_limit())
        if not causes:
            return message("engine", "the limits")
        return Message("", "{limits}", (("limits", FieldList(tuple(causes))),))

    def describe_speed_limit(self) -> Message:
        """Return a text that names the speed limit."""
        limit = format_exact(self.speed, self.unit + "/s")
        return message("engine", "the speed limit {limit}").fill(limit=limit)

    def describe_acceleration_limit(self) -> Message:
        """Return a text that names the acceleration limit."""
        limit = format_exact(self.acceleration, self.unit + "/s²")
        return message("engine", "the acceleration limit {limit}").fill(limit=limit)

    def get_top_speed(self) -> float:
        """Return the speed limit; if none is declared, the speed that crosses the range in 1 s."""
        return self.speed if self.speed < inf else self.span / _DEFAULT_CROSSING_S

    def compute_default_hz(self, amplitude: Amount | None) -> float:
        """Return a frequency of at most 1 Hz at which an oscillation is well within the limits.

        The oscillation has the requested amplitude.
        """
        amplitude_or_default = (
            CapabilityShare(DEFAULT_AMPLITUDE_SHARE) if amplitude is None else amplitude
        )
        amplitude_si = (
            amplitude_or_default.of_whole * self.span
            if isinstance(amplitude_or_default, CapabilityShare)
            else amplitude_or_default
        )
        stroke = min(2.0 * abs(amplitude_si), self.high - self.low)
        half_period_s = compute_shortest_duration(stroke, self.get_top_speed(), self.acceleration)
        return min(1.0, 0.25 / half_period_s) if half_period_s > 0 else 1.0

    def compute_useful_hz(self) -> float:
        """Return the highest frequency at which an excitation of this axis is still useful, Hz.

        It is the smallest of three: twice the natural frequency, a fifth of the rate, and the
        frequency at which speed or acceleration limit the amplitude to 1/10 000 of the range.
        """
        min_amplitude = _MIN_AMPLITUDE_SHARE * self.span
        by_speed = self.speed / (2.0 * pi * min_amplitude)
        by_acceleration = sqrt(self.acceleration / min_amplitude) / (2.0 * pi)
        by_resonance = (
            inf if self.natural_hz is None else _BAND_END_TO_RESONANCE_RATIO * self.natural_hz
        )
        return min(by_speed, by_acceleration, by_resonance, _BAND_END_TO_RATE_RATIO * self.rate_hz)

    def count_rows(self, duration_s: float) -> int:
        """Return a duration in rows, at least 1.

        Raises
        ------
        ExcitationRequestError
            If there would be too many rows.
        """
        if not duration_s * self.rate_hz <= MAX_ROWS:
            raise ExcitationRequestError(
                "axis {axis}: {duration_s} s at {rate_hz} Hz is more than {most_rows} rows; "
                "shorten it or lower the rate",
                axis=self.axis,
                duration_s=format_rounded(duration_s, 6),
                rate_hz=format_rounded(self.rate_hz, 6),
                most_rows=MAX_ROWS,
            )
        return max(1, round(duration_s * self.rate_hz))

    def check_frequency(self, name: str, value: float) -> None:
        """Raise an error if a frequency is too high for the rate.

        Raises
        ------
        ExcitationRequestError
            If it is half the rate or more.
        """
        if value >= self.rate_hz / 2.0:
            raise ExcitationRequestError(
                "axis {axis}: {name} {value} Hz must be below half the rate, {rate_hz} Hz",
                axis=self.axis,
                name=name,
                value=format_rounded(value, 6),
                rate_hz=format_rounded(self.rate_hz / 2.0, 6),
            )

    def _adjust(
        self, parameter: str, requested: float, used: float, unit: str, cause: str
    ) -> float:
        if self.strict:
            side = "least" if used > requested else "most"
            raise ExcitationRequestError(
                "axis {axis}: {parameter} {asked} is beyond {used}, the {side} permitted by "
                "{cause}",
                axis=self.axis,
                parameter=parameter,
                asked=format_exact(requested, unit),
                used=format_exact(used, unit, size=requested),
                side=side,
                cause=cause,
            )
        self.adjustments.append(
            ParameterAdjustment(self.axis, parameter, requested, used, unit, cause)
        )
        return used

    def _describe_range(self) -> Message:
        low = format_exact(self.low, self.unit, size=self.high or self.low)
        high = format_exact(self.high, self.unit, size=self.high or self.low)
        return message("engine", "the range {low} to {high}").fill(low=low, high=high)


def compute_natural_frequency(axis: Axis) -> float | None:
    """Return ``sqrt(stiffness/mass)/2π`` of an axis, Hz.

    Return None if the axis has no mass or no stiffness.
    """
    inertia = axis.inertia
    if inertia is None or inertia.stiffness <= 0:
        return None
    return sqrt(inertia.stiffness / inertia.mass) / (2.0 * pi)
