"""Location of the gap: axis and tap, stage of the signal chain, band and regime."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.effects import EffectStage
from rotemina.sim.gap.fit import (
    Blocks,
    Evidence,
    Observation,
    block_numbers,
    drawn_means,
    summed,
)
from rotemina.sim.gap.location.bands import (
    compute_white_noise_shares,
    find_band_edges,
    is_evenly_sampled,
    split_into_bands,
)
from rotemina.sim.gap.location.regimes import (
    ACTIVITY_REGIMES,
    AxisTravel,
    OperatingRegime,
    find_regimes,
)
from rotemina.sim.records import Record, Tap

_CONFIDENCE_LEVEL = 0.95
# A regime is named only if it has at least this fraction of all rows.
_MIN_ROWS_SHARE = 0.02
# With fewer blocks, resampling does not show the uncertainty.
_MIN_BLOCKS = 8
# A moment, over which squares are averaged, has at least this many rows.
_MIN_MOMENT_ROWS = 50
# Noise never reaches this ratio of the mean square during a moment to the squared floor.
_SUDDEN_POWER_RATIO = 100.0


class GapPortion(NamedTuple):
    """The portion of a gap in a band or regime: its share of the power of the gap above the floor.

    ``excess`` is the mean square in the regime over the squared floor, minus 1; None for a band.
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
        The stage is the first stage that can cause the gap, given the measured taps.
    gap_rms, noise_floor : float
        Rms of the gap and noise floor, SI. The floor is the rms of the floors of the records.
    excess : float
        ``(gap² − floor²) / floor²``.
    excess_interval : tuple of float
        Its 95 % interval.
    by_regime : mapping of OperatingRegime to GapPortion
        The regimes that occur. They overlap: an axis moving forward is also either fast or slow.
    by_band : mapping of (low, high), Hz, to GapPortion
        Empty if no record is sampled evenly.
    worst_moment : float
        The largest mean square over the squared floor, within about a quarter of a second.
    """

    axis: str
    tap: Tap
    stage: EffectStage
    gap_rms: float
    noise_floor: float
    excess: float
    excess_interval: tuple[float, float]
    by_regime: Mapping[OperatingRegime, GapPortion]
    by_band: Mapping[tuple[float, float], GapPortion]
    worst_moment: float = 0.0

    @property
    def worst_band_hz(self) -> tuple[float, float] | None:
        """The band with the largest share; None if no record is sampled evenly."""
        return max(self.by_band, key=lambda band: self.by_band[band].share, default=None)

    @property
    def worst_regime(self) -> OperatingRegime | None:
        """The regime with the largest mean square, among those with enough rows."""
        excess = {
            regime: self.by_regime[regime].excess or 0.0
            for regime in ACTIVITY_REGIMES
            if regime in self.by_regime
            and self._find_row_share(self.by_regime[regime]) >= _MIN_ROWS_SHARE
        }
        return max(excess, key=lambda regime: excess[regime], default=None)

    def _find_row_share(self, portion: GapPortion) -> float:
        if not portion.excess or portion.excess < 0.0:
            # The powers do not determine the fraction, but such a regime is never the worst one.
            return 1.0
        return portion.share * max(self.excess, 0.0) / portion.excess

    @property
    def is_significant(self) -> bool:
        """Whether the gap is certainly above the floor, and not only by chance."""
        return self.excess_interval[0] > 0.0

    @property
    def is_sudden(self) -> bool:
        """Whether the gap is certainly above the floor at some moment, even if only at one."""
        return self.worst_moment > _SUDDEN_POWER_RATIO


def locate_gap(evidence: Evidence, rng: np.random.Generator) -> tuple[LocatedGap, ...]:
    """Return the gap of one axis at each of its taps, in the order of the signal chain.

    The gap is that of the original model, driven by the commands. Its mean over each record is
    subtracted.
    """
    gaps = evidence.gaps()
    taps = [tap for tap in Tap if any(tap in gap for gap in gaps)]
    places = []
    for tap in taps:
        measured = [
            (observation, gap[tap])
            for observation, gap in zip(evidence.observations, gaps, strict=True)
            if tap in gap
        ]
        places.append(_locate_at_tap(evidence, tap, taps, measured, rng))
    return tuple(places)


def _locate_at_tap(
    evidence: Evidence,
    tap: Tap,
    taps: Sequence[Tap],
    measured: Sequence[tuple[Observation, FloatArray]],
    rng: np.random.Generator,
) -> LocatedGap:
    axis = evidence.axis
    even_records = [
        observation.record for observation, _ in measured if is_evenly_sampled(observation.record)
    ]
    edges_hz = find_band_edges(even_records) if even_records else np.zeros(1)
    model = evidence.robot.axes[axis]
    travel = AxisTravel.of(
        [observation.record.signal(axis, Tap.CMD) for observation, _ in measured], model
    )
    records = [observation.record for observation, _ in measured]
    numbers_by_record = [
        block_numbers(record.time_s, record.signal(axis, Tap.CMD)) for record in records
    ]
    if sum(int(record_numbers.max()) + 1 for record_numbers in numbers_by_record) < _MIN_BLOCKS:
        # So few blocks do not show the uncertainty, so blocks are also cut within holds.
        numbers_by_record = [
            block_numbers(record.time_s, record.signal(axis, Tap.CMD), cut_holds=True)
            for record in records
        ]
    squares_by_record = [
        _sum_squares(observation.record, axis, gap, edges_hz, travel, record_numbers)
        for (observation, gap), record_numbers in zip(measured, numbers_by_record, strict=True)
    ]
    blocks = Blocks(
        np.concatenate([squares.total for squares in squares_by_record]),
        np.concatenate([squares.rows for squares in squares_by_record]),
    )
    mean_powers = blocks.total.sum(axis=0) / blocks.rows.sum()
    resampled_means = drawn_means(blocks, rng)
    tail = 50.0 * (1.0 - _CONFIDENCE_LEVEL)
    low, high = np.percentile(resampled_means[:, 0], [tail, 100.0 - tail])
    floor = float(np.sqrt(np.mean([observation.floor[tap] ** 2 for observation, _ in measured])))
    portions = _make_portions(mean_powers, resampled_means)
    moments = blocks.total[:, 0] / np.maximum(blocks.rows, _MIN_MOMENT_ROWS)
    regime_portions, band_portions = (
        portions[: len(OperatingRegime)],
        portions[len(OperatingRegime) :],
    )
    return LocatedGap(
        axis=axis,
        tap=tap,
        stage=_find_stage(tap, taps),
        gap_rms=floor * float(np.sqrt(mean_powers[0])),
        noise_floor=floor,
        excess=float(mean_powers[0]) - 1.0,
        excess_interval=(float(low) - 1.0, float(high) - 1.0),
        by_regime={
            regime: portion
            for regime, portion in zip(OperatingRegime, regime_portions, strict=True)
            if portion.excess is not None
        },
        by_band={
            (float(begin), float(end)): portion._replace(excess=None)
            for (begin, end), portion in zip(pairwise(edges_hz), band_portions, strict=True)
        },
        worst_moment=float(moments.max()),
    )


def _sum_squares(
    record: Record,
    axis: str,
    gap: FloatArray,
    edges_hz: FloatArray,
    travel: AxisTravel,
    row_blocks: IntArray,
) -> Blocks:
    """Return the sums of the squared gap over each block: in total, by regime and by band.

    The last columns are the expected sums by regime and band for white noise of variance 1.
    """
    command = record.signal(axis, Tap.CMD)
    regimes = find_regimes(record.time_s, command, find_other_motion(record, axis), travel)
    masks = np.stack([regimes[regime] for regime in OperatingRegime], axis=1)
    band_parts = np.zeros((len(gap), len(edges_hz) - 1))
    noise_shares = np.zeros(len(edges_hz) - 1)
    if len(noise_shares) and is_evenly_sampled(record):
        band_parts = split_into_bands(record.time_s, gap, edges_hz).T ** 2
        noise_shares = compute_white_noise_shares(record.time_s, edges_hz)
    columns = [
        gap[:, None] ** 2,
        gap[:, None] ** 2 * masks,
        band_parts,
        masks.astype(np.float64),
        np.tile(noise_shares, (len(gap), 1)),
    ]
    return summed(row_blocks, np.hstack(columns))


def _make_portions(mean_powers: FloatArray, resampled_powers: FloatArray) -> list[GapPortion]:
    """Return the portions of regimes and bands from means (c,) and resampled means (draws, c).

    The columns are those of :func:`_sum_squares`.
    """
    portion_count = (len(mean_powers) - 1) // 2
    power, noise = mean_powers[1 : 1 + portion_count], mean_powers[1 + portion_count :]
    share = (power - noise) / max(float(mean_powers[0]) - 1.0, 1e-12)
    excesses = resampled_powers[:, 1 : 1 + portion_count] - resampled_powers[:, 1 + portion_count :]
    shares = excesses / np.maximum(resampled_powers[:, :1] - 1.0, 1e-12)
    tail = 50.0 * (1.0 - _CONFIDENCE_LEVEL)
    low, high = np.clip(np.percentile(shares, [tail, 100.0 - tail], axis=0), 0.0, 1.0)
    return [
        GapPortion(
            float(np.clip(share[k], 0.0, 1.0)),
            (float(low[k]), float(high[k])),
            float(power[k] / noise[k]) - 1.0 if noise[k] > 0.0 else None,
        )
        for k in range(portion_count)
    ]


def _find_stage(tap: Tap, taps: Sequence[Tap]) -> EffectStage:
    """Return the first stage that can cause a gap at a tap, given the measured taps."""
    if tap is Tap.U:
        return EffectStage.ELECTRONICS
    if tap is Tap.MEAS and Tap.REF in taps:
        return EffectStage.SENSOR
    return EffectStage.ACTUATOR


def find_other_motion(record: Record, axis: str) -> BoolArray:
    """Return the rows (n,) in which another axis moves."""
    is_moving = np.zeros(len(record.time_s), dtype=np.bool_)
    for other in record.axes:
        if other != axis and record.has(other, Tap.CMD):
            command = record.signal(other, Tap.CMD)
            is_moving |= np.diff(command, prepend=command[0]) != 0.0
    return is_moving
