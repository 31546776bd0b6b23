"""Excitations at constant speed: triangle, decaying triangle and sweeps at several speeds.

Corners are parabolas at the axis' greatest acceleration, and sharp where none is declared.
"""

from dataclasses import dataclass
from math import floor, inf, sqrt
from typing import ClassVar

import numpy as np

from rotemina.sim.excitation.axis_draft import Draft, Signal
from rotemina.sim.excitation.moves import cruise_speed, longest_stroke
from rotemina.sim.excitation.moves_and_holds import Path
from rotemina.sim.excitation.quantity import Amount, ExcitationError, Share, check_positive
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import exact

_CRUISE = 0.5  # of a sweep's stroke at least is at constant speed
_SPEEDS = (1.0, 1 / 3, 0.1)  # of the greatest, where none are asked
_SWEEP_S = 1.0  # by default the fastest sweep takes this long or longer
_HEADROOM = 0.9  # of the speed limit is the greatest default speed


@dataclass(frozen=True, slots=True, kw_only=True)
class Triangle:
    """From the lowest point up and down at constant speed, whole periods (3 by default).

    Peaks are at the amplitude asked for; where corners are rounded, the speed between them is a
    little more than ``4·amplitude·frequency``. The amplitude gives way to speed and acceleration.
    """

    kind: ClassVar[str] = "triangle"
    amplitude: Amount | None = None
    offset: Amount | None = None
    frequency_hz: float | None = None
    duration_s: float | None = None
    periodic: bool = False

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        check_positive(frequency_hz=self.frequency_hz, duration_s=self.duration_s)
        asked = self.frequency_hz or draft.default_hz(self.amplitude)
        half, frequency = _part_of_period(draft, asked, 2, stated=self.frequency_hz is not None)
        cycles = max(1, round((self.duration_s or 3.0 / frequency) * frequency))
        draft.rows(cycles / frequency)
        # A periodic record ends a row before its corner, from where it must stop in one row.
        acceleration = draft.acceleration / (1.5 if self.periodic else 1.0)
        stroke = longest_stroke(half / draft.rate_hz, draft.speed, acceleration)
        offset = draft.offset(self.offset)
        amplitude = draft.amplitude(self.amplitude, offset, {draft.stroke_cause(): stroke / 2.0})
        low, high = offset - amplitude, offset + amplitude
        path = Path(draft, low, acceleration)
        path.move(high, half)
        path.move(low, half)
        one = path.values
        values = np.tile(one[:-1], cycles)
        if not self.periodic:
            values = np.append(values, low)
        slope = _slope(draft, 2.0 * amplitude, half, acceleration)
        period = 2 * half if self.periodic else None
        return draft.signal(values, period, frequency_hz=frequency, cycles=cycles, **slope)


@dataclass(frozen=True, slots=True, kw_only=True)
class DecayingTriangle:
    """Swings about the offset whose extremes shrink evenly to nothing; ``growing`` runs backwards.

    It begins and ends at the offset. Each of the 2·cycles swings takes half a period, so slower
    speeds come with smaller amplitudes; ``duration_s`` is 6 periods by default.
    """

    kind: ClassVar[str] = "decaying-triangle"
    amplitude: Amount | None = None
    offset: Amount | None = None
    frequency_hz: float | None = None
    duration_s: float | None = None
    growing: bool = False

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        check_positive(frequency_hz=self.frequency_hz, duration_s=self.duration_s)
        asked = self.frequency_hz or draft.default_hz(self.amplitude)
        quarter, frequency = _part_of_period(draft, asked, 4, stated=self.frequency_hz is not None)
        cycles = max(1, round((self.duration_s or 6.0 / frequency) * frequency))
        draft.rows(cycles / frequency)
        swings = 2 * cycles
        offset = draft.offset(self.offset)
        stroke = longest_stroke(2 * quarter / draft.rate_hz, draft.speed, draft.acceleration)
        first = longest_stroke(quarter / draft.rate_hz, draft.speed, draft.acceleration)
        most = min(first, stroke / (2.0 - 1.0 / swings))
        amplitude = draft.amplitude(self.amplitude, offset, {draft.stroke_cause(): most})
        extremes = amplitude * (1.0 - np.arange(swings) / swings) * (-1.0) ** np.arange(swings)
        path = Path(draft, offset)
        for index, extreme in enumerate(extremes.tolist()):
            path.move(offset + extreme, quarter if index == 0 else 2 * quarter)
        path.move(offset, quarter)
        values = path.values[::-1].copy() if self.growing else path.values
        own = {"frequency_hz": frequency, "cycles": cycles, "growing": self.growing}
        return draft.signal(values, **own)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweeps:
    """Up and back down at each of several constant speeds (m/s or rad/s), with rests between.

    A share is one of the speed limit (where none is declared: of the range in a second). A speed
    gives way to the limit, and to the acceleration where less than half the stroke would be left
    at constant speed. Strokes are shortened by less than a row, so that speeds are exact.
    """

    kind: ClassVar[str] = "sweeps"
    amplitude: Amount | None = None
    offset: Amount | None = None
    speeds: tuple[Amount, ...] = ()
    hold_s: float = 0.5

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        check_positive(hold_s=self.hold_s)
        offset = draft.offset(self.offset)
        amplitude = draft.amplitude(self.amplitude, offset)
        speeds = self._speeds(draft, 2.0 * amplitude)
        path = Path(draft, offset - amplitude)
        path.hold(self.hold_s)
        for speed in speeds:
            self._there_and_back(draft, path, speed, 2.0 * amplitude)
        told = {f"speeds_{draft.unit}_per_s": " ".join(f"{speed:.9g}" for speed in speeds)}
        return draft.signal(path.values, **told, hold_s=self.hold_s)

    def _speeds(self, draft: Draft, stroke: float) -> list[float]:
        unit = f"{draft.unit}/s"
        most = {
            marked("engine", "constant speed over half the stroke"): sqrt(
                _CRUISE * stroke * draft.acceleration
            )
        }
        if draft.speed < inf:
            most[draft.speed_cause()] = draft.speed
        most[marked("engine", "a row at constant speed at least")] = (
            _CRUISE * stroke * draft.rate_hz
        )
        if not self.speeds:
            fastest = min(_HEADROOM * draft.speed, stroke / _SWEEP_S, *most.values())
            return [fastest * share for share in _SPEEDS]
        asked = [
            each.of_whole * draft.top_speed() if isinstance(each, Share) else each
            for each in self.speeds
        ]
        for speed in asked:
            if not 0 < speed < inf:
                raise ExcitationError(
                    message("engine", "axis {axis}: speed {speed} must be above 0").fill(
                        axis=draft.axis, speed=exact(speed, unit)
                    )
                )
        return [draft.limited("speed", speed, most, unit) for speed in asked]

    def _there_and_back(self, draft: Draft, path: Path, speed: float, stroke: float) -> None:
        starting = speed / draft.acceleration
        duration = stroke / speed + starting
        rows = floor(duration * draft.rate_hz + 1e-9) if duration * draft.rate_hz < 1e12 else 10**12
        exact = speed * (rows / draft.rate_hz - starting)
        low = path.end
        for end in (low + min(exact, stroke), low):
            path.move(end, rows)
            path.hold(self.hold_s)


def _part_of_period(draft: Draft, asked: float, parts: int, *, stated: bool) -> tuple[int, float]:
    """Return the whole rows in one of the equal parts of a period, and its frequency, Hz."""
    draft.check_frequency("frequency", asked)
    rows = draft.rows(1.0 / (parts * asked))
    frequency = draft.rate_hz / (parts * rows)
    if stated:
        draft.rounded(
            "frequency", asked, frequency, "Hz", marked("engine", "whole rows between its corners")
        )
    return rows, frequency


def _slope(draft: Draft, stroke: float, rows: int, acceleration: float) -> dict[str, float]:
    speed = cruise_speed(stroke, rows / draft.rate_hz, acceleration)
    return {f"speed_{draft.unit}_per_s": speed, "corner_s": 2.0 * speed / acceleration}
