"""Elements that the corrected model keeps in addition to its causes.

Re-tuned own parameters take part in every fit, and absorb errors of an imperfect formula; so may
effects that are too uncertain to be named. On another motion they can do harm, so each stays only
if unseen data require it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from rotemina.sim.effects import EffectTrait, load_effect
from rotemina.sim.gap.compare.effect_candidates import scouts
from rotemina.sim.gap.compare.explanations import MOST_STEPS, Explanation, explanation, named_as
from rotemina.sim.gap.compare.forward_selection import possible_causes
from rotemina.sim.gap.compare.held_out_power import held_out_powers
from rotemina.sim.gap.compare.parallel_fits import fitted, screened_beside
from rotemina.sim.gap.compare.weights import weigh
from rotemina.sim.gap.fit import Evidence, fit, is_own
from rotemina.sim.gap.limits import MIN_NOTICEABLE_POWER
from rotemina.sim.gap.result import Account

_FITTED = 3  # effects that are compared in full
_NOT_FORETOLD = {EffectTrait.RANDOM, EffectTrait.LOCKED_TO_TIME}


def with_retained(
    evidence: Evidence,
    best: Explanation,
    fuller: Sequence[Explanation],
    account: Account,
    *,
    jobs: int,
) -> Explanation:
    """Return the explanation with the same causes and the likeliest additional elements.

    The ``fuller`` ones have the causes of ``best`` and additional, unnamed elements. One more
    effect is looked for beside the likeliest of them.
    """
    if not best.causes:
        return best
    kept = _kept(evidence, (best, *fuller))
    more = _with_one_more(evidence, kept, account, jobs)
    likeliest = _likeliest(evidence, (kept, *more))
    return kept if likeliest is kept else _kept(evidence, (likeliest,))


def _kept(evidence: Evidence, tried: Sequence[Explanation]) -> Explanation:
    """Return the likeliest explanation, without the re-tunings that unseen data do not require."""
    return _likeliest(evidence, [other for one in tried for other in _with_fewer(evidence, one)])


def _likeliest(evidence: Evidence, tried: Sequence[Explanation]) -> Explanation:
    numbers = [len(one.fit.effects) for one in tried]
    weights = weigh(held_out_powers(evidence, [one.held_out for one in tried]), numbers)
    return tried[int(np.argmax(weights))]


def _with_one_more(
    evidence: Evidence, best: Explanation, account: Account, jobs: int
) -> list[Explanation]:
    """Return the explanation with each of the few effects that lower its remainder most.

    What acts by time alone foretells nothing of another motion.
    """
    if best.score < MIN_NOTICEABLE_POWER:
        return []
    held = [one for one in best.fit.effects if not is_own(evidence, one)]
    begun = replace(best, causes=tuple(held))
    free = [
        one
        for one in possible_causes(evidence)
        if (one.id, one.from_axis) not in begun.ids
        and not load_effect(one.id).formulations[0].traits & _NOT_FORETOLD
    ]
    looks = screened_beside(evidence, begun, scouts(evidence, free), account, jobs, briefly=True)
    chosen = sorted(looks, key=lambda one: one.cost)[:_FITTED]
    attempts = [[*held, one.effect] for one in chosen]
    found = fitted(evidence, attempts, account, jobs, begun) if attempts else []
    return [named_as(one, best.ids) for one in found]


def _with_fewer(evidence: Evidence, best: Explanation) -> Iterator[Explanation]:
    """Give an explanation, and it with fewer re-tunings of the model's own parameters."""
    yield best
    causes, held = best.causes, best.fit.effects
    own = [one for one in held if one not in causes and is_own(evidence, one)]
    others = [one for one in held if one not in causes and one not in own]
    for count in range(len(own)):
        for kept in combinations(own, count):
            some = [*causes, *others, *kept]
            refitted = fit(evidence, some, most_steps=MOST_STEPS, near=best.fit)
            yield explanation(evidence, len(causes), refitted)
