"""Excitations at constant speed: triangle, decaying triangle, and sweeps at several speeds.

Corners are parabolas at the maximum acceleration of the axis, or sharp if none is declared.
"""

from dataclasses import dataclass
from math import floor, inf, sqrt
from typing import ClassVar

import numpy as np

from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation.axis_draft import AxisDraft, AxisSignal
from rotemina.sim.excitation.moves import compute_cruise_speed, compute_longest_stroke
from rotemina.sim.excitation.moves_and_holds import AxisPath
from rotemina.sim.excitation.quantity import Amount, CapabilityShare, check_positive
from rotemina.sim.messages import marked
from rotemina.sim.units import format_exact

# At least this fraction of the stroke of a sweep is at constant speed.
_MIN_CRUISE_SHARE = 0.5
# Default speeds, as fractions of the fastest one.
_DEFAULT_SPEED_SHARES = (1.0, 1 / 3, 0.1)
# By default, the fastest sweep takes at least this long.
_MIN_DEFAULT_SWEEP_S = 1.0
# The fastest default speed is this fraction of the speed limit.
_MAX_DEFAULT_SPEED_SHARE = 0.9


@dataclass(frozen=True, slots=True, kw_only=True)
class TriangleExcitation:
    """A triangle from the lowest point up and down at constant speed, in whole periods.

    There are 3 periods by default. The peaks have the requested amplitude. If corners are rounded,
    the speed between them is a little more than ``4·amplitude·frequency``. The amplitude is reduced
    to respect the limits of speed and acceleration.
    """

    kind: ClassVar[str] = "triangle"
    amplitude: Amount | None = None
    offset: Amount | None = None
    frequency_hz: float | None = None
    duration_s: float | None = None
    periodic: bool = False

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        check_positive(frequency_hz=self.frequency_hz, duration_s=self.duration_s)
        requested_hz = self.frequency_hz or draft.compute_default_hz(self.amplitude)
        half_rows, frequency = _divide_period(
            draft, requested_hz, 2, is_requested=self.frequency_hz is not None
        )
        cycles = max(1, round((self.duration_s or 3.0 / frequency) * frequency))
        draft.count_rows(cycles / frequency)
        # A periodic record ends one row before a corner, and must come to rest within that row.
        acceleration = draft.acceleration / (1.5 if self.periodic else 1.0)
        stroke = compute_longest_stroke(half_rows / draft.rate_hz, draft.speed, acceleration)
        offset = draft.choose_offset(self.offset)
        amplitude = draft.choose_amplitude(
            self.amplitude, offset, {draft.describe_stroke_limits(): stroke / 2.0}
        )
        low, high = offset - amplitude, offset + amplitude
        path = AxisPath(draft, low, acceleration)
        path.move(high, half_rows)
        path.move(low, half_rows)
        one_period = path.values
        values = np.tile(one_period[:-1], cycles)
        if not self.periodic:
            values = np.append(values, low)
        slope = _describe_slope(draft, 2.0 * amplitude, half_rows, acceleration)
        period = 2 * half_rows if self.periodic else None
        return draft.make_signal(values, period, frequency_hz=frequency, cycles=cycles, **slope)


@dataclass(frozen=True, slots=True, kw_only=True)
class DecayingTriangleExcitation:
    """Swings about the offset whose extremes decrease evenly to 0; ``growing`` reverses the motion.

    The motion begins and ends at the offset. Each of the 2·cycles swings takes half a period, so
    that smaller amplitudes have lower speeds. ``duration_s`` is 6 periods by default.
    """

    kind: ClassVar[str] = "decaying-triangle"
    amplitude: Amount | None = None
    offset: Amount | None = None
    frequency_hz: float | None = None
    duration_s: float | None = None
    growing: bool = False

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        check_positive(frequency_hz=self.frequency_hz, duration_s=self.duration_s)
        requested_hz = self.frequency_hz or draft.compute_default_hz(self.amplitude)
        quarter_rows, frequency = _divide_period(
            draft, requested_hz, 4, is_requested=self.frequency_hz is not None
        )
        cycles = max(1, round((self.duration_s or 6.0 / frequency) * frequency))
        draft.count_rows(cycles / frequency)
        swings = 2 * cycles
        offset = draft.choose_offset(self.offset)
        stroke = compute_longest_stroke(
            2 * quarter_rows / draft.rate_hz, draft.speed, draft.acceleration
        )
        first_amplitude = compute_longest_stroke(
            quarter_rows / draft.rate_hz, draft.speed, draft.acceleration
        )
        max_amplitude = min(first_amplitude, stroke / (2.0 - 1.0 / swings))
        amplitude = draft.choose_amplitude(
            self.amplitude, offset, {draft.describe_stroke_limits(): max_amplitude}
        )
        extremes = amplitude * (1.0 - np.arange(swings) / swings) * (-1.0) ** np.arange(swings)
        path = AxisPath(draft, offset)
        for index, extreme in enumerate(extremes.tolist()):
            path.move(offset + extreme, quarter_rows if index == 0 else 2 * quarter_rows)
        path.move(offset, quarter_rows)
        values = path.values[::-1].copy() if self.growing else path.values
        parameters = {"frequency_hz": frequency, "cycles": cycles, "growing": self.growing}
        return draft.make_signal(values, **parameters)


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepsExcitation:
    """Moves up and down at each of several constant speeds (m/s or rad/s), with rests between them.

    A ``CapabilityShare`` is a fraction of the speed limit, or of the range per second if none is
    declared. A speed above the limit is reduced to it. A speed is also reduced if less than half of
    the stroke would be at constant speed. Strokes are shortened by less than a row, so that the
    speeds are exact.
    """

    kind: ClassVar[str] = "sweeps"
    amplitude: Amount | None = None
    offset: Amount | None = None
    speeds: tuple[Amount, ...] = ()
    hold_s: float = 0.5

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        check_positive(hold_s=self.hold_s)
        offset = draft.choose_offset(self.offset)
        amplitude = draft.choose_amplitude(self.amplitude, offset)
        speeds = self._choose_speeds(draft, 2.0 * amplitude)
        path = AxisPath(draft, offset - amplitude)
        path.hold(self.hold_s)
        for speed in speeds:
            self._add_sweep(draft, path, speed, 2.0 * amplitude)
        speed_parameter = {
            f"speeds_{draft.unit}_per_s": " ".join(f"{speed:.9g}" for speed in speeds)
        }
        return draft.make_signal(path.values, **speed_parameter, hold_s=self.hold_s)

    def _choose_speeds(self, draft: AxisDraft, stroke: float) -> list[float]:
        unit = f"{draft.unit}/s"
        limits = {
            marked("engine", "constant speed over half the stroke"): sqrt(
                _MIN_CRUISE_SHARE * stroke * draft.acceleration
            )
        }
        if draft.speed < inf:
            limits[draft.describe_speed_limit()] = draft.speed
        limits[marked("engine", "at least one row at constant speed")] = (
            _MIN_CRUISE_SHARE * stroke * draft.rate_hz
        )
        if not self.speeds:
            fastest = min(
                _MAX_DEFAULT_SPEED_SHARE * draft.speed,
                stroke / _MIN_DEFAULT_SWEEP_S,
                *limits.values(),
            )
            return [fastest * share for share in _DEFAULT_SPEED_SHARES]
        requested = [
            amount.of_whole * draft.get_top_speed()
            if isinstance(amount, CapabilityShare)
            else amount
            for amount in self.speeds
        ]
        for speed in requested:
            if not 0 < speed < inf:
                raise ExcitationRequestError(
                    "axis {axis}: speed {speed} must be above 0",
                    axis=draft.axis,
                    speed=format_exact(speed, unit),
                )
        return [draft.limit_value("speed", speed, limits, unit) for speed in requested]

    def _add_sweep(self, draft: AxisDraft, path: AxisPath, speed: float, stroke: float) -> None:
        ramp_s = speed / draft.acceleration
        duration = stroke / speed + ramp_s
        rows = floor(duration * draft.rate_hz + 1e-9) if duration * draft.rate_hz < 1e12 else 10**12
        exact_stroke = speed * (rows / draft.rate_hz - ramp_s)
        low = path.end
        for end in (low + min(exact_stroke, stroke), low):
            path.move(end, rows)
            path.hold(self.hold_s)


def _divide_period(
    draft: AxisDraft, requested_hz: float, parts: int, *, is_requested: bool
) -> tuple[int, float]:
    """Return the rows in each of ``parts`` equal parts of a period, and the frequency used, Hz."""
    draft.check_frequency("frequency", requested_hz)
    rows = draft.count_rows(1.0 / (parts * requested_hz))
    frequency = draft.rate_hz / (parts * rows)
    if is_requested:
        draft.note_rounding(
            "frequency",
            requested_hz,
            frequency,
            "Hz",
            marked("engine", "whole rows between the corners"),
        )
    return rows, frequency


def _describe_slope(
    draft: AxisDraft, stroke: float, rows: int, acceleration: float
) -> dict[str, float]:
    speed = compute_cruise_speed(stroke, rows / draft.rate_hz, acceleration)
    return {f"speed_{draft.unit}_per_s": speed, "corner_s": 2.0 * speed / acceleration}
