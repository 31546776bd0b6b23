"""The certainty of a cause: its rivals, and those that the data cannot distinguish from it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import EffectFamily, load_effect
from rotemina.sim.gap.compare.explanations import Explanation
from rotemina.sim.gap.compare.held_out_power import held_out_powers
from rotemina.sim.gap.compare.weights import weigh
from rotemina.sim.gap.fit import (
    Blocks,
    Evidence,
    block_rows,
    is_of,
    is_whole_own,
    kinship_of,
    with_parameter,
)
from rotemina.sim.gap.limits import (
    FAR_OFF_POWER,
    MAX_TIED_SCORE_RATIO,
    MIN_ALMOST_COMPLETE_SHARE,
    MIN_CAUSE_SHARE,
    MIN_NOTICEABLE_POWER,
    MIN_RIVAL_PROBABILITY_RATIO,
    PRIOR_FACTOR_AT_BOUND,
    PRIOR_FACTOR_PER_PARAMETER,
)
from rotemina.sim.gap.result import closed
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

_MOST_MORE = 2  # parameters that count so
_AT_AN_END = 0.01  # of a parameter's bounds apart, how near to one it is at it
_SLIGHT = 0.01  # error of a frequency, below which a small mass on a spring may do it
_SLIGHTLY_DAMPED = 0.1  # the same for damping

Key = tuple[str, str | None]


@dataclass(frozen=True, slots=True)
class Rival:
    """An effect in the place of a cause: how likely, and the explanation with it."""

    effect: str
    from_axis: str | None
    probability: float
    explanation: Explanation


def rivals(
    evidence: Evidence, best: Explanation, tried: Sequence[Explanation], cause: Key, raw: float
) -> tuple[Rival, ...]:
    """Return the explanations with another effect in place of a cause, likeliest first.

    The cause itself is among them, and the model's own parameters take part in all. ``raw`` is the
    mean square of the gap over the floor.
    """
    others = [key for key in best.ids if key != cause and not is_whole_own(key[0])]
    found = [(cause, best)]
    for one in tried:
        keys = [key for key in one.ids if not is_whole_own(key[0]) or not others]
        if one is best or len(keys) != len(others) + 1 or any(key not in keys for key in others):
            continue
        (own,) = [key for key in keys if key not in others] or [cause]
        if own != cause:
            found.append((own, one))
    counts = [_counted(one, cause) for _, one in found]
    each = list(zip(found, counts, strict=True))
    least = min(count for (_, one), count in each if _is_tied(best, one))
    near = min(count for (_, one), count in each if _is_near(best, one, raw))
    powers = held_out_powers(evidence, [one.held_out for _, one in found])
    priors = [
        _prior(key[0], _more_parameters(best, one, count, least, near)) * _as_the_machine(one)
        for (key, one), count in each
    ]
    weights = weigh(powers, [0] * len(found)) * np.array(priors)
    shares = weights / weights.sum()
    ranked = sorted(zip(found, shares, strict=True), key=lambda pair: -pair[1])
    return tuple(Rival(key[0], key[1], float(share), one) for (key, one), share in ranked)


def not_ruled_out(ranked: Sequence[Rival], cause: Key, raw: float) -> tuple[str, ...]:
    """Return the effects that the data cannot distinguish from a cause.

    ``raw`` is the mean square of the gap over the floor. An effect that closes most is among them
    if the cause leaves a remainder: its additional parameters count against it, but rule nothing
    out while no formula is exact.
    """
    likeliest = max(one.probability for one in ranked)
    names = [
        one.effect
        for one in ranked
        if one.effect != cause[0] and one.probability >= MIN_RIVAL_PROBABILITY_RATIO * likeliest
    ]
    own = next((one for one in ranked if (one.effect, one.from_axis) == cause), None)
    closest = min(ranked, key=lambda one: one.explanation.score)
    if (
        own is not None
        and own.explanation.score >= MIN_NOTICEABLE_POWER
        and closest.effect != cause[0]
    ):
        names.append(closest.effect)
    load = with_parameter("mass_ratio")
    if load is not None and is_of(EffectFamily.RESONANCE, cause[0]) and _is_slight(ranked, cause):
        names.append(load[0].id)
    names += [other.effect for other in ranked if _is_kin(ranked, cause, other, raw)]
    return tuple(dict.fromkeys(names))


def _is_kin(ranked: Sequence[Rival], cause: Key, other: Rival, raw: float) -> bool:
    """Tell whether an effect does nearly as much as its near relative, for a large gap.

    A sticking screw and a loose one both lag at each reversal. How softly they engage, and how a
    dither affects them, differs between machines; no formula is exact.
    """
    kin = is_of(EffectFamily.LOST_MOTION, cause[0]) and is_of(
        EffectFamily.LOST_MOTION, other.effect
    )
    if not kin or other.effect == cause[0] or cause[1] is not None:
        return False
    left = next(one.explanation.score for one in ranked if one.effect == cause[0])
    return (
        left >= FAR_OFF_POWER and closed(raw, other.explanation.score) >= MIN_ALMOST_COMPLETE_SHARE
    )


def _fitted_value(ranked: Sequence[Rival], cause: Key, name: str) -> float:
    own = next(one for one in ranked if (one.effect, one.from_axis) == cause)
    (effect,) = (one for one in own.explanation.fit.effects if one.id == cause[0])
    return effect.parameters[name]


def _is_slight(ranked: Sequence[Rival], cause: Key) -> bool:
    """Tell whether a resonance is so little off that a small mass on a spring may do it.

    A mass m there, at a frequency well apart from the axis' own, moves that by about m/2M, and
    shows by nothing else where its own narrow line is not excited.
    """
    error, damping = (
        _fitted_value(ranked, cause, name) for name in ("frequency_error", "damping_error")
    )
    return abs(error) < _SLIGHT and abs(damping) < _SLIGHTLY_DAMPED


def _prior(effect: str, more_parameters: int) -> float:
    """Return how likely an effect is before any record: the simpler one on a tie."""
    return kinship_of(effect).prior * PRIOR_FACTOR_PER_PARAMETER ** -min(
        more_parameters, _MOST_MORE
    )


def probability(ranked: Sequence[Rival], cause: Key) -> float:
    """Return the probability of a cause among its rivals."""
    return next(one.probability for one in ranked if (one.effect, one.from_axis) == cause)


def _as_the_machine(one: Explanation) -> float:
    """Return how likely it is that the model's own parameters are so far off."""
    own = [number for number, effect in enumerate(one.fit.effects) if is_whole_own(effect.id)]
    reached = (
        min(x * free.size - free.low, free.high - x * free.size)
        < _AT_AN_END * (free.high - free.low)
        for free, x in zip(one.fit.free, one.fit.x, strict=True)
        if free.effect in own
    )
    return PRIOR_FACTOR_AT_BOUND if any(reached) else 1.0


def _counted(one: Explanation, cause: Key) -> int:
    """Return the number of parameters of an explanation, but for a lag's shape by a delay.

    A filter has some order: a delay without order is not more likely for that reason.
    """
    if not is_of(EffectFamily.LATE, cause[0]):
        return one.fit.parameters
    shapes = [_shape(own) for own in one.causes if is_of(EffectFamily.LATE, own.id)]
    return one.fit.parameters - sum(shapes)


def _shape(late: AxisEffect) -> int:
    """Return the number of parameters of an effect besides its delay."""
    formulation = load_effect(late.id).find_formulation(late.formulation)
    return len(formulation.parameters) - 1 if formulation is not None else 0


def _more_parameters(
    best: Explanation, other: Explanation, count: int, least: int, near: int
) -> int:
    """Return how many parameters more count against an explanation.

    All beyond the ``least`` of those that do as well; but one at most beyond those that come
    ``near``. By other equations than a machine's own nothing is quite right, and much that one
    explanation closes more than another may be but what its many parameters bend.
    """
    return max(count - least if _is_tied(best, other) else 0, int(count > near))


def _is_near(best: Explanation, other: Explanation, raw: float) -> bool:
    """Tell whether another explanation closes nearly as much of the gap."""
    return _is_tied(best, other) or other.score - best.score < MIN_CAUSE_SHARE * (raw - 1.0)


def _is_tied(best: Explanation, other: Explanation) -> bool:
    """Tell whether another explanation does about as well, so that the simpler one counts."""
    return other.score < MAX_TIED_SCORE_RATIO * best.score


def paired_blocks(evidence: Evidence, left: Sequence[FloatArray], tap: Tap) -> Blocks:
    """Return sums of squares (blocks, residuals) at one tap."""
    numbers = block_rows(evidence)
    rows = np.concatenate(
        [np.full(part.rows.stop - part.rows.start, part.tap is tap) for part in evidence.parts]
    )
    _, own = np.unique(numbers[rows], return_inverse=True)
    total = np.stack([np.bincount(own, one[rows] ** 2) for one in left], axis=1)
    return Blocks(np.asarray(total, dtype=np.float64), np.bincount(own).astype(np.float64))
