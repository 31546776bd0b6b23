"""The effects that explain the gap of an axis: forward selection on validation data."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import inf

import numpy as np

from rotemina.sim.effects import EffectFamily, EffectSignature, EffectStage, load_effect
from rotemina.sim.gap.compare.effect_candidates import candidates, is_slow, scouts, siblings
from rotemina.sim.gap.compare.explanations import (
    MOST_STEPS,
    Explanation,
    beside,
    explanation,
    untouched,
)
from rotemina.sim.gap.compare.parallel_fits import fitted, screened_beside
from rotemina.sim.gap.compare.repeated_causes import has_overtone, is_own_mode
from rotemina.sim.gap.compare.retuning import retuned
from rotemina.sim.gap.compare.screening import Screened
from rotemina.sim.gap.fit import (
    Evidence,
    brought_along,
    fit,
    is_of,
    is_own,
    kinship_of,
)
from rotemina.sim.gap.limits import (
    HOPELESS_SCORE_RATIO,
    LARGE_SHARE,
    MAX_CHANCE_SCORE_RATIO,
    MAX_NEAR_SCORE_RATIO,
    MAX_NOISE_POWER,
    MIN_ALMOST_COMPLETE_SHARE,
    MIN_CAUSE_POWER,
    MIN_CAUSE_SHARE,
    MIN_DISTINCT_RATIO,
    MIN_DOMINANT_SHARE_OF_REMAINDER,
    MIN_MAJORITY_SHARE,
    MIN_NOTICEABLE_POWER,
    MIN_OBVIOUS_POWER,
    MIN_SHARE_TO_NAME,
    NARROW_FIT_SCORE_FACTOR,
    NEGLIGIBLE_SHARE,
)
from rotemina.sim.gap.result import Account, Grade, closed
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

MOST_CAUSES = 3
_FITTED = 6  # effects that are fitted in full after screening
_FITTED_LATER = 4
_FITTED_SLOWLY = 2  # beside a cause that takes long to simulate
_GO_ON = (
    MIN_SHARE_TO_NAME,
    MIN_MAJORITY_SHARE,
    1.0,
)  # share closed by one, two causes, to look for another
_BEAM = (2, 1, 1)  # explanations that are extended, with one, two, three causes
_MISLED = 2.0  # times what its slopes promise of a re-tuning, that this leaves


@dataclass(frozen=True, eq=False)
class Selection:
    """The explanations tried on an axis, and the result.

    ``bare`` is the original model; ``retuned`` the explanation without causes, by the model's own
    parameters; ``tried`` holds all explanations, best first.
    """

    bare: Explanation
    retuned: Explanation
    best: Explanation
    tried: tuple[Explanation, ...]

    @property
    def raw(self) -> float:
        """Mean square of the gap over the floor."""
        return self.bare.score


def select(
    evidence: Evidence,
    account: Account,
    aside: Mapping[Tap, float],
    *,
    jobs: int = 1,
) -> Selection:
    """Find the causes of an axis' gap, together with the model's own re-tuned parameters.

    ``account`` hears of stages, and of every candidate what it leaves. ``aside`` is the power at
    each tap, in its floors squared, of what was set aside before.
    """
    own = possible_causes(evidence)
    bare = untouched(evidence)
    account.begin(bare.score)
    alone = retuned(evidence)
    account.tried((), alone.score, Grade.UNSEEN)
    # A single motion confirms little: a further cause must then take away most of what is left.
    least = (
        MIN_MAJORITY_SHARE if len(evidence.observations) > 1 else MIN_DOMINANT_SHARE_OF_REMAINDER
    )
    enters = partial(_enters, bare, aside, evidence.has(Tap.REF), least)
    best = alone if enters(bare, alone) else bare
    beam, tried = [bare], [alone]
    if alone.score >= MIN_NOTICEABLE_POWER and closed(bare.score, alone.score) >= _least_own(
        bare, alone
    ):
        beam = [bare, alone]
    for level in range(MOST_CAUSES):
        found = _all_extended(evidence, beam, own, bare, account, jobs)
        found = _unique(_apart_from_own(evidence, bare, alone, found))
        overtones = [one for one in found if has_overtone(evidence, one)]
        tried += overtones  # no cause of its own, but it corrects the model
        found = [one for one in found if one not in overtones]
        if found and enters(best, found[0]):
            others = _in_other_words(evidence, bare, found[0], own, tried, account, jobs)
            found = _unique([*found, *others])
        tried += found
        if not found:
            break
        if enters(best, found[0]):
            best = found[0]
            if _is_enough(bare, best):
                break
        elif level > 0 or _is_little(bare, best):
            break  # two causes may still do what one alone does not do better than a re-tuning
        near = [one for one in found if one.score < MIN_DISTINCT_RATIO * found[0].score]
        beam = _unlike(near)[: _BEAM[level]]
        if best.score < MIN_NOTICEABLE_POWER or closed(bare.score, best.score) < _GO_ON[level]:
            break
    simplest = _simplified(evidence, enters, best)
    return Selection(bare, alone, simplest, tuple(sorted(tried, key=lambda one: one.score)))


def _least_own(bare: Explanation, alone: Explanation) -> float:
    """Return the share of the gap from which causes are looked for beside a re-tuned model too.

    A first look leaves out what the slopes of the model's own parameters promise to follow. Where
    their bounds or curves do not keep that promise, it passes over what is really there.
    """
    promised = float(np.mean(bare.fit.beside**2))
    return MIN_MAJORITY_SHARE if alone.fit.cost > _MISLED * promised else MIN_ALMOST_COMPLETE_SHARE


def possible_causes(evidence: Evidence) -> list[AxisEffect]:
    """Return what may be a cause beside the model's own parameters."""
    return [
        one
        for one in candidates(evidence)
        if not is_own(evidence, one) and not _is_told_otherwise(evidence, one)
    ]


def _is_told_otherwise(evidence: Evidence, candidate: AxisEffect) -> bool:
    """Tell whether something else says the same as a candidate.

    A gain of the axis says what one of the sensor does, where no reference tells them apart. And
    rounded as well, an answer may be off by two halves of a cell.
    """
    effect = load_effect(candidate.id)
    of_the_sensor = _is_at_sensor(candidate) and is_of(EffectFamily.GAIN, effect.id)
    if of_the_sensor and not evidence.has(Tap.REF):
        return True
    return evidence.in_cells and effect.identification.shows_as is EffectSignature.STEPS


def _enters(
    bare: Explanation,
    aside: Mapping[Tap, float],
    staged: bool,
    least: float,
    before: Explanation,
    after: Explanation,
) -> bool:
    """Tell whether what lowers the gap of any tap from ``before`` to ``after`` is a cause.

    It closes its share of the gap of the ``bare`` model, or at least as much as then remains; and
    more than what is set ``aside`` may leave of itself. ``staged``: a reference tells what the
    machine does from what its sensor does. ``least`` is the share of what is left that a further
    cause takes away, whatever its share of the gap.
    """
    needed = max(_needed(after.causes, staged), default=0.0)
    return any(
        _closes(bare.by_tap[tap], before.by_tap[tap], left, needed, least, alone=not before.causes)
        and before.by_tap[tap] - left >= NEGLIGIBLE_SHARE * aside.get(tap, 0.0)
        for tap, left in after.by_tap.items()
    )


def _needed(causes: Sequence[AxisEffect], staged: bool) -> Iterator[float]:
    """Give the shares that causes must close beside others that bring them along.

    Where a reference was recorded, a sensor's effect brings along others of the sensor alone.
    """
    for one in causes:
        for other in causes:
            apart = staged and _is_at_sensor(one) is not _is_at_sensor(other)
            if not apart and other is not one:
                share = brought_along(one.id, other.id)
                if share < 1.0:
                    yield share


def _is_at_sensor(cause: AxisEffect) -> bool:
    return load_effect(cause.id).stage is EffectStage.SENSOR


def _closes(
    raw: float, before: float, after: float, needed: float, least: float, *, alone: bool
) -> bool:
    closing = before - after
    if closing >= max(max(MIN_CAUSE_SHARE, needed) * (raw - 1.0), MIN_CAUSE_POWER):
        return True
    if needed > 0.0:
        return False  # what another one brings along is how that differs from its formula
    if alone:
        return before >= MIN_NOTICEABLE_POWER and closing >= MIN_DOMINANT_SHARE_OF_REMAINDER * (
            before - 1.0
        )
    # Beside other causes, less may be how these differ from their formulas.
    return closing >= max(least * (before - 1.0), MIN_OBVIOUS_POWER)


def _is_little(bare: Explanation, begun: Explanation, seen: float = MIN_OBVIOUS_POWER) -> bool:
    """Tell whether no single further cause can close its share of any tap's gap, or be seen."""
    return all(
        left - 1.0 < min(max(MIN_CAUSE_SHARE * (bare.by_tap[tap] - 1.0), MIN_CAUSE_POWER), seen)
        for tap, left in begun.by_tap.items()
    )


def _is_enough(bare: Explanation, best: Explanation) -> bool:
    """Tell whether no further cause can close its share, nor correct the model by much."""
    return _is_little(bare, best) and closed(bare.score, best.score) > 1.0 - NEGLIGIBLE_SHARE


def _apart_from_own(
    evidence: Evidence, bare: Explanation, alone: Explanation, found: Sequence[Explanation]
) -> list[Explanation]:
    """Return explanations but those whose further mode is the axis' own.

    Two modes at one frequency follow whatever the ring of a single one looks like, an instant
    later for one. That of a re-tuning ``alone`` is the simpler reason where it explains most.
    """
    apart = [one for one in found if not is_own_mode(evidence, one, one)]
    if closed(bare.score, alone.score) < MIN_ALMOST_COMPLETE_SHARE:
        return apart
    return [one for one in apart if not is_own_mode(evidence, alone, one)]


def _all_extended(
    evidence: Evidence,
    beam: Sequence[Explanation],
    own: Sequence[AxisEffect],
    bare: Explanation,
    account: Account,
    jobs: int,
) -> list[Explanation]:
    """Return the extensions of each explanation, up to one whose extension leaves next to nothing.

    Re-tuned parameters and none are both extended all the same.
    """
    found: list[Explanation] = []
    for begun in beam:
        found += _extended(evidence, begun, own, bare, account, jobs)
        if begun.causes and any(
            closed(bare.score, one.score) > 1.0 - NEGLIGIBLE_SHARE for one in found
        ):
            break
    return found


def _extended(
    evidence: Evidence,
    begun: Explanation,
    own: Sequence[AxisEffect],
    bare: Explanation,
    account: Account,
    jobs: int,
) -> list[Explanation]:
    """Return explanations with one more cause each."""
    named = set(begun.ids)
    free = [one for one in own if (one.id, one.from_axis) not in named]
    if not free:
        return []
    # No single further cause closes its share where less than that is left; only one that takes
    # nearly all of it away is looked for then, and that shows at once.
    slow = any(is_slow(evidence, cause) for cause in begun.causes)
    # Beside what takes long to simulate, only what closes its share is worth the runs.
    little = begun is not bare and _is_little(bare, begun, inf)
    account.tell("screening", None)
    first = scouts(evidence, free)
    looks = screened_beside(evidence, begun, first, account, jobs, briefly=little or slow)
    if little and min(one.cost for one in looks) > LARGE_SHARE * begun.score:
        return []
    most = _FITTED_LATER if begun.causes else _FITTED
    if slow:
        most = _FITTED_SLOWLY
    chosen = _chosen(looks, most)
    account.tell("fitting", chosen[0].id)
    found = fitted(evidence, [[*begun.causes, one] for one in chosen], account, jobs, begun)
    others = [_informed(one, found) for one in siblings(chosen, free) if one not in first]
    best = min(found, key=lambda one: one.fit.cost)
    if best.fit.cost < MAX_NOISE_POWER:
        # Other formulations, which take long, could do no better; but a curve bends to anything.
        others = [one for one in others if _is_bent_to(best, one, begun, found)]
    if others:
        slower = screened_beside(evidence, begun, others, account, jobs, briefly=True)
        least = min(one.fit.cost for one in found)
        worth = MIN_DOMINANT_SHARE_OF_REMAINDER if begun.causes else MAX_NEAR_SCORE_RATIO
        slower = [
            one
            for one in slower
            if one.cost < max(worth * least, MIN_SHARE_TO_NAME * _quick(one.effect, found))
        ]
        attempts = [[*begun.causes, one.effect] for one in slower]
        found += fitted(evidence, attempts, account, jobs, begun) if attempts else []
    return found


def _is_bent_to(
    best: Explanation, slow: AxisEffect, begun: Explanation, found: Sequence[Explanation]
) -> bool:
    """Tell whether a curve that explains a gap may but follow a slow form of a contact.

    Its quick form does much of it then.
    """
    imitates = kinship_of(best.causes[-1].id).family in kinship_of(slow.id).imitated_by
    return imitates and closed(begun.fit.cost, _quick(slow, found)) >= LARGE_SHARE


def _informed(slow: AxisEffect, found: Sequence[Explanation]) -> AxisEffect:
    """Return another form of an effect from where its first form was fitted, if it knows how.

    Any other is returned as it is.
    """
    begin = load_effect(slow.id).identification.from_other
    own = next((cause for one in found for cause in one.causes if cause.id == slow.id), None)
    if begin is None or own is None:
        return slow
    return replace(slow, parameters=dict(begin(own.parameters)))


def _quick(slow: AxisEffect, found: Sequence[Explanation]) -> float:
    """Return what the best fit of another form of an effect leaves; 0 if there is none."""
    costs = [one.fit.cost for one in found if (slow.id, slow.from_axis) in one.ids]
    return min(costs, default=0.0)


def _in_other_words(
    evidence: Evidence,
    bare: Explanation,
    begun: Explanation,
    own: Sequence[AxisEffect],
    tried: Sequence[Explanation],
    account: Account,
    jobs: int,
) -> list[Explanation]:
    """Return a set of causes that leaves a gap with other formulations, or twins, of its members.

    The one that did best alone need not do so beside the others.
    """
    if begun.score < MIN_NOTICEABLE_POWER or len(begun.causes) < 2:
        return []
    attempts = [
        [other if one is cause else one for one in begun.causes]
        for cause in begun.causes
        for other in (*siblings([cause], own), *_twins(cause, bare, begun, tried))
    ]
    return fitted(evidence, attempts, account, jobs, begun) if attempts else []


def _twins(
    cause: AxisEffect, bare: Explanation, begun: Explanation, tried: Sequence[Explanation]
) -> list[AxisEffect]:
    """Return effects that alone did about as well as a cause that alone did much."""
    alone = {one.ids[0]: one for one in reversed(tried) if len(one.causes) == 1}
    own = alone.get((cause.id, cause.from_axis))
    if own is None or closed(bare.score, own.score) < MIN_SHARE_TO_NAME:
        return []
    return [
        one.causes[0]
        for key, one in alone.items()
        if key not in begun.ids and one.score < MAX_CHANCE_SCORE_RATIO * own.score
    ]


def _chosen(looks: Sequence[Screened], most: int) -> list[AxisEffect]:
    """Return the best few effects, each by its two best formulations."""
    chosen: list[AxisEffect] = []
    taken: dict[tuple[str, str | None], int] = {}
    least = min(one.cost for one in looks)
    for one in sorted(looks, key=lambda one: one.cost):
        key = one.effect.id, one.effect.from_axis
        if key not in taken and len(taken) == most:
            continue
        if len(taken) >= 2 and one.cost > HOPELESS_SCORE_RATIO * least:
            continue
        if taken.setdefault(key, 0) < 2:
            taken[key] += 1
            chosen.append(one.effect)
    return chosen


def _unique(found: Sequence[Explanation]) -> list[Explanation]:
    """Return the best of each set of effects, best first.

    Of two formulations that do about as well, the one with the better chances elsewhere.
    """
    best: dict[tuple[tuple[str, str | None], ...], Explanation] = {}
    for one in sorted(found, key=_merit):
        best.setdefault(one.ids, one)
    return sorted(best.values(), key=lambda one: one.score)


def _unlike(found: Sequence[Explanation]) -> list[Explanation]:
    """Return explanations but those that leave the same as one before them.

    What extends one of these extends the other just as well: a lag of the sensor is one of the
    amplifier where no reference was recorded.
    """
    unlike: list[Explanation] = []
    for one in found:
        apart = [one.held_out - other.held_out for other in unlike]
        if all(
            float(gap @ gap) > (MAX_CHANCE_SCORE_RATIO - 1.0) * float(one.held_out @ one.held_out)
            for gap in apart
        ):
            unlike.append(one)
    return unlike


def _merit(one: Explanation) -> float:
    narrow = sum(cause.formulation in kinship_of(cause.id).narrow for cause in one.causes)
    return one.score * NARROW_FIT_SCORE_FACTOR**narrow


def _simplified(
    evidence: Evidence, enters: Callable[[Explanation, Explanation], bool], best: Explanation
) -> Explanation:
    """Take out, one after the other, causes without which the others do as well."""
    while len(best.causes) > 1:
        without = [_without(evidence, best, cause) for cause in best.causes]
        least = min(without, key=lambda one: one.score)
        if enters(least, best):
            break
        best = least
    return best


def _without(evidence: Evidence, best: Explanation, cause: AxisEffect) -> Explanation:
    """Return an explanation fitted on without one of its causes, from where the others are."""
    others = [one for one in best.causes if one is not cause]
    some = beside(evidence, others, best)
    again = fit(evidence, some, most_steps=MOST_STEPS, near=best.fit)
    return explanation(evidence, len(others), again)
