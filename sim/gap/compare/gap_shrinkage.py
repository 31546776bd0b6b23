"""How far the gap of an axis shrinks, cause by cause, on validation data."""

from collections.abc import Callable
from itertools import combinations
from math import factorial

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.compare.explanations import Explanation
from rotemina.sim.gap.compare.rivals import paired_blocks
from rotemina.sim.gap.fit import Evidence, drawn_means
from rotemina.sim.gap.location import ResidualProbe
from rotemina.sim.gap.result import (
    GapShrinkage,
    Interval,
    ShrinkageStep,
    closed,
)
from rotemina.sim.records import Tap

_TAIL = 2.5  # percent on either side of an interval
_LEAST_GAP = 1.05  # floors below which there is no gap to close


def shrinkage(
    evidence: Evidence,
    retuned: Explanation,
    best: Explanation,
    black_box: ResidualProbe,
    tap: Tap,
    rng: np.random.Generator,
    left_by: "LeftBy",
) -> GapShrinkage:
    """Return all steps from the raw gap of a tap to its floor.

    ``left_by`` returns the remainder of a subset of the causes of ``best``.
    """
    raw = left_by(frozenset())
    floor = evidence.floor(tap)
    shown = at_tap(evidence, tap)
    share, interval = closing(evidence, raw, best.held_out, tap, rng)
    return GapShrinkage(
        axis=evidence.axis,
        tap=tap,
        raw=floor * rms(raw[shown]),
        retuned=floor * rms(retuned.held_out[shown]),
        corrected=floor * rms(best.held_out[shown]),
        floor=floor,
        ceiling=floor * rms(black_box.remainder[shown]),
        closed=share,
        closed_interval=interval,
        steps=_steps(best, shown, floor, left_by),
    )


def closing(
    evidence: Evidence, before: FloatArray, after: FloatArray, tap: Tap, rng: np.random.Generator
) -> tuple[float | None, Interval | None]:
    """Return the closed share of a gap, and its 95 % interval; None if there is no gap."""
    shown = at_tap(evidence, tap)
    was, left = float(np.mean(before[shown] ** 2)), float(np.mean(after[shown] ** 2))
    if was <= _LEAST_GAP**2:
        return None, None
    drawn = drawn_means(paired_blocks(evidence, [before, after], tap), rng)
    shares = [closed(float(b), float(a)) for b, a in drawn]
    low, high = np.percentile(shares, [_TAIL, 100.0 - _TAIL])
    share = closed(was, left)
    return share, (min(float(low), share), max(float(high), share))


def at_tap(evidence: Evidence, tap: Tap) -> np.ndarray:
    """Return which rows (rows,) of a residual are of a tap."""
    return np.concatenate(
        [np.full(part.rows.stop - part.rows.start, part.tap is tap) for part in evidence.parts]
    )


def rms(left: FloatArray) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(left**2)))


class LeftBy:
    """What some of an explanation's causes leave, as they were fitted together with the others."""

    def __init__(self, evidence: Evidence, best: Explanation) -> None:
        self._evidence, self._causes = evidence, best.causes
        whole = frozenset(range(len(best.causes)))
        self._left: dict[frozenset[int], FloatArray] = {whole: best.held_out} if whole else {}

    def __call__(self, members: frozenset[int]) -> FloatArray:
        """Return the remainder (rows,), over the floor, of the causes with these numbers."""
        if members not in self._left:
            own = [self._causes[number] for number in sorted(members)]
            self._left[members] = self._evidence.residual(own)
        return self._left[members]


def _steps(
    best: Explanation, shown: np.ndarray, floor: float, left_by: LeftBy
) -> tuple[ShrinkageStep, ...]:
    """Return the remainder after each cause, and the causes' Shapley shares of the closed part."""
    whole = frozenset(range(len(best.causes)))

    def score(members: frozenset[int]) -> float:
        return float(np.mean(left_by(members)[shown] ** 2))

    steps = []
    for number, cause in enumerate(best.causes):
        members = frozenset(range(number + 1))
        steps.append(
            ShrinkageStep(
                effect=cause.id,
                axis=cause.axis,
                rms=floor * float(np.sqrt(score(members))),
                shapley=_shapley(number, whole, score),
            )
        )
    return tuple(steps)


def _shapley(number: int, whole: frozenset[int], score: Callable[[frozenset[int]], float]) -> float:
    """Return the mean share of the gap that a cause closes, over all orders of adding causes.

    Shapley, Contributions to the Theory of Games II (1953) 307-317.
    """
    before = score(frozenset())
    total = 0.0
    others = sorted(whole - {number})
    for size in range(len(others) + 1):
        orders = factorial(size) * factorial(len(others) - size) / factorial(len(whole))
        for chosen in combinations(others, size):
            without = frozenset(chosen)
            total += orders * (
                closed(before, score(without | {number})) - closed(before, score(without))
            )
    return total
