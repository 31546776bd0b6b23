"""A draft of one axis' excitation: the limits of the axis, and the reductions to fit."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, isfinite, pi, sqrt

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.excitation.moves import shortest_duration
from rotemina.sim.excitation.quantity import Amount, ExcitationError, Share
from rotemina.sim.messages import Listed, Message, message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.robot.model import Axis
from rotemina.sim.trajectory.axis_limits import reachable

AMPLITUDE = 0.3  # of the range, to each side, where nothing is asked
MOST_ROWS = 20_000_000
_CROSSING_S = 1.0  # an axis without declared speed is not asked to cross its range faster
_SMALLEST = 1e-4  # of the range: an amplitude that is still worth measuring
_PER_RESONANCE = 2.0  # default bands end at this multiple of the natural frequency
_PER_RATE = 0.2  # and at this share of the rate at the latest
_ROUNDING = 1e-9  # relative: less is no reduction


@dataclass(frozen=True, slots=True)
class Adjustment:
    """A parameter that is not as asked: ``asked`` and ``used`` in ``unit``, and the ``cause``."""

    axis: str
    parameter: str
    asked: float
    used: float
    unit: str
    cause: str

    @property
    def message(self) -> Message:
        """What changed, by how much, and why."""
        return message(
            "engine", "axis {axis}: {parameter} {asked} → {used} (× {factor}), for {cause}"
        ).fill(
            axis=self.axis,
            parameter=self.parameter,
            asked=exact(self.asked, self.unit),
            used=exact(self.used, self.unit, size=self.asked),
            factor=rounded(self.used / self.asked),
            cause=self.cause,
        )


@dataclass(frozen=True, slots=True)
class Signal:
    """The commands of one axis: positions (n,) at the rate, m or rad.

    ``period`` is the rows after which it repeats, or None; ``parameters`` are those used.
    """

    values: FloatArray
    parameters: Mapping[str, object]
    period: int | None = None


@dataclass(slots=True, eq=False)
class Draft:
    """One axis, its limits (SI, infinite where undeclared) and the adjustments so far.

    ``most`` is the greatest amplitude with which the axis is expected to stay inside its range;
    ``centre`` and ``reach`` are the offset and amplitude that were given out.
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
    most: float = inf
    centre: float = 0.0
    reach: float = 0.0
    adjustments: list[Adjustment] = field(default_factory=list)

    @classmethod
    def of(
        cls,
        name: str,
        axis: Axis,
        rate_hz: float,
        rng: np.random.Generator,
        *,
        strict: bool = False,
        most: float = inf,
    ) -> "Draft":
        """Start the draft of an axis: its room is the range that its voltage reaches, too."""
        low, high = reachable(axis)
        return cls(
            axis=name,
            unit=axis.unit or "m",
            low=low,
            high=high,
            span=axis.span,
            speed=axis.max_speed or inf,
            acceleration=axis.max_acceleration or inf,
            natural_hz=natural_frequency(axis),
            rate_hz=rate_hz,
            rng=rng,
            strict=strict,
            most=most,
        )

    def limited(
        self, parameter: str, asked: float, allowed: Mapping[str, float], unit: str
    ) -> float:
        """Return ``asked``, or the least of ``allowed`` (by cause) where that is smaller.

        Raises
        ------
        ExcitationError
            In a strict draft, if it is.
        """
        cause = min(allowed, key=lambda name: allowed[name])
        most = allowed[cause]
        if asked <= most * (1.0 + _ROUNDING):
            return min(asked, most)
        return self._reduced(parameter, asked, most, unit, cause)

    def at_least(self, parameter: str, asked: float, needed: float, unit: str, cause: str) -> float:
        """Return ``asked``, or ``needed`` where that is more.

        Raises
        ------
        ExcitationError
            In a strict draft, if it is.
        """
        if asked >= needed * (1.0 - _ROUNDING):
            return asked
        return self._reduced(parameter, asked, needed, unit, cause)

    def rounded(self, parameter: str, asked: float, used: float, unit: str, cause: str) -> float:
        """Note a parameter that had to be rounded, which is no reduction; return it."""
        if abs(used - asked) > 1e-6 * abs(asked):
            self.adjustments.append(Adjustment(self.axis, parameter, asked, used, unit, cause))
        return used

    def offset(self, asked: Amount | None) -> float:
        """Return the middle of the motion, m or rad: a share is one of the range.

        Raises
        ------
        ExcitationError
            If it leaves no room to move.
        """
        self.centre = (self.low + self.high) / 2.0 if asked is None else self._stated(asked)
        return self.centre

    def signal(
        self, values: FloatArray, period: int | None = None, /, **parameters: object
    ) -> Signal:
        """Return a signal with its parameters after the amplitude and offset that were given."""
        moved = {f"amplitude_{self.unit}": self.reach, f"offset_{self.unit}": self.centre}
        return Signal(values, moved | parameters, period)

    def _stated(self, asked: Amount) -> float:
        share = isinstance(asked, Share)
        value = self.low + asked.of_whole * self.span if isinstance(asked, Share) else asked
        if not (isfinite(value) and self.low < value < self.high):
            stated = f"{rounded(100 * asked.of_whole, 6)} %" if isinstance(asked, Share) else value
            said = stated if share else exact(value, self.unit, size=self.high)
            raise ExcitationError(
                message(
                    "engine",
                    "axis {axis}: offset {said} leaves no room to move between {low} and {high}",
                ).fill(
                    axis=self.axis,
                    said=said,
                    low=exact(self.low, self.unit, size=self.high),
                    high=exact(self.high, self.unit),
                )
            )
        return value

    def amplitude(
        self, asked: Amount | None, offset: float, allowed: Mapping[str, float] | None = None
    ) -> float:
        """Return the amplitude about ``offset``, m or rad, within the range and ``allowed``.

        Raises
        ------
        ExcitationError
            If it is not positive, or in a strict draft too large.
        """
        room = min(offset - self.low, self.high - offset)
        most = {self._range_cause(): room, **(allowed or {})}
        if self.most < inf:
            predicted = message("engine", "{range} of the motion that the model predicts")
            most[predicted.fill(range=self._range_cause())] = self.most
        self.reach = self._reach(asked, most)
        return self.reach

    def _reach(self, asked: Amount | None, most: Mapping[str, float]) -> float:
        if asked is None:
            return min(AMPLITUDE * self.span, *most.values())
        value = asked.of_whole * self.span if isinstance(asked, Share) else asked
        if not (isfinite(value) and value > 0):
            raise ExcitationError(
                message("engine", "axis {axis}: amplitude {value} must be above 0").fill(
                    axis=self.axis, value=exact(value, self.unit)
                )
            )
        return self.limited("amplitude", value, most, self.unit)

    def shape_amplitudes(self, shape: FloatArray) -> dict[str, float]:
        """Return the greatest amplitudes of a unit shape (n,) by the limit that sets them.

        The shape is held before its first row and after its last, as the judge of limits does.
        """
        allowed: dict[str, float] = {}
        steps = np.diff(np.pad(shape, 1, mode="edge")) * self.rate_hz
        if self.speed < inf:
            peak = float(np.abs(steps).max())
            allowed[self.speed_cause()] = self.speed / max(peak, np.finfo(np.float64).tiny)
        if self.acceleration < inf:
            # Over single rows: wider windows, in which rounding is judged, are averages of these.
            peak = float(np.abs(np.diff(steps)).max()) * self.rate_hz
            allowed[self.acceleration_cause()] = self.acceleration / peak
        return allowed

    def stroke_cause(self) -> Message:
        """Name the limits of a move from rest to rest."""
        causes: list[str] = []
        if self.speed < inf:
            causes.append(self.speed_cause())
        if self.acceleration < inf:
            causes.append(self.acceleration_cause())
        if not causes:
            return message("engine", "the limits")
        return Message("", "{limits}", (("limits", Listed(tuple(causes))),))

    def speed_cause(self) -> Message:
        """Name the limit of speed."""
        limit = exact(self.speed, self.unit + "/s")
        return message("engine", "the speed limit {limit}").fill(limit=limit)

    def acceleration_cause(self) -> Message:
        """Name the limit of acceleration."""
        limit = exact(self.acceleration, self.unit + "/s²")
        return message("engine", "the acceleration limit {limit}").fill(limit=limit)

    def top_speed(self) -> float:
        """Return the speed limit, or where none is declared the range in a second."""
        return self.speed if self.speed < inf else self.span / _CROSSING_S

    def default_hz(self, amplitude: Amount | None) -> float:
        """Return a frequency at which a swing of the amplitude asked for is no effort, <= 1 Hz."""
        wanted = Share(AMPLITUDE) if amplitude is None else amplitude
        asked = wanted.of_whole * self.span if isinstance(wanted, Share) else wanted
        stroke = min(2.0 * abs(asked), self.high - self.low)
        half = shortest_duration(stroke, self.top_speed(), self.acceleration)
        return min(1.0, 0.25 / half) if half > 0 else 1.0

    def useful_hz(self) -> float:
        """Return up to where an excitation of this axis still says something, Hz.

        Twice its natural frequency, a fifth of the rate, and where speed or acceleration leave
        1/10 000 of the range, whichever is least.
        """
        smallest = _SMALLEST * self.span
        by_speed = self.speed / (2.0 * pi * smallest)
        by_acceleration = sqrt(self.acceleration / smallest) / (2.0 * pi)
        by_resonance = inf if self.natural_hz is None else _PER_RESONANCE * self.natural_hz
        return min(by_speed, by_acceleration, by_resonance, _PER_RATE * self.rate_hz)

    def rows(self, duration_s: float) -> int:
        """Return a duration in rows, 1 or more.

        Raises
        ------
        ExcitationError
            If there would be too many.
        """
        if not duration_s * self.rate_hz <= MOST_ROWS:
            raise ExcitationError(
                message(
                    "engine",
                    "axis {axis}: {duration_s} s at {rate_hz} Hz is more than {most_rows} rows; "
                    "shorten it or lower the rate",
                ).fill(
                    axis=self.axis,
                    duration_s=rounded(duration_s, 6),
                    rate_hz=rounded(self.rate_hz, 6),
                    most_rows=MOST_ROWS,
                )
            )
        return max(1, round(duration_s * self.rate_hz))

    def check_frequency(self, name: str, value: float) -> None:
        """Refuse a frequency that the rate cannot carry.

        Raises
        ------
        ExcitationError
            If it is half the rate or more.
        """
        if value >= self.rate_hz / 2.0:
            raise ExcitationError(
                message(
                    "engine",
                    "axis {axis}: {name} {value} Hz must be below half the rate, {rate_hz} Hz",
                ).fill(
                    axis=self.axis,
                    name=name,
                    value=rounded(value, 6),
                    rate_hz=rounded(self.rate_hz / 2.0, 6),
                )
            )

    def _reduced(self, parameter: str, asked: float, used: float, unit: str, cause: str) -> float:
        if self.strict:
            side = "least" if used > asked else "most"
            raise ExcitationError(
                message(
                    "engine",
                    "axis {axis}: {parameter} {asked} is beyond {used}, the {side} within {cause}",
                ).fill(
                    axis=self.axis,
                    parameter=parameter,
                    asked=exact(asked, unit),
                    used=exact(used, unit, size=asked),
                    side=side,
                    cause=cause,
                )
            )
        self.adjustments.append(Adjustment(self.axis, parameter, asked, used, unit, cause))
        return used

    def _range_cause(self) -> Message:
        low = exact(self.low, self.unit, size=self.high or self.low)
        high = exact(self.high, self.unit, size=self.high or self.low)
        return message("engine", "the range {low} to {high}").fill(low=low, high=high)


def natural_frequency(axis: Axis) -> float | None:
    """Return ``sqrt(stiffness/mass)/2π`` of an axis, Hz; None if it is free or static."""
    inertia = axis.inertia
    if inertia is None or inertia.stiffness <= 0:
        return None
    return sqrt(inertia.stiffness / inertia.mass) / (2.0 * pi)
