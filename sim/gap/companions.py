"""What comes along with a cause by its nature, and is too small beside it to be found by itself.

The domains of a piezo's ceramic that make its hysteresis go on switching after a move: it creeps as
well (Devasia, Eleftheriou and Moheimani, A survey of control issues in nanopositioning, IEEE
Trans. Control Syst. Technol. 15 (2007) 802-823). Beside swings of a loop creep closes next to
nothing of the gap. What is asked of it here is much of what the loop leaves instead.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rotemina.sim.gap.attempts import fitted, looked_at
from rotemina.sim.gap.baseline import is_own
from rotemina.sim.gap.candidates import candidates, scouts
from rotemina.sim.gap.contest import Ranking
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.models import Explanation
from rotemina.sim.gap.progress import Account
from rotemina.sim.gap.rivals import rivals
from rotemina.sim.gap.selection import LEAST_SHARE, NOTICED
from rotemina.sim.gap.verdict import closed
from rotemina.sim.robot.model import AxisEffect

_COMPANIONS: Mapping[str, str] = {"hysteresis": "creep"}
_OF_SEEN = 0.8  # of what is left of seen data: it leaves no more, at first sight already
_OF_UNSEEN = 0.9  # the same of data that no fit saw
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
    """Return the explanation with what comes along with its causes, and the rivals of each cause.

    Where these leave so little that none could close its share, a companion takes much of it, and
    of unseen data more than any other candidate does. ``raw`` is the mean square of the gap over
    the floor.
    """
    if best.score < NOTICED or closed(raw, best.score) < 1.0 - LEAST_SHARE:
        return best, ranked
    for cause in best.causes:
        name = _COMPANIONS.get(cause.id)
        if name is None or (name, None) in best.ids:
            continue
        found = _beside_it(evidence, best, name, account, jobs)
        if not found:
            continue
        least = min(found, key=lambda one: one.score)
        key = name, None
        if key in least.ids and least.score <= _OF_UNSEEN * best.score:
            ranked = {**ranked, key: rivals(evidence, least, found, key, raw)}
            best = least
    return best, ranked


def _beside_it(
    evidence: Evidence, best: Explanation, name: str, account: Account, jobs: int
) -> list[Explanation]:
    """Return the explanation with a companion, and with the likeliest others in its place.

    There are none if the companion does not do enough at first sight.
    """
    causes = tuple(own for own in best.causes if not is_own(evidence, own))
    begun = replace(best, causes=causes)

    def looked(some: Sequence[AxisEffect]) -> list[AxisEffect]:
        looks = looked_at(evidence, begun, some, account, jobs, briefly=True)
        enough = [one for one in looks if one.cost <= _OF_SEEN * best.fit.cost]
        return [one.effect for one in sorted(enough, key=lambda one: one.cost)]

    companion = looked([AxisEffect(axis=evidence.axis, id=name)])
    if not companion:
        return []
    own = [one for one in candidates(evidence) if not is_own(evidence, one)]
    known = {*begun.ids, (name, None)}
    others = looked(scouts(evidence, [one for one in own if (one.id, one.from_axis) not in known]))
    attempts = [[*causes, one] for one in (*companion, *others[:_FITTED])]
    return [_named(one, best) for one in fitted(evidence, attempts, account, jobs, begun)]


def _named(one: Explanation, best: Explanation) -> Explanation:
    """Return an explanation with the model's own parameters as causes that were so before."""
    ids = {*best.ids, *one.ids}
    causes = [own for own in one.fit.effects if (own.id, own.from_axis) in ids]
    return replace(one, causes=tuple(causes))
