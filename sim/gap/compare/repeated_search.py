"""What explains the gap of an axis, each look taking up what the one before has found."""

from collections.abc import Sequence

from rotemina.sim.effects import EffectSignature
from rotemina.sim.gap.compare.attribution import attributed
from rotemina.sim.gap.compare.explanations import (
    Explanation,
    counted_in,
    explain,
    untouched,
)
from rotemina.sim.gap.compare.forward_selection import Selection, select
from rotemina.sim.gap.compare.row_weights import huber_weighted
from rotemina.sim.gap.fit import Evidence, is_own
from rotemina.sim.gap.limits import (
    LARGE_SHARE,
    MAX_CHANCE_SCORE_RATIO,
    MAX_NEAR_SCORE_RATIO,
    MAX_NOISE_POWER,
    MIN_ALMOST_COMPLETE_SHARE,
    MIN_CAUSE_SHARE,
    MIN_DOMINANT_SHARE_OF_REMAINDER,
    MIN_GAP_POWER,
    MIN_NOTICEABLE_POWER,
)
from rotemina.sim.gap.noise import (
    Disturbance,
    power_by_tap,
    set_aside,
    wander,
)
from rotemina.sim.gap.result import Account, closed
from rotemina.sim.robot import AxisEffect

_LOOKS = 3  # for disturbances, beside what the one before explains

Found = tuple[Evidence, tuple[Disturbance, ...], Selection, Explanation]


def searched(whole: Evidence, account: Account, jobs: int) -> Found:
    """Return what explains the gap, each look taking up what the one before has found."""
    evidence, aside = set_aside(whole)
    found: Found = evidence, aside, *_explained(whole, evidence, aside, account, jobs)
    for look in (
        _looked_again,
        _without_false_jumps,
        _without_false_cells,
        _with_even_rows,
    ):
        found = look(whole, found, account, jobs)
    return found


def _looked_again(whole: Evidence, first: Found, account: Account, jobs: int) -> Found:
    """Return the findings after a second look without disturbances hidden by the first findings.

    Steps of a screw hide lost steps, and a coarse converter hides spikes of a sensor.
    """
    for _ in range(_LOOKS):
        _, aside, _, best = first
        acting = [one for one in best.fit.effects if acts(one)]
        if best.score < MAX_NOISE_POWER or not acting:
            break
        evidence, found = set_aside(whole, acting)
        if not _more(found, aside):
            break
        again = explain(evidence, [one for one in best.causes if not is_own(evidence, one)])
        if again.score > MIN_ALMOST_COMPLETE_SHARE * best.score:
            break  # what is set aside beside these causes hid nothing
        selection, better = _explained(whole, evidence, found, account, jobs)
        if better.score > LARGE_SHARE * best.score:
            break
        first = evidence, found, selection, better
    return first


def _without_false_jumps(whole: Evidence, first: Found, account: Account, jobs: int) -> Found:
    """Return the findings with jumps left in, if effects can explain the apparent lost steps.

    An axis that sticks and breaks loose also jumps, by the deflection of its drive; so does a loose
    axis, at every reversal by its play. Only these explanations count where little remains.
    """
    _, aside, _, best = first
    if best.score < MIN_NOTICEABLE_POWER or not any(
        one.sign is EffectSignature.JUMPS for one in aside
    ):
        return first
    evidence, others = set_aside(whole, jumps=False)
    second = evidence, others, *_explained(whole, evidence, others, account, jobs)
    simpler = closed(second[2].raw, second[3].score) >= 1.0 - MIN_CAUSE_SHARE
    return second if simpler or second[3].score < LARGE_SHARE * best.score else first


def _without_false_cells(whole: Evidence, first: Found, account: Account, jobs: int) -> Found:
    """Return the findings with steps as noise, if deviations beyond the cells are explained worse.

    Steps need not be even, and a sensor may drift between them.
    """
    evidence, _, selection, best = first
    share = closed(selection.raw, best.score)
    if not evidence.in_cells or share >= MIN_DOMINANT_SHARE_OF_REMAINDER:
        return first
    evidence, aside = set_aside(whole, cells=False)
    second = evidence, aside, *_explained(whole, evidence, aside, account, jobs)
    as_noise = not second[2].tried  # nothing is left beside it
    return second if as_noise or closed(second[2].raw, second[3].score) > share else first


def _with_even_rows(whole: Evidence, first: Found, account: Account, jobs: int) -> Found:
    """Return what is found once no rows count by more than what must be left around them.

    What is left where the machine does most else may decide for causes that only bend to it. Even
    rows may show others in their place, of those that were fitted before, but not more: cut down
    to the median, the gap makes small causes look large. A sensor that wanders leaves uneven rows
    by nature.
    """
    evidence, aside, tried, best = first
    if not best.ids or wander(evidence, best.fit.residual) is not None:
        return first
    even = huber_weighted(evidence, [one.held_out for one in (best, *tried.tried)])
    if even is None:
        return first
    counted = [counted_in(even, evidence, one) for one in tried.tried]
    near = MAX_NEAR_SCORE_RATIO * min(one.score for one in counted)
    begun = [one for one in counted if one.score < near and len(one.ids) <= len(best.ids)]
    own, *again = (
        explain(even, [cause for cause in one.causes if not is_own(even, cause)])
        for one in (best, *begun)
    )
    others = [one for one in again if not set(one.ids) <= set(best.ids)]
    other = min(others, key=lambda one: one.score, default=own)
    if other.score > LARGE_SHARE * own.score:
        return first
    bare, alone = untouched(even), explain(even, ())
    fits = sorted([own, *again, alone], key=lambda one: one.score)
    return even, aside, Selection(bare, alone, other, tuple(fits)), attributed(even, bare, other)


def _more(found: Sequence[Disturbance], before: Sequence[Disturbance]) -> bool:
    """Tell whether disturbances are others than before, or clearly more of them."""
    known = {one.sign: one.power for one in before}
    return any(one.power > MAX_CHANCE_SCORE_RATIO * known.get(one.sign, 0.0) for one in found)


def _explained(
    whole: Evidence,
    evidence: Evidence,
    aside: Sequence[Disturbance],
    account: Account,
    jobs: int,
) -> tuple[Selection, Explanation]:
    """Return the selection, and the best explanation with its own parameters as causes."""
    bare = untouched(evidence)
    if max(bare.by_tap.values()) < MIN_GAP_POWER:
        return Selection(bare, bare, bare, ()), bare
    # What readings leave beyond their steps is nothing that these leave of themselves.
    leaving = [
        one for one in aside if not (evidence.in_cells and one.sign is EffectSignature.STEPS)
    ]
    power = {
        tap: power * (whole.floor(tap) / evidence.floor(tap)) ** 2
        for tap, power in power_by_tap(whole, leaving).items()
    }
    selection = select(evidence, account, power, jobs=jobs)
    return selection, attributed(evidence, selection.bare, selection.best)


def acts(effect: AxisEffect) -> bool:
    """Tell whether an effect does anything."""
    return any(value != 0.0 for value in effect.parameters.values())
