"""Where the gap lies: which axis and tap, which stage of the chain, which band and regime."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects.formulation import Stage
from rotemina.sim.gap.bands import Spectrum, spectrum
from rotemina.sim.gap.blocks import Blocks, block_numbers, drawn_means, summed
from rotemina.sim.gap.evidence import Evidence, Observation
from rotemina.sim.gap.regimes import Regime, regimes
from rotemina.sim.records.record import Record, Tap

_LIKELY = 0.95  # of intervals


@dataclass(frozen=True, slots=True)
class Place:
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
    worst_band_hz : tuple of float, optional
        Where most of it lies; None where sampling does not allow to tell.
    worst_regime : Regime, optional
        Where its mean square is greatest.
    by_regime : mapping of Regime to float
        Mean square over the floor's, less one; regimes that do not occur are missing.
    """

    axis: str
    tap: Tap
    stage: Stage
    gap_rms: float
    noise_floor: float
    excess: float
    excess_interval: tuple[float, float]
    worst_band_hz: tuple[float, float] | None
    worst_regime: Regime | None
    by_regime: Mapping[Regime, float]

    @property
    def significant(self) -> bool:
        """Whether the gap is above the floor beyond doubt."""
        return self.excess_interval[0] > 0.0


def locate(evidence: Evidence, rng: np.random.Generator) -> tuple[Place, ...]:
    """Return the gap of one axis at each of its taps, in the order of the chain.

    The gap is that of the model as it stands, by the commands, without its mean over a record.
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
        places.append(_place(evidence.axis, tap, taps, seen, rng))
    return tuple(places)


def _place(
    axis: str,
    tap: Tap,
    taps: Sequence[Tap],
    seen: Sequence[tuple[Observation, FloatArray]],
    rng: np.random.Generator,
) -> Place:
    totals, rows = [], []
    for observation, gap in seen:
        record = observation.record
        numbers = block_numbers(record.time_s, record.signal(axis, Tap.CMD))
        blocks = summed(numbers, gap[:, None] ** 2)
        totals.append(blocks.total)
        rows.append(blocks.rows)
    together = Blocks(np.concatenate(totals), np.concatenate(rows))
    mean = float(together.total.sum() / together.rows.sum())
    tail = 50.0 * (1.0 - _LIKELY)
    low, high = np.percentile(drawn_means(together, rng)[:, 0], [tail, 100.0 - tail])
    floor = float(np.sqrt(np.mean([observation.floor[tap] ** 2 for observation, _ in seen])))
    by_regime = _by_regime(axis, seen)
    return Place(
        axis=axis,
        tap=tap,
        stage=_stage(tap, taps),
        gap_rms=floor * float(np.sqrt(mean)),
        noise_floor=floor,
        excess=mean - 1.0,
        excess_interval=(float(low) - 1.0, float(high) - 1.0),
        worst_band_hz=_worst_band(seen),
        worst_regime=max(by_regime, key=lambda regime: by_regime[regime], default=None),
        by_regime=by_regime,
    )


def _stage(tap: Tap, taps: Sequence[Tap]) -> Stage:
    """Return the stage that a tap speaks of first, given those that lie before it."""
    if tap is Tap.U:
        return Stage.ELECTRONICS
    if tap is Tap.MEAS and Tap.REF in taps:
        return Stage.SENSOR
    return Stage.ACTUATOR


def _by_regime(axis: str, seen: Sequence[tuple[Observation, FloatArray]]) -> dict[Regime, float]:
    squares = dict.fromkeys(Regime, 0.0)
    rows = dict.fromkeys(Regime, 0)
    for observation, gap in seen:
        record = observation.record
        command = record.signal(axis, Tap.CMD)
        for regime, own in regimes(record.time_s, command, others_move(record, axis)).items():
            squares[regime] += float(np.sum(gap[own] ** 2))
            rows[regime] += int(own.sum())
    return {regime: squares[regime] / rows[regime] - 1.0 for regime in Regime if rows[regime]}


def others_move(record: Record, axis: str) -> BoolArray:
    """Tell (n,) where another axis is under way."""
    moving = np.zeros(len(record.time_s), dtype=np.bool_)
    for other in record.axes:
        if other != axis and record.has(other, Tap.CMD):
            command = record.signal(other, Tap.CMD)
            moving |= np.diff(command, prepend=command[0]) != 0.0
    return moving


def _worst_band(
    seen: Sequence[tuple[Observation, FloatArray]],
) -> tuple[float, float] | None:
    found: list[tuple[float, Spectrum]] = []
    for observation, gap in seen:
        own = spectrum(observation.record.time_s, gap)
        if own is not None:
            found.append((float(own.power.max()), own))
    return max(found, key=lambda entry: entry[0])[1].worst_hz if found else None
