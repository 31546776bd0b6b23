"""The causes that hold against all effects that could take their place."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from rotemina.sim.effects import EffectTrait, load_effect
from rotemina.sim.gap.compare.attribution import attributed, closing, without_own
from rotemina.sim.gap.compare.explanations import (
    MOST_STEPS,
    Explanation,
    beside,
    explain,
    explanation,
    named_as,
)
from rotemina.sim.gap.compare.forward_selection import Selection
from rotemina.sim.gap.compare.held_out_power import held_out_powers
from rotemina.sim.gap.compare.random_remainders import RandomRemainders
from rotemina.sim.gap.compare.rivals import Key, Rival, probability, rivals
from rotemina.sim.gap.compare.substitutes import AT_THE_SENSOR, substitutes
from rotemina.sim.gap.compare.verdict import stands
from rotemina.sim.gap.compare.weights import weigh
from rotemina.sim.gap.fit import Evidence, fit, is_own, is_whole_own, kinship_of
from rotemina.sim.gap.limits import (
    LARGE_SHARE,
    MAX_CHANCE_SCORE_RATIO,
    MAX_NEAR_SCORE_RATIO,
    MAX_NOISE_POWER,
    MAX_P_VALUE,
    MAX_TIED_SCORE_RATIO,
    MAX_UNMODELLED_SHARE,
    MIN_DISTINCT_RATIO,
    MIN_MAJORITY_SHARE,
    MIN_SHARE_TO_NAME,
)
from rotemina.sim.gap.result import closed
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

_TURNS = 6  # at most, in which rivals take a cause's place until none is likelier
_WITHOUT_STEPS = 5  # of a fit without one of the causes, from where the others are

Ranking = Mapping[Key, tuple[Rival, ...]]


def contested(
    evidence: Evidence,
    selection: Selection,
    best: Explanation,
    aside: Mapping[Tap, float],
    *,
    wanders: bool,
    disturbed: bool,
) -> tuple[Explanation, Ranking]:
    """Return the explanation by the causes that stand, and the rivals of each.

    A rival that does about as well with fewer parameters takes a cause's place. A cause in whose
    place several others would do as well is none, as it stands for what the rest leaves; nor is
    one that closes little where the sensor ``wanders``. ``aside`` is the power at each tap, in its
    floors squared, of what was set aside: beside more than the gap, even a lone cause may follow
    what that left. ``disturbed`` tells that a disturbance is a cause, which makes any other one of
    several.
    """
    best, ranked = _with_the_likeliest(evidence, selection, best)
    unsure = wanders or max(aside.values(), default=0.0) > selection.raw
    beside_others = unsure or disturbed
    # What nothing that was found explains: one that does not stand may still take a part of it.
    more = [one for one in selection.tried if set(one.ids) >= set(best.ids)]
    fullest = min([best, *more], key=lambda one: one.score).by_tap
    remains = {tap: max(left - 1.0, 0.0) for tap, left in fullest.items()}
    once: set[Key] = set()  # a re-tuned parameter may come back in what the others leave
    while len(best.causes) > 1 or (best.causes and beside_others):
        doubted = {
            key: weight
            for key in best.ids
            if key not in once
            and (weight := _doubt(evidence, selection, best, ranked[key], key, remains)) is not None
        }
        if wanders:
            bent = (key for key in best.ids if key not in once and _bends_to(evidence, best, key))
            doubted |= dict.fromkeys(bent, 0.0)
        if not doubted:
            break
        # One at a time: without it, another that it stood in for may be beyond doubt.
        least = min(doubted, key=lambda key: (doubted[key], key[0], key[1] or ""))
        once.add(least)
        kept = [one for one in best.causes if (one.id, one.from_axis) != least]
        best = _with_only(evidence, selection, kept)
        ranked = rivals_of(evidence, selection, best)
    if once:
        best, ranked = _with_the_likeliest(evidence, selection, best, ranked)
    return _significant(evidence, selection, best, ranked, remains, aside, alone=not unsure)


def _significant(
    evidence: Evidence,
    selection: Selection,
    best: Explanation,
    ranked: Ranking,
    remains: Mapping[Tap, float],
    aside: Mapping[Tap, float],
    *,
    alone: bool,
) -> tuple[Explanation, Ranking]:
    """Return the explanation without causes that may but follow what no catalogue holds.

    A re-tuned parameter that takes the place of one is a cause if it stands by itself. A cause that
    stands ``alone`` goes only where such parameters do most of what it does.
    """
    remainders = RandomRemainders(evidence)
    dropped: set[Key] = set()
    while best.causes:
        p_values = {key: _p_value(selection, best, key, aside, remainders) for key in best.ids}
        doubtful = max(p_values, key=lambda key: p_values[key])
        by_own = closed(selection.raw, selection.retuned.score) >= LARGE_SHARE
        lone = alone and len(best.causes) == 1
        if p_values[doubtful] <= MAX_P_VALUE or (lone and not by_own):
            break
        dropped.add(doubtful)
        named = set(best.ids)
        kept = [one for one in best.causes if (one.id, one.from_axis) != doubtful]
        if is_whole_own(doubtful[0]):  # it goes on correcting the model
            best = replace(best, causes=tuple(kept))
        elif not kept and by_own:
            best = attributed(evidence, selection.bare, selection.retuned)
        else:
            best = _with_only(evidence, selection, kept)
        best, ranked = _with_the_likeliest(evidence, selection, best, without=dropped)
        if kept:
            weak = {
                key
                for key in set(best.ids) - named
                if _doubt(evidence, selection, best, ranked[key], key, remains) is not None
            }
            best = named_as(best, set(best.ids) - weak)
    return best, ranked


def _with_the_likeliest(
    evidence: Evidence,
    selection: Selection,
    best: Explanation,
    ranked: dict[Key, tuple[Rival, ...]] | None = None,
    *,
    without: Collection[Key] = (),
) -> tuple[Explanation, dict[Key, tuple[Rival, ...]]]:
    """Return an explanation with rivals in the place of causes than which they are by far likelier.

    With it come the rivals of each of its causes, ``ranked`` where they are known. None of those
    ``without`` which it is to be comes back.
    """
    ranked = ranked or rivals_of(evidence, selection, best)
    for _ in range(_TURNS):
        likelier = _likelier(ranked, without)
        if likelier is None:
            break
        best = attributed(evidence, selection.bare, likelier)
        ranked = rivals_of(evidence, selection, best)
    return best, ranked


def _likelier(
    ranked: Mapping[Key, Sequence[Rival]], without: Collection[Key]
) -> Explanation | None:
    """Return the explanation with a rival in the place of a cause, if that is by far likelier.

    It does about as well with fewer parameters. Of those by the same effects, which began at
    different numbers, the one that leaves least.
    """
    found = [
        own[0]
        for key, own in ranked.items()
        if (own[0].effect, own[0].from_axis) not in {key, *without}
        and (
            own[0].probability >= MIN_MAJORITY_SHARE
            or own[0].probability >= MIN_DISTINCT_RATIO * probability(own, key)
        )
    ]
    if not found:
        return None
    ids = max(found, key=lambda one: one.probability).explanation.ids
    alike = [
        one.explanation for own in ranked.values() for one in own if one.explanation.ids == ids
    ]
    return min(alike, key=lambda one: one.score)


def _doubt(
    evidence: Evidence,
    selection: Selection,
    best: Explanation,
    ranked: Sequence[Rival],
    key: Key,
    remains: Mapping[Tap, float],
) -> float | None:
    """Return the weight of a cause that stands at no tap, None of one that stands.

    ``remains`` is the power that is left at each tap above the floor.
    """
    without = _without(evidence, selection, best, key)
    weight = _weight_of_its_kind(evidence, best, without, ranked, key)
    standing = any(
        stands(closes, remains[tap], weight)
        for tap, closes in closing(evidence, without, best).items()
    )
    return None if standing else weight


def _p_value(
    selection: Selection,
    best: Explanation,
    key: Key,
    aside: Mapping[Tap, float],
    remainders: RandomRemainders,
) -> float:
    """Return the p-value of a cause: that it follows as much of what nothing known explains.

    It is 0 where nothing is left, or where the cause does too much for that: what a machine does
    beyond every catalogue is a small part of the gap where the last of its taps reads it.
    """
    without = _without(remainders.evidence, selection, best, key)
    if max(best.by_tap.values()) < MAX_NOISE_POWER or without.score <= 1.0:
        return 0.0
    last = next(tap for tap in (Tap.MEAS, Tap.REF, Tap.U) if tap in best.by_tap)
    raw = selection.bare.by_tap[last] + aside.get(last, 0.0)
    if without.by_tap[last] - best.by_tap[last] >= MAX_UNMODELLED_SHARE * (raw - 1.0):
        return 0.0
    share = (without.score - best.score) / (without.score - 1.0)
    return remainders.p_value(best, key, share)


def _weight_of_its_kind(
    evidence: Evidence, best: Explanation, without: Explanation, ranked: Sequence[Rival], key: Key
) -> float:
    """Return the weight that a cause is there, or what does the same at the sensor.

    Which of these it is may be in doubt, and that one of them is there beyond doubt.
    """
    others = [one for one in ranked if one.explanation is not best]
    own = (Rival(key[0], key[1], 1.0, best), *others)
    found = [*(one.explanation for one in own), without]
    counts = [*(len(best.causes) for _ in own), len(best.causes) - 1]
    weights = weigh(held_out_powers(evidence, [one.held_out for one in found]), counts)
    kin = [_is_kin(one, key) for one in own]
    return float(weights[:-1][kin].sum())


def _is_kin(one: Rival, key: Key) -> bool:
    name, source = key
    family = kinship_of(name).family
    alike = family in AT_THE_SENSOR and kinship_of(one.effect).family is family
    return one.from_axis == source and (one.effect == name or alike)


def _without(evidence: Evidence, selection: Selection, best: Explanation, key: Key) -> Explanation:
    """Return the others of a cause, fitted by themselves."""
    others = [one for one in best.causes if (one.id, one.from_axis) != key]
    if is_whole_own(key[0]):
        kept = [one for one in best.fit.effects if one.id != key[0]]
        again = fit(evidence, kept, most_steps=_WITHOUT_STEPS, near=best.fit)
        return explanation(evidence, len(others), again)
    free = [one for one in others if not is_own(evidence, one)]
    if not free:
        return selection.retuned
    named = {(one.id, one.from_axis) for one in free}
    alone = [one for one in selection.tried if set(one.ids) == named]
    if alone:
        return min(alone, key=lambda one: one.score)
    some = beside(evidence, free, best)
    again = fit(evidence, some, most_steps=_WITHOUT_STEPS, near=best.fit)
    return explanation(evidence, len(free), again)


def _bends_to(evidence: Evidence, best: Explanation, key: Key) -> bool:
    """Tell whether a cause closes so little beside a wander that it may only follow that."""
    others = [one for one in best.causes if (one.id, one.from_axis) != key]
    before = float(np.mean(evidence.residual(others) ** 2))
    return closed(before, best.score) < (LARGE_SHARE if _is_slow(key[0]) else MIN_SHARE_TO_NAME)


def _is_slow(effect_id: str) -> bool:
    """Tell whether an effect is fixed in time without coming again."""
    effect = load_effect(effect_id)
    lasting = EffectTrait.LOCKED_TO_TIME in effect.formulations[0].traits
    return lasting and effect.identification.shows_as is None


def _with_only(evidence: Evidence, selection: Selection, kept: Sequence[AxisEffect]) -> Explanation:
    """Return the explanation by some of the causes."""
    if not kept:
        return selection.bare
    causes = [one for one in kept if not is_own(evidence, one)]
    named = {(one.id, one.from_axis) for one in causes}
    # Without what went, another of their forms may do better.
    alone = [one for one in selection.tried if set(one.ids) == named]
    best = min([explain(evidence, causes), *alone], key=lambda one: one.score)
    return attributed(evidence, selection.bare, best)


def rivals_of(
    evidence: Evidence, selection: Selection, best: Explanation
) -> dict[Key, tuple[Rival, ...]]:
    """Return the rivals of each cause of an explanation, likeliest first."""
    tried = _with_retuned(evidence, selection, best)
    substituted = _with_substitutes(evidence, best, tried)
    ranked = {}
    for key in best.ids:
        # Each by itself: of what was tried, only the best few are fitted again.
        others = without_own(evidence, best, tried, key) + without_own(
            evidence, best, substituted, key
        )
        ranked[key] = rivals(evidence, best, _one_of_each(others), key, selection.raw)
    return ranked


def _one_of_each(found: Sequence[Explanation]) -> list[Explanation]:
    """Return the best explanation by each set of effects: the simplest of what is as good."""
    least: dict[object, float] = {}
    for one in found:
        least[one.ids] = min(one.score, least.get(one.ids, one.score))
    kept: dict[object, Explanation] = {}
    for one in sorted(found, key=lambda one: (one.fit.parameters, one.score)):
        if one.score <= MAX_CHANCE_SCORE_RATIO * least[one.ids]:
            kept.setdefault(one.ids, one)
    return list(kept.values())


def _with_retuned(
    evidence: Evidence, selection: Selection, best: Explanation
) -> tuple[Explanation, ...]:
    """Return what was tried, the model's own parameters by name if they come near."""
    if not selection.tried or selection.retuned.score > MAX_NEAR_SCORE_RATIO * best.score:
        return selection.tried
    named = attributed(evidence, selection.bare, selection.retuned)
    others = [one for one in selection.tried if one is not selection.retuned]
    return (*others, replace(named, causes=named.causes[:1]))


def _with_substitutes(
    evidence: Evidence, best: Explanation, tried: Sequence[Explanation]
) -> tuple[Explanation, ...]:
    """Return explanations by what does much the same as a cause, if that was not tried so already.

    It is fitted from the cause's numbers on: from others it may have ended in a worse place. The
    sensor, where no reference was recorded; another axis that moved alike, for a gain; a lag
    of high order, for a delay.
    """
    more = []
    for cause in best.causes:
        own = is_own(evidence, cause)
        others = [one for one in best.causes if one is not cause and not is_own(evidence, one)]
        for asked in substitutes(evidence, cause):
            well = MAX_TIED_SCORE_RATIO * best.score
            if own or not any(one.score < well and _is_by(one, [*others, asked]) for one in tried):
                effects = beside(evidence, [*others, asked])
                if own:  # in whose place it stands
                    effects = [one for one in effects if one.id != cause.id]
                fitted = fit(evidence, effects, most_steps=MOST_STEPS)
                more.append(explanation(evidence, len(others) + 1, fitted))
    return tuple(more)


def _is_by(one: Explanation, causes: Sequence[AxisEffect]) -> bool:
    """Tell whether an explanation is by such causes, the last of them in the same form."""
    wanted = sorted((cause.id, cause.from_axis) for cause in causes)
    forms = {(cause.id, cause.formulation) for cause in one.causes}
    return sorted(one.ids) == wanted and (causes[-1].id, causes[-1].formulation) in forms
