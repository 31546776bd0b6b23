"""What may be said of an axis: all that decides, in one place.

A verdict weighs; it never hides a cause that is sure because something else is left.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.gap.compare.closed_share import closed
from rotemina.sim.gap.compare.explanations import Explanation
from rotemina.sim.gap.compare.held_out_power import held_out_powers
from rotemina.sim.gap.compare.rivals import Rival
from rotemina.sim.gap.compare.weights import weigh
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.thresholds import (
    ADEQUATE,
    DISTINCT,
    EXPLAINED,
    HALF,
    MOST_RIVALS,
    MUCH,
    NEARLY_ALL,
    SAME_SCORE,
    SOME,
    VOUCHES,
)


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
) -> Verdict:
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
        return Verdict.INSUFFICIENT
    if max(closing.share, closing.at_a_tap) < (SOME if sure else MUCH):
        return Verdict.UNKNOWN
    if any(len(others) >= MOST_RIVALS for others in ambiguous):
        return Verdict.INSUFFICIENT
    left, black_box = closing.left, closing.black_box
    as_well = left <= SAME_SCORE * black_box and black_box <= VOUCHES * left
    if closing.share >= EXPLAINED or left <= ADEQUATE or as_well:
        return Verdict.EXPLAINED
    return Verdict.PARTLY


def stands(closes: float, left: float, weight: float) -> bool:
    """Tell whether one of several causes is present, and not part of an unexplained remainder.

    Parameters
    ----------
    closes, left : float
        Power over the floor that it closes beside the others, and that all of them leave above it.
    weight : float
        That it or its kind has among all that could stand in its place, nothing at all included.
    """
    return closes >= DISTINCT * left and weight >= HALF


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
    return float(weights[together].sum()) >= NEARLY_ALL
