"""Drift of a sensor: coloured noise that continues at rest and follows from no signal."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.fft import dct

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects import EffectSignature
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.limits import MIN_MAJORITY_SHARE, MIN_SHARE_TO_NAME
from rotemina.sim.gap.location import probe_residual
from rotemina.sim.gap.noise.disturbances import Disturbance, resting
from rotemina.sim.messages import message
from rotemina.sim.records import Tap

_LATER_S = (0.02, 0.1, 0.5)  # over which a wander is told from a fixed offset
_LEAST_PAIRS = 50
_AT_REST = 0.3  # of the wander of all times, that rest has at least
_WHITE = 0.4  # of what is left, that is white at most
_STANDS_OUT = 1.15  # times what is white, of a change that is more
_WALKED_S = (0.1, 0.4, 1.6)
_WALKS_A_RECORD = 6  # of such times, that a record holds at least
_WALKING = 0.5  # exponent of time from which what is left walks; of a random walk: 1
_SEEN_BY_REF = 0.3  # of a wander, that the reference may see of what is left
_SLOWEST = 12  # terms of a cosine transform, that are slow
_SLOW = 0.1  # of what is not white, that lies in these
_PIECES = 64  # of the shortest record, whose means go up and down alike in what comes again
_ROUGH = 1.6  # exponent of time, with which a wander's squared change grows at most; motion: 2


@dataclass(frozen=True, slots=True)
class Wander:
    """The coloured part of a record's remainder.

    ``at_rest`` tells whether it continues at rest as a drift does, None if no rest was recorded;
    ``walks`` whether it grows with time like a random walk.
    """

    at_rest: bool | None
    walks: bool


def wandering(time_s: FloatArray, left: FloatArray, resting: BoolArray) -> Wander | None:
    """Return what of a residual (n,) over the floor may be a wander; None where it is white.

    Random walks and 1/f noise change by as much at rest, where nothing else moves a reading, and
    by less than in proportion to time.
    """
    white = _white(left)
    if white > _WHITE * float(np.mean(left**2)) or not _is_slow(left, white):
        return None
    return Wander(_goes_on(time_s, left, resting, white), _walks(time_s, left, white))


def _is_slow(left: FloatArray, white: float) -> bool:
    """Tell whether the coloured part of a residual (n,) lies in the slowest terms of a record.

    A drift does; effects of a command, a speed or a position recur with these.
    """
    power = dct(left - left.mean(), norm="ortho") ** 2
    slow = float(power[: _SLOWEST + 1].sum())
    return slow >= _SLOW * max(float(power.sum()) - len(left) * white, 0.0)


def _white(left: FloatArray) -> float:
    """Return the power of the white part of a residual (n,)."""
    return float(np.mean(np.diff(left) ** 2)) / 2.0


def _coloured(left: FloatArray) -> float:
    """Return the power of the coloured part of a residual (n,) over the floor, in excess of it."""
    return max(float(np.mean(left**2)) - max(_white(left), 1.0), 0.0)


def _rows(later_s: Sequence[float], period_s: float, least: int) -> list[int]:
    """Return after how many rows these times have passed, each number once."""
    return list(dict.fromkeys(max(round(one / period_s), least) for one in later_s))


def _walks(time_s: FloatArray, left: FloatArray, white: float) -> bool:
    period_s = float(np.median(np.diff(time_s)))
    grown = []
    for rows in _rows(_WALKED_S, period_s, least=1):
        if rows <= len(left) / _WALKS_A_RECORD:
            change = float(np.mean((left[rows:] - left[:-rows]) ** 2)) - 2.0 * white
            if change > 2.0 * (_STANDS_OUT - 1.0) * white:
                grown.append((rows, change))
    if len(grown) < 2:
        return False
    (first, small), (last, large) = grown[0], grown[-1]
    slope = float(np.log(large / small) / np.log(last / first))
    return slope > _WALKING and not _is_smooth(grown)


def _goes_on(time_s: FloatArray, left: FloatArray, resting: BoolArray, white: float) -> bool | None:
    period_s = float(np.median(np.diff(time_s)))
    rested = np.concatenate([[0], np.cumsum(~resting)])
    shares, grown = [], []
    still_white: float | None = None
    would_tell = False
    for rows in [1, *_rows(_LATER_S, period_s, least=2)]:
        if rows >= len(left):
            break
        change = (left[rows:] - left[:-rows]) ** 2
        at_rest = rested[rows + 1 :] == rested[: -rows - 1]
        if at_rest.sum() < _LEAST_PAIRS:
            break
        there = float(change[at_rest].mean())
        if still_white is None:
            still_white = there / 2.0
            continue
        then, least = there - 2.0 * still_white, 2.0 * (_STANDS_OUT - 1.0) * still_white
        ever = float(change.mean()) - 2.0 * white
        would_tell |= _AT_REST * ever > least
        if then > least:
            shares.append(then / max(ever, 1e-300))
            grown.append((rows, then))
    if not shares:
        return False if would_tell else None
    return float(np.exp(np.mean(np.log(shares)))) >= _AT_REST and not _is_smooth(grown)


def _is_smooth(grown: Sequence[tuple[int, float]]) -> bool:
    """Tell whether a squared change grows with time, from some time on, as that of a motion."""
    return any(
        float(np.log(large / small) / np.log(last / first)) > _ROUGH
        for (first, small), (last, large) in pairwise(grown)
    )


def wander(evidence: Evidence, left: FloatArray) -> Disturbance | None:
    """Return how far a sensor drifts, by the remainder (rows,) of the best explanation.

    Rest proves a drift; without rest, a reference at which the same explanation leaves nothing. If
    one record proves it, others that are too quiet or short also count. What the motion foretells,
    or what comes again in every record, is the machine's. The power is in floors of the evidence.
    """
    found = _drift(evidence, left)
    if found is None or _comes_again(evidence, left):
        return None
    unforetold = _drift(evidence, probe_residual(evidence, left, by_time=False).remainder)
    # Slow features foretell much of a walk by chance: it counts as a whole unless little is left.
    by_chance = unforetold is not None and unforetold.power > MIN_SHARE_TO_NAME * found.power
    return found if by_chance else unforetold


def _drift(evidence: Evidence, left: FloatArray) -> Disturbance | None:
    """Return what looks like a drift in a remainder (rows,), whatever foretells it."""
    total, rows, rested, walked = 0.0, 0, False, False
    for part in evidence.parts:
        if part.tap is not Tap.MEAS:
            continue
        record = evidence.observations[part.record].record
        own = wandering(record.time_s, left[part.rows], resting(record))
        rows += part.rows.stop - part.rows.start
        if own is None or own.at_rest is not False:
            total += _coloured(left[part.rows]) * (part.rows.stop - part.rows.start)
        if own is not None and own.at_rest is not False:
            rested |= own.at_rest is True
            walked |= own.walks
    proven = rested or (walked and evidence.has(Tap.REF))
    if not proven or _true_motion_left(evidence, left) > _SEEN_BY_REF * total / rows:
        return None
    note = message(
        "gap", "The reading drifts regardless of the motion, but the reference does not."
    )
    if rested:
        note = message("gap", "The reading drifts regardless of the motion, also at rest.")
    return Disturbance(EffectSignature.WANDER, Tap.MEAS, total / rows, note)


def _true_motion_left(evidence: Evidence, left: FloatArray) -> float:
    """Return the power that is left at the reference, in floors of the sensor."""
    power, rows = 0.0, 0
    for part in evidence.parts:
        floors = evidence.observations[part.record].floor
        if part.tap is Tap.REF and Tap.MEAS in floors:
            share = floors[Tap.REF] / floors[Tap.MEAS]
            power += share**2 * float(np.sum(left[part.rows] ** 2))
            rows += part.rows.stop - part.rows.start
    return power / rows if rows else 0.0


def _comes_again(evidence: Evidence, left: FloatArray) -> bool:
    """Tell whether the reading leaves much the same in every record, from its start on.

    Two random walks are alike by chance, but their steps are not; and beside a large walk, small
    steps of the machine may be alike, but the levels are not.
    """
    runs: list[tuple[FloatArray, FloatArray]] = []
    for part in evidence.parts:
        if part.tap is Tap.MEAS:
            time_s = evidence.observations[part.record].record.time_s
            runs.append((time_s - time_s[0], left[part.rows]))
    ends = np.linspace(0.0, min(float(time_s[-1]) for time_s, _ in runs), _PIECES + 1)
    levels = []
    for time_s, own in runs:
        rows = np.searchsorted(time_s, ends)
        if np.diff(rows).min() < 1:
            return False
        levels.append(np.diff(np.concatenate([[0.0], np.cumsum(own)])[rows]) / np.diff(rows))
    if len(levels) < 2:
        return False
    together = np.stack(levels)
    return _alike(together) > MIN_MAJORITY_SHARE and _alike(np.diff(together)) > MIN_MAJORITY_SHARE


def _alike(signals: FloatArray) -> float:
    """Return the mean correlation of pairs of signals (m, n)."""
    correlation = np.atleast_2d(np.corrcoef(signals))
    pairs = correlation[np.triu_indices(len(signals), 1)]
    return float(pairs.mean())
