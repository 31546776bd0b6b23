"""What may be said of an axis: all that decides, in one place.

A verdict weighs; it never hides a cause that is sure because something else is left.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.gap.compare.explanations import Explanation
from rotemina.sim.gap.compare.held_out_power import held_out_powers
from rotemina.sim.gap.compare.rivals import Rival
from rotemina.sim.gap.compare.weights import weigh
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.limits import (
    LARGE_SHARE,
    MAX_AMBIGUOUS_RIVALS,
    MAX_BLACK_BOX_SCORE_RATIO,
    MAX_CHANCE_SCORE_RATIO,
    MAX_NOISE_POWER,
    MIN_ALMOST_COMPLETE_SHARE,
    MIN_DISTINCT_RATIO,
    MIN_EXPLAINED_SHARE,
    MIN_MAJORITY_SHARE,
    MIN_SHARE_TO_NAME,
)
from rotemina.sim.gap.result import GapVerdict, closed


@dataclass(frozen=True, slots=True)
class Closing:
    """How far a gap closes: mean squares over the floor, on validation data.

    ``raw`` is the gap, ``left`` the remainder after the causes, and ``black_box`` that of a model
    without prior knowledge; ``at_a_tap`` is the largest share closed at one tap. Other behaviour of
    the machine may be many floors of a reference that is finer than its sensor.
    """

    raw: float
    left: float
    black_box: float
    at_a_tap: float = 0.0

    @property
    def share(self) -> float:
        """The share of the gap's power that is closed."""
        return closed(self.raw, self.left)


def decide(
    closing: Closing, ambiguous: Sequence[Sequence[str]], *, poor: bool, sure: bool
) -> GapVerdict:
    """Return the verdict on an axis that has a gap.

    Parameters
    ----------
    closing : Closing
    ambiguous : sequence of sequence of str
        For each cause, the effects that cannot be told from it.
    poor : bool
        Whether the motion is too poor to tell effects apart.
    sure : bool
        Whether each cause stands out among its rivals all the same.
    """
    if poor and not sure:
        return GapVerdict.INSUFFICIENT
    if max(closing.share, closing.at_a_tap) < (MIN_SHARE_TO_NAME if sure else LARGE_SHARE):
        return GapVerdict.UNKNOWN
    if any(len(others) >= MAX_AMBIGUOUS_RIVALS for others in ambiguous):
        return GapVerdict.INSUFFICIENT
    left, black_box = closing.left, closing.black_box
    as_well = (
        left <= MAX_CHANCE_SCORE_RATIO * black_box and black_box <= MAX_BLACK_BOX_SCORE_RATIO * left
    )
    if closing.share >= MIN_EXPLAINED_SHARE or left <= MAX_NOISE_POWER or as_well:
        return GapVerdict.EXPLAINED
    return GapVerdict.PARTLY


def stands(closes: float, left: float, weight: float) -> bool:
    """Tell whether one of several causes is present, and not part of an unexplained remainder.

    Parameters
    ----------
    closes, left : float
        Power over the floor that it closes beside the others, and that all of them leave above it.
    weight : float
        That it or its kind has among all that could stand in its place, nothing at all included.
    """
    return closes >= MIN_DISTINCT_RATIO * left and weight >= MIN_MAJORITY_SHARE


def is_sure(
    evidence: Evidence, ranked: Sequence[Sequence[Rival]], ambiguous: Sequence[Sequence[str]]
) -> bool:
    """Tell whether each cause stands out among its rivals by its remainder on unseen data.

    A cause counts together with the ``ambiguous`` effects that the data cannot distinguish from it.
    Only performance counts, not simplicity: poor motion lets many effects perform equally well.
    """
    pairs = zip(ranked, ambiguous, strict=True)
    return bool(ranked) and all(_stands_out(evidence, *one) for one in pairs)


def _stands_out(evidence: Evidence, rivals: Sequence[Rival], alike: Sequence[str]) -> bool:
    found: list[Explanation] = [one.explanation for one in rivals]
    if len(found) < 2:
        return False
    effects = [len(one.causes) for one in found]
    weights = weigh(held_out_powers(evidence, [one.held_out for one in found]), effects)
    best = int(np.argmax(weights))
    together = [number == best or one.effect in alike for number, one in enumerate(rivals)]
    return float(weights[together].sum()) >= MIN_ALMOST_COMPLETE_SHARE
