"""Excitations between levels: staircase, S-curve steps and PRBS."""

from dataclasses import dataclass
from math import inf
from typing import ClassVar

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation.axis_draft import AxisDraft, AxisSignal
from rotemina.sim.excitation.moves import (
    compute_longest_stroke,
    compute_shortest_duration,
    compute_shortest_quintic,
    count_rows,
    make_trapezoid,
)
from rotemina.sim.excitation.moves_and_holds import AxisPath
from rotemina.sim.excitation.quantity import Amount, CapabilityShare, check_count, check_positive
from rotemina.sim.messages import format_rounded, marked, message

_DEFAULT_RISE_S = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class StaircaseExcitation:
    """A staircase over ``levels`` even levels, up and down again, with rests of ``hold_s``.

    Between levels the axis moves as fast as the limits allow, or jumps if none are declared.
    """

    kind: ClassVar[str] = "staircase"
    amplitude: Amount | None = None
    offset: Amount | None = None
    levels: int = 6
    hold_s: float = 1.0

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        check_positive(hold_s=self.hold_s)
        check_count(2, 100_000, levels=self.levels)
        offset = draft.choose_offset(self.offset)
        amplitude = draft.choose_amplitude(self.amplitude, offset)
        up = np.linspace(offset - amplitude, offset + amplitude, self.levels).tolist()
        path = AxisPath(draft, up[0])
        path.hold(self.hold_s)
        for level in up[1:] + up[-2::-1]:
            path.move(level)
            path.hold(self.hold_s)
        return draft.make_signal(path.values, levels=self.levels, hold_s=self.hold_s)


@dataclass(frozen=True, slots=True, kw_only=True)
class StepsExcitation:
    """S-curves from the offset up, back, down and back, ``cycles`` times, with rests between them.

    Each S-curve is a minimum-jerk move of ``rise_s``, which is lengthened to respect the limits of
    speed, acceleration or ``jerk`` (m/s³ or rad/s³).
    """

    kind: ClassVar[str] = "steps"
    amplitude: Amount | None = None
    offset: Amount | None = None
    rise_s: float | None = None
    hold_s: float = 1.0
    jerk: Amount | None = None
    cycles: int = 1

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        check_positive(rise_s=self.rise_s, hold_s=self.hold_s)
        check_count(1, 100_000, cycles=self.cycles)
        jerk = self._resolve_jerk(draft)
        offset = draft.choose_offset(self.offset)
        amplitude = draft.choose_amplitude(self.amplitude, offset)
        rise = self._resolve_rise(draft, amplitude, jerk)
        path = AxisPath(draft, offset)
        path.hold(self.hold_s)
        for level in (1.0, 0.0, -1.0, 0.0) * self.cycles:
            path.move_smoothly(offset + level * amplitude, rise)
            path.hold(self.hold_s)
        return draft.make_signal(path.values, rise_s=rise, hold_s=self.hold_s, cycles=self.cycles)

    def _resolve_jerk(self, draft: AxisDraft) -> float:
        if self.jerk is None:
            return inf
        if isinstance(self.jerk, CapabilityShare) or not self.jerk > 0:
            raise ExcitationRequestError(
                "axis {axis}: jerk {jerk} must be a value above 0",
                axis=draft.axis,
                jerk=str(self.jerk),
            )
        return self.jerk

    def _resolve_rise(self, draft: AxisDraft, amplitude: float, jerk: float) -> float:
        needed = compute_shortest_quintic(amplitude, draft.speed, draft.acceleration, jerk)
        if self.rise_s is None:
            return max(_DEFAULT_RISE_S, needed)
        if needed <= self.rise_s * (1.0 + 1e-9):
            return self.rise_s
        cause = draft.describe_stroke_limits()
        if jerk < inf:
            cause = message("engine", "{limits} and the jerk").fill(limits=cause)
        return draft.raise_to_minimum("rise", self.rise_s, needed, "s", cause)


@dataclass(frozen=True, slots=True, kw_only=True)
class PrbsExcitation:
    """A pseudo-random binary sequence of maximum length, ``2**order - 1`` chips, on two levels.

    ``frequency_hz`` is the clock. The axis changes the level at the beginning of a chip, as fast as
    the limits allow; the amplitude is reduced so that a move ends within its chip. The sequence
    begins at rest, inside a random run of equal chips. ``duration_s`` is one period or more.
    """

    kind: ClassVar[str] = "prbs"
    amplitude: Amount | None = None
    offset: Amount | None = None
    frequency_hz: float | None = None
    order: int = 9
    duration_s: float | None = None
    periodic: bool = True

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        check_positive(frequency_hz=self.frequency_hz, duration_s=self.duration_s)
        check_count(3, 20, order=self.order)
        chip_rows, clock_hz = self._choose_clock(draft)
        period = (2**self.order - 1) * chip_rows
        periods = max(1, round((self.duration_s or 0.0) * draft.rate_hz / period))
        draft.count_rows(periods * period / draft.rate_hz)
        offset = draft.choose_offset(self.offset)
        stroke = compute_longest_stroke(chip_rows / draft.rate_hz, draft.speed, draft.acceleration)
        amplitude = draft.choose_amplitude(
            self.amplitude, offset, {draft.describe_stroke_limits(): stroke / 2.0}
        )
        chips = draw_sequence(self.order, draft.rng)
        values = np.tile(_make_rows(draft, offset + amplitude * chips, chip_rows), periods)
        if not self.periodic:
            values = np.append(values, values[0])
        parameters = {"frequency_hz": clock_hz, "order": self.order, "periods": periods}
        return draft.make_signal(values, period if self.periodic else None, **parameters)

    def _choose_clock(self, draft: AxisDraft) -> tuple[int, float]:
        requested_hz = self.frequency_hz or draft.compute_useful_hz()
        if requested_hz > draft.rate_hz:
            raise ExcitationRequestError(
                "axis {axis}: clock {asked} Hz must not exceed the rate {rate_hz} Hz",
                axis=draft.axis,
                asked=format_rounded(requested_hz, 6),
                rate_hz=format_rounded(draft.rate_hz, 6),
            )
        chip_rows = draft.count_rows(1.0 / requested_hz)
        clock_hz = draft.rate_hz / chip_rows
        if self.frequency_hz is not None:
            draft.note_rounding(
                "frequency", requested_hz, clock_hz, "Hz", marked("engine", "whole rows in a chip")
            )
        return chip_rows, clock_hz


def draw_sequence(order: int, rng: np.random.Generator) -> FloatArray:
    """Return a maximum-length sequence of -1 and 1.

    It begins at the third of three equal chips.
    """
    # Imported here because the import is slow.
    from scipy.signal import max_len_seq

    chips = 2.0 * max_len_seq(order)[0].astype(np.float64) - 1.0
    is_third_equal = (chips == np.roll(chips, 1)) & (chips == np.roll(chips, 2))
    return np.roll(chips, -int(rng.choice(np.flatnonzero(is_third_equal))))


def _make_rows(draft: AxisDraft, levels: FloatArray, chip_rows: int) -> FloatArray:
    """Return the rows of all chips, with moves as fast as permitted between their levels.

    A move begins with the first row of its chip. Without limits the level is reached at once.
    """
    low, high = float(levels.min()), float(levels.max())
    duration_s = compute_shortest_duration(high - low, draft.speed, draft.acceleration)
    move_rows = min(count_rows(duration_s, draft.rate_hz), chip_rows)
    rising = np.full(chip_rows, high)
    rising[:move_rows] = make_trapezoid(low, high, move_rows, draft.rate_hz, draft.acceleration)
    chips = np.repeat(levels, chip_rows).reshape(-1, chip_rows)
    previous_levels = np.roll(levels, 1)
    chips[levels > previous_levels] = rising
    chips[levels < previous_levels] = low + high - rising
    return chips.reshape(-1)
