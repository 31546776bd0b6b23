"""Effects that accompany a cause and are too small to be found alone.

The ceramic domains of a piezo that cause its hysteresis go on switching after a move, so the piezo
also creeps (Devasia, Eleftheriou and Moheimani, A survey of control issues in nanopositioning, IEEE
Trans. Control Syst. Technol. 15 (2007) 802-823). Compared with large loops, creep closes almost
nothing of the gap; it must instead close much of the remainder of the loop.
"""

from collections.abc import Sequence
from dataclasses import replace

from rotemina.sim.gap.compare.cause_contest import Ranking
from rotemina.sim.gap.compare.effect_candidates import scouts
from rotemina.sim.gap.compare.explanations import Explanation, named_as
from rotemina.sim.gap.compare.forward_selection import possible_causes
from rotemina.sim.gap.compare.parallel_fits import fitted, screened_beside
from rotemina.sim.gap.compare.rivals import Key, rivals
from rotemina.sim.gap.fit import Evidence, catalogue, is_own, kinship_of
from rotemina.sim.gap.limits import (
    MIN_ALMOST_COMPLETE_SHARE,
    MIN_CAUSE_SHARE,
    MIN_DOMINANT_SHARE_OF_REMAINDER,
    MIN_NOTICEABLE_POWER,
)
from rotemina.sim.gap.result import Account, closed
from rotemina.sim.robot import AxisEffect

_FITTED = 4  # of what else might be there, that are compared in full


def accompanied(
    evidence: Evidence,
    best: Explanation,
    ranked: Ranking,
    raw: float,
    account: Account,
    *,
    jobs: int,
) -> tuple[Explanation, Ranking]:
    """Return the explanation with creep in addition to hysteresis if present, and the rivals.

    The causes leave too little for another cause to close its share. Creep must therefore close
    much of that remainder, and more of the unseen data than any other candidate. ``raw`` is the
    mean square of the gap over the floor.
    """
    companion = _companion(best)
    if companion is None or companion in best.ids:
        return best, ranked
    if best.score < MIN_NOTICEABLE_POWER or closed(raw, best.score) < 1.0 - MIN_CAUSE_SHARE:
        return best, ranked
    found = _with_one_more(evidence, best, companion, account, jobs)
    least = min(found, key=lambda one: one.score, default=best)
    if companion not in least.ids or least.score > MIN_ALMOST_COMPLETE_SHARE * best.score:
        return best, ranked
    return least, {**ranked, companion: rivals(evidence, least, found, companion, raw)}


def _companion(best: Explanation) -> Key | None:
    """Return what comes with one of the causes by its nature."""
    families = {kinship_of(name).accompanied_by for name, source in best.ids if source is None}
    families.discard(None)
    return next(((one.id, None) for one in catalogue() if one.kinship.family in families), None)


def _with_one_more(
    evidence: Evidence, best: Explanation, companion: Key, account: Account, jobs: int
) -> list[Explanation]:
    """Return the explanation with the companion, and with its likeliest alternatives.

    Return none if the companion does too little in the first look.
    """
    causes = tuple(own for own in best.causes if not is_own(evidence, own))
    begun = replace(best, causes=causes)

    def looked(some: Sequence[AxisEffect]) -> list[AxisEffect]:
        looks = screened_beside(evidence, begun, some, account, jobs, briefly=True)
        enough = [
            one for one in looks if one.cost <= MIN_DOMINANT_SHARE_OF_REMAINDER * best.fit.cost
        ]
        return [one.effect for one in sorted(enough, key=lambda one: one.cost)]

    own = looked([AxisEffect(axis=evidence.axis, id=companion[0])])
    if not own:
        return []
    known = {*begun.ids, companion}
    others = [one for one in possible_causes(evidence) if (one.id, one.from_axis) not in known]
    chosen = [*own, *looked(scouts(evidence, others))[:_FITTED]]
    attempts = [[*causes, one] for one in chosen]
    return [
        named_as(one, {*best.ids, *one.ids})  # with own parameters as causes that were so before
        for one in fitted(evidence, attempts, account, jobs, begun)
    ]
