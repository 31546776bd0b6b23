"""Where the gap lies: which axis and tap, which stage of the chain, which band and regime."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray, IntArray
from rotemina.sim.effects.formulation import Stage
from rotemina.sim.gap.fit.evidence import Evidence, Observation
from rotemina.sim.gap.fit.row_blocks import Blocks, block_numbers, drawn_means, summed
from rotemina.sim.gap.location.bands import band_edges, bands, is_even, white_shares
from rotemina.sim.gap.location.regimes import DOING, Regime, Ways, regimes
from rotemina.sim.records.record import Record, Tap

_LIKELY = 0.95  # of intervals
_LEAST_ROWS = 0.02  # of all, of a regime that a sentence names
_LEAST_BLOCKS = 8
_MOMENT_ROWS = 50  # at least
_SUDDEN = 100.0  # mean square over the floor's, that no noise has for a moment


class Portion(NamedTuple):
    """What lies in a band, or in a regime: its share of the gap's power above the floor.

    ``excess`` is its mean square over the floor's, less one; None of a band.
    """

    share: float
    share_interval: tuple[float, float]
    excess: float | None = None


@dataclass(frozen=True, slots=True)
class LocatedGap:
    """The gap of one axis at one tap, over all records.

    Attributes
    ----------
    axis, tap, stage
        The stage is the one just before the tap, as far as the taps that were measured tell.
    gap_rms, noise_floor : float
        SI; the floor is the quadratic mean of those of the records.
    excess : float
        ``(gap² − floor²) / floor²``.
    excess_interval : tuple of float
        Its 95 % interval.
    by_regime : mapping of Regime to Portion
        Those that occur. They overlap: an axis that goes forward is also fast or slow.
    by_band : mapping of (low, high), Hz, to Portion
        Empty where no record is sampled evenly.
    worst_moment : float
        The greatest mean square over the floor's in any quarter of a second or so.
    """

    axis: str
    tap: Tap
    stage: Stage
    gap_rms: float
    noise_floor: float
    excess: float
    excess_interval: tuple[float, float]
    by_regime: Mapping[Regime, Portion]
    by_band: Mapping[tuple[float, float], Portion]
    worst_moment: float = 0.0

    @property
    def worst_band_hz(self) -> tuple[float, float] | None:
        """The band that holds most; None where sampling does not allow to tell."""
        return max(self.by_band, key=lambda band: self.by_band[band].share, default=None)

    @property
    def worst_regime(self) -> Regime | None:
        """The regime with the largest mean square, among those that the axis was often in."""
        excess = {
            regime: self.by_regime[regime].excess or 0.0
            for regime in DOING
            if regime in self.by_regime and self._rows(self.by_regime[regime]) >= _LEAST_ROWS
        }
        return max(excess, key=lambda regime: excess[regime], default=None)

    def _rows(self, portion: Portion) -> float:
        """Return the share of all rows that a portion has, by its shares of the power."""
        if not portion.excess or portion.excess < 0.0:
            return 1.0  # which does not tell, and is no maximum
        return portion.share * max(self.excess, 0.0) / portion.excess

    @property
    def significant(self) -> bool:
        """Whether the gap is above the floor beyond doubt, whichever moments were recorded."""
        return self.excess_interval[0] > 0.0

    @property
    def sudden(self) -> bool:
        """Whether it is so at some moment, though it may be the only one."""
        return self.worst_moment > _SUDDEN


def locate(evidence: Evidence, rng: np.random.Generator) -> tuple[LocatedGap, ...]:
    """Return the gap of one axis at each of its taps, in the order of the chain.

    The gap is that of the original model, driven by the commands, without its mean over a record.
    """
    gaps = evidence.gaps()
    taps = [tap for tap in Tap if any(tap in gap for gap in gaps)]
    places = []
    for tap in taps:
        seen = [
            (observation, gap[tap])
            for observation, gap in zip(evidence.observations, gaps, strict=True)
            if tap in gap
        ]
        places.append(_place(evidence, tap, taps, seen, rng))
    return tuple(places)


def _place(
    evidence: Evidence,
    tap: Tap,
    taps: Sequence[Tap],
    seen: Sequence[tuple[Observation, FloatArray]],
    rng: np.random.Generator,
) -> LocatedGap:
    axis = evidence.axis
    even = [observation.record for observation, _ in seen if is_even(observation.record)]
    edges_hz = band_edges(even) if even else np.zeros(1)
    described = evidence.robot.axes[axis]
    ways = Ways.of([one.record.signal(axis, Tap.CMD) for one, _ in seen], described)
    records = [observation.record for observation, _ in seen]
    numbers = [block_numbers(one.time_s, one.signal(axis, Tap.CMD)) for one in records]
    if sum(int(own.max()) + 1 for own in numbers) < _LEAST_BLOCKS:
        # So few do not tell by being drawn how sure they are.
        numbers = [
            block_numbers(one.time_s, one.signal(axis, Tap.CMD), cut_holds=True) for one in records
        ]
    parts = [
        _squares(observation.record, axis, gap, edges_hz, ways, own)
        for (observation, gap), own in zip(seen, numbers, strict=True)
    ]
    together = Blocks(
        np.concatenate([one.total for one in parts]), np.concatenate([one.rows for one in parts])
    )
    mean = together.total.sum(axis=0) / together.rows.sum()
    drawn = drawn_means(together, rng)
    tail = 50.0 * (1.0 - _LIKELY)
    low, high = np.percentile(drawn[:, 0], [tail, 100.0 - tail])
    floor = float(np.sqrt(np.mean([observation.floor[tap] ** 2 for observation, _ in seen])))
    portions = _portions(mean, drawn)
    moments = together.total[:, 0] / np.maximum(together.rows, _MOMENT_ROWS)
    regime_portions, band_portions = portions[: len(Regime)], portions[len(Regime) :]
    return LocatedGap(
        axis=axis,
        tap=tap,
        stage=_stage(tap, taps),
        gap_rms=floor * float(np.sqrt(mean[0])),
        noise_floor=floor,
        excess=float(mean[0]) - 1.0,
        excess_interval=(float(low) - 1.0, float(high) - 1.0),
        by_regime={
            regime: one
            for regime, one in zip(Regime, regime_portions, strict=True)
            if one.excess is not None
        },
        by_band={
            (float(begin), float(end)): one._replace(excess=None)
            for (begin, end), one in zip(pairwise(edges_hz), band_portions, strict=True)
        },
        worst_moment=float(moments.max()),
    )


def _squares(
    record: Record,
    axis: str,
    gap: FloatArray,
    edges_hz: FloatArray,
    ways: Ways,
    numbers: IntArray,
) -> Blocks:
    """Return sums over blocks of the squared gap, in total and by regime and band.

    The same sums for white noise of variance 1 follow.
    """
    command = record.signal(axis, Tap.CMD)
    own = regimes(record.time_s, command, others_move(record, axis), ways)
    masks = np.stack([own[regime] for regime in Regime], axis=1)
    split = np.zeros((len(gap), len(edges_hz) - 1))
    noise = np.zeros(len(edges_hz) - 1)
    if len(noise) and is_even(record):
        split = bands(record.time_s, gap, edges_hz).T ** 2
        noise = white_shares(record.time_s, edges_hz)
    columns = [
        gap[:, None] ** 2,
        gap[:, None] ** 2 * masks,
        split,
        masks.astype(np.float64),
        np.tile(noise, (len(gap), 1)),
    ]
    return summed(numbers, np.hstack(columns))


def _portions(mean: FloatArray, drawn: FloatArray) -> list[Portion]:
    """Return the portions of regimes and bands: means (c,) and drawn ones (draws, c)."""
    count = (len(mean) - 1) // 2
    above, noise = mean[1 : 1 + count], mean[1 + count :]
    share = (above - noise) / max(float(mean[0]) - 1.0, 1e-12)
    own = drawn[:, 1 : 1 + count] - drawn[:, 1 + count :]
    shares = own / np.maximum(drawn[:, :1] - 1.0, 1e-12)
    tail = 50.0 * (1.0 - _LIKELY)
    low, high = np.clip(np.percentile(shares, [tail, 100.0 - tail], axis=0), 0.0, 1.0)
    return [
        Portion(
            float(np.clip(share[k], 0.0, 1.0)),
            (float(low[k]), float(high[k])),
            float(above[k] / noise[k]) - 1.0 if noise[k] > 0.0 else None,
        )
        for k in range(count)
    ]


def _stage(tap: Tap, taps: Sequence[Tap]) -> Stage:
    """Return the stage that a tap speaks of first, given those that lie before it."""
    if tap is Tap.U:
        return Stage.ELECTRONICS
    if tap is Tap.MEAS and Tap.REF in taps:
        return Stage.SENSOR
    return Stage.ACTUATOR


def others_move(record: Record, axis: str) -> BoolArray:
    """Tell (n,) where another axis is under way."""
    moving = np.zeros(len(record.time_s), dtype=np.bool_)
    for other in record.axes:
        if other != axis and record.has(other, Tap.CMD):
            command = record.signal(other, Tap.CMD)
            moving |= np.diff(command, prepend=command[0]) != 0.0
    return moving
