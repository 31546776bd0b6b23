"""Which effects explain the gap of an axis: forward selection on data that no fit has seen."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from joblib import Parallel, delayed

from rotemina.sim.gap.baseline import GAIN, RESONANCE
from rotemina.sim.gap.candidates import candidates
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import fit
from rotemina.sim.gap.models import Explanation, beside, explain
from rotemina.sim.gap.screening import Screened, screen
from rotemina.sim.robot.model import AxisEffect

MOST_CAUSES = 3
LEAST_SHARE = 0.03  # of the gap's power, that a cause must close
CLEARLY = 0.8  # of what others leave: so much closed counts, however small a share of the gap
NOTICED = 2.0  # mean square over the floor from which what others leave may have a cause
_FITTED = 6  # effects that are fitted in full after screening
_FITTED_LATER = 4
_BEAM = 2  # explanations that are extended
_ALSO = 4.0  # times the score of the best, up to which another is extended
_HOPELESS = 30.0  # times the cost of the best candidate
_LEAST_PROMISE = 0.5  # of the score: a best candidate that leaves more is no clear cause

Told = Callable[[str, str | None], None]


@dataclass(frozen=True, eq=False)
class Selection:
    """What was tried on an axis, and what was found.

    ``raw`` is the mean square of the gap over the floor; ``retuned`` the explanation without
    causes, by the model's own parameters; ``tried`` holds all explanations, best first.
    """

    raw: float
    retuned: Explanation
    best: Explanation
    tried: tuple[Explanation, ...]


def select(evidence: Evidence, told: Told, *, jobs: int = 1) -> Selection:
    """Find the causes of an axis' gap, the model's own parameters being re-tuned beside them.

    ``told`` hears stage and candidate.
    """
    own = [one for one in candidates(evidence) if one.id not in (GAIN, RESONANCE)]
    bare = fit(evidence, beside(evidence, ()), most_steps=0)
    raw = bare.cost
    retuned = explain(evidence, ())
    best, beam, tried = retuned, [Explanation((), bare, bare.residual)], [retuned]
    for level in range(MOST_CAUSES):
        found: list[Explanation] = []
        for begun in beam:
            found += _extended(evidence, begun, own, raw, told, jobs)
        found = _unique([*found, *([retuned] if level == 0 else [])])
        tried += [one for one in found if one is not retuned]
        if not found or not (level == 0 or enters(raw, best.score, found[0].score)):
            break
        best = found[0]
        beam = [one for one in found[:_BEAM] if one.score < _ALSO * best.score]
        if best.score < NOTICED:
            break
    simplest = _simplified(evidence, raw, best)
    return Selection(raw, retuned, simplest, tuple(sorted(tried, key=lambda one: one.score)))


def enters(raw: float, before: float, after: float) -> bool:
    """Tell whether a cause that lowers the mean square over the floor by this much is one."""
    closed = before - after
    share = closed >= LEAST_SHARE * (raw - 1.0)
    clear = before >= NOTICED and closed >= CLEARLY * (before - 1.0)
    return share or clear


def _extended(
    evidence: Evidence,
    begun: Explanation,
    own: Sequence[AxisEffect],
    raw: float,
    told: Told,
    jobs: int,
) -> list[Explanation]:
    """Return explanations with one more cause each."""
    named = set(begun.ids)
    scouts = [one for one in own if (one.id, one.from_axis) not in named]
    told("screening", None)
    screened: list[Screened] = Parallel(n_jobs=jobs, prefer="threads")(
        delayed(screen)(evidence, begun.fit, one) for one in scouts
    )
    least = min(one.cost for one in screened)
    if begun.causes:
        # No single further cause closes its share where less than that is left.
        small = begun.score - 1.0 < LEAST_SHARE * (raw - 1.0)
        if small and least > _LEAST_PROMISE * begun.score:
            return []
    chosen = _chosen(screened, _FITTED_LATER if begun.causes else _FITTED)
    told("fitting", chosen[0].id)
    return list(
        Parallel(n_jobs=jobs, prefer="threads")(
            delayed(explain)(evidence, [*begun.causes, one]) for one in chosen
        )
    )


def _chosen(screened: Sequence[Screened], most: int) -> list[AxisEffect]:
    """Return the best few effects, each by its two best formulations."""
    chosen: list[AxisEffect] = []
    taken: dict[tuple[str, str | None], int] = {}
    least = min(one.cost for one in screened)
    for one in sorted(screened, key=lambda one: one.cost):
        key = one.effect.id, one.effect.from_axis
        if key not in taken and len(taken) == most:
            continue
        if len(taken) >= 2 and one.cost > _HOPELESS * least:
            continue
        if taken.setdefault(key, 0) < 2:
            taken[key] += 1
            chosen.append(one.effect)
    return chosen


def _unique(found: Sequence[Explanation]) -> list[Explanation]:
    """Return the best of each set of effects, best first."""
    best: dict[tuple[tuple[str, str | None], ...], Explanation] = {}
    for one in sorted(found, key=lambda one: one.score):
        best.setdefault(one.ids, one)
    return list(best.values())


def _simplified(evidence: Evidence, raw: float, best: Explanation) -> Explanation:
    """Take out, one after the other, causes without which the others do as well."""
    while len(best.causes) > 1:
        without = [
            explain(evidence, [one for one in best.causes if one is not cause])
            for cause in best.causes
        ]
        least = min(without, key=lambda one: one.score)
        if enters(raw, least.score, best.score):
            break
        best = least
    return best
