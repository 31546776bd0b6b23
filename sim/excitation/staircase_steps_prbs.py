"""Excitations between levels: staircase, S-curve steps and PRBS."""

from dataclasses import dataclass
from math import inf
from typing import ClassVar

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.excitation.axis_draft import Draft, Signal
from rotemina.sim.excitation.moves import (
    longest_stroke,
    rows_of,
    shortest_duration,
    shortest_quintic,
    trapezoid,
)
from rotemina.sim.excitation.moves_and_holds import Path
from rotemina.sim.excitation.quantity import (
    Amount,
    ExcitationError,
    Share,
    check_count,
    check_positive,
)
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import rounded

_RISE_S = 0.02  # of a step, where nothing is asked


@dataclass(frozen=True, slots=True, kw_only=True)
class Staircase:
    """From the lowest of ``levels`` even levels up and down again, resting ``hold_s`` on each.

    It goes from level to level as fast as the limits allow, and jumps where none are declared.
    """

    kind: ClassVar[str] = "staircase"
    amplitude: Amount | None = None
    offset: Amount | None = None
    levels: int = 6
    hold_s: float = 1.0

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        check_positive(hold_s=self.hold_s)
        check_count(2, 100_000, levels=self.levels)
        offset = draft.offset(self.offset)
        amplitude = draft.amplitude(self.amplitude, offset)
        up = np.linspace(offset - amplitude, offset + amplitude, self.levels).tolist()
        path = Path(draft, up[0])
        path.hold(self.hold_s)
        for level in up[1:] + up[-2::-1]:
            path.move(level)
            path.hold(self.hold_s)
        return draft.signal(path.values, levels=self.levels, hold_s=self.hold_s)


@dataclass(frozen=True, slots=True, kw_only=True)
class Steps:
    """S-curves from the offset up, back, down and back, ``cycles`` times, with rests between.

    Each is a minimum-jerk move in ``rise_s``; that grows where speed, acceleration or ``jerk``
    (m/s³ or rad/s³) ask for more.
    """

    kind: ClassVar[str] = "steps"
    amplitude: Amount | None = None
    offset: Amount | None = None
    rise_s: float | None = None
    hold_s: float = 1.0
    jerk: Amount | None = None
    cycles: int = 1

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        check_positive(rise_s=self.rise_s, hold_s=self.hold_s)
        check_count(1, 100_000, cycles=self.cycles)
        jerk = self._jerk(draft)
        offset = draft.offset(self.offset)
        amplitude = draft.amplitude(self.amplitude, offset)
        rise = self._rise(draft, amplitude, jerk)
        path = Path(draft, offset)
        path.hold(self.hold_s)
        for way in (1.0, 0.0, -1.0, 0.0) * self.cycles:
            path.curve(offset + way * amplitude, rise)
            path.hold(self.hold_s)
        return draft.signal(path.values, rise_s=rise, hold_s=self.hold_s, cycles=self.cycles)

    def _jerk(self, draft: Draft) -> float:
        if self.jerk is None:
            return inf
        if isinstance(self.jerk, Share) or not self.jerk > 0:
            raise ExcitationError(
                message("engine", "axis {axis}: jerk {jerk} must be a value above 0").fill(
                    axis=draft.axis, jerk=str(self.jerk)
                )
            )
        return self.jerk

    def _rise(self, draft: Draft, amplitude: float, jerk: float) -> float:
        needed = shortest_quintic(amplitude, draft.speed, draft.acceleration, jerk)
        if self.rise_s is None:
            return max(_RISE_S, needed)
        if needed <= self.rise_s * (1.0 + 1e-9):
            return self.rise_s
        cause = draft.stroke_cause()
        if jerk < inf:
            cause = message("engine", "{limits} and the jerk").fill(limits=cause)
        return draft.at_least("rise", self.rise_s, needed, "s", cause)


@dataclass(frozen=True, slots=True, kw_only=True)
class Prbs:
    """A pseudo-random binary sequence of maximum length, ``2**order - 1`` chips, on two levels.

    ``frequency_hz`` is the clock. Between levels the axis moves at the chip's beginning as fast
    as limits allow; the amplitude gives way so that a move ends within its chip. The sequence
    begins at rest, inside a run of equal chips drawn by lot. ``duration_s`` is one period or more.
    """

    kind: ClassVar[str] = "prbs"
    amplitude: Amount | None = None
    offset: Amount | None = None
    frequency_hz: float | None = None
    order: int = 9
    duration_s: float | None = None
    periodic: bool = True

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        check_positive(frequency_hz=self.frequency_hz, duration_s=self.duration_s)
        check_count(3, 20, order=self.order)
        chip, clock = self._clock(draft)
        period = (2**self.order - 1) * chip
        periods = max(1, round((self.duration_s or 0.0) * draft.rate_hz / period))
        draft.rows(periods * period / draft.rate_hz)
        offset = draft.offset(self.offset)
        stroke = longest_stroke(chip / draft.rate_hz, draft.speed, draft.acceleration)
        amplitude = draft.amplitude(self.amplitude, offset, {draft.stroke_cause(): stroke / 2.0})
        chips = sequence(self.order, draft.rng)
        values = np.tile(_rows(draft, offset + amplitude * chips, chip), periods)
        if not self.periodic:
            values = np.append(values, values[0])
        own = {"frequency_hz": clock, "order": self.order, "periods": periods}
        return draft.signal(values, period if self.periodic else None, **own)

    def _clock(self, draft: Draft) -> tuple[int, float]:
        asked = self.frequency_hz or draft.useful_hz()
        if asked > draft.rate_hz:
            raise ExcitationError(
                message(
                    "engine", "axis {axis}: clock {asked} Hz must not exceed the rate {rate_hz} Hz"
                ).fill(axis=draft.axis, asked=rounded(asked, 6), rate_hz=rounded(draft.rate_hz, 6))
            )
        chip = draft.rows(1.0 / asked)
        clock = draft.rate_hz / chip
        if self.frequency_hz is not None:
            draft.rounded("frequency", asked, clock, "Hz", marked("engine", "whole rows in a chip"))
        return chip, clock


def sequence(order: int, rng: np.random.Generator) -> FloatArray:
    """Return a maximum-length sequence of -1 and 1, begun at the third of equal chips."""
    from scipy.signal import max_len_seq  # takes its time to import

    chips = 2.0 * max_len_seq(order)[0].astype(np.float64) - 1.0
    inside = (chips == np.roll(chips, 1)) & (chips == np.roll(chips, 2))
    return np.roll(chips, -int(rng.choice(np.flatnonzero(inside))))


def _rows(draft: Draft, levels: FloatArray, chip: int) -> FloatArray:
    """Return the rows of chips at ``levels``, each reached as fast as allowed from the last.

    A move's first row is its chip's; where nothing binds, the level is there at once.
    """
    low, high = float(levels.min()), float(levels.max())
    duration = shortest_duration(high - low, draft.speed, draft.acceleration)
    rows = min(rows_of(duration, draft.rate_hz), chip)
    rising = np.full(chip, high)
    rising[:rows] = trapezoid(low, high, rows, draft.rate_hz, draft.acceleration)
    chips = np.repeat(levels, chip).reshape(-1, chip)
    before = np.roll(levels, 1)
    chips[levels > before] = rising
    chips[levels < before] = low + high - rising
    return chips.reshape(-1)
