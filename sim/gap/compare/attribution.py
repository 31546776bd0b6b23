"""Which of the model's own parameters, re-tuned along with the causes, is a cause itself."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rotemina.sim.effects import EffectFamily
from rotemina.sim.gap.compare.explanations import Explanation, explanation, mean_squares
from rotemina.sim.gap.fit import Evidence, baseline, brought_along, fit, is_of, is_whole_own
from rotemina.sim.gap.limits import (
    MAX_NEAR_SCORE_RATIO,
    MIN_CAUSE_POWER,
    MIN_CAUSE_SHARE,
)
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

_REFITTED = 5
_SAME_MASS = 0.3  # relative difference of masses that are one


def attributed(evidence: Evidence, bare: Explanation, explained: Explanation) -> Explanation:
    """Return the explanation with those own parameters as causes that close their share alone.

    The others stay as small re-tunings that the causes bring along.
    """
    if explained is bare:
        return bare
    named = {cause.id for cause in explained.causes}
    fitted = {one.id for one in explained.fit.effects}  # a rival may be fitted without one of them
    own = [one for one in baseline(evidence) if one.id in fitted - named]
    heavier = _is_part_of_the_mass(explained)
    found = list(explained.causes)
    without = {one.id: _without(evidence, explained, one.id) for one in own}
    for one in own:
        if "viscous" in one.parameters:
            light = _with_another_mass(evidence, explained, one.id)
            without[one.id] = min(light, without[one.id], key=lambda one: one.score)
    for one in own:
        least = max([MIN_CAUSE_SHARE, *(brought_along(one.id, cause) for cause in named)])
        never = least >= 1.0 or (heavier and is_of(EffectFamily.GAIN, one.id))
        closes = closing(evidence, without[one.id], explained)
        if not never and _counts(bare, closes, least):
            found.append(_fitted(explained, one.id))
    if not found and own:
        # Either would do: the one without which most is left.
        most = max(own, key=lambda one: without[one.id].score)
        found.append(_fitted(explained, most.id))
    return replace(explained, causes=tuple(found))


def closing(evidence: Evidence, before: Explanation, after: Explanation) -> dict[Tap, float]:
    """Return the power over the floor that ``after`` closes more than ``before`` on unseen data.

    Only taps count where seen data show any of it. Where few rows show a parameter, a fit without
    them may go astray; what that loses on these rows tells nothing of a cause.
    """
    seen, still = (mean_squares(evidence, one.fit.residual) for one in (before, after))
    return {
        tap: before.by_tap[tap] - left
        for tap, left in after.by_tap.items()
        if seen[tap] - still[tap] >= MIN_CAUSE_POWER
    }


def without_own(
    evidence: Evidence,
    best: Explanation,
    tried: Sequence[Explanation],
    cause: tuple[str, str | None],
) -> list[Explanation]:
    """Return what was tried, fitted without the model's own parameter if that is the cause.

    The parameter takes part in every fit, so any explanation would otherwise do as well with it.
    """
    if not is_whole_own(cause[0]):
        return list(tried)
    others = [
        one for one in best.causes if (one.id, one.from_axis) != cause and not is_whole_own(one.id)
    ]
    rivals = [
        one
        for one in tried
        if len(one.causes) == len(others) + 1
        and not any(is_whole_own(own.id) for own in one.causes)
        and one.score < MAX_NEAR_SCORE_RATIO * best.score  # without, it does worse still
    ]
    return [
        replace(refitted, causes=refitted.fit.effects[: len(one.causes)])
        for one in sorted(rivals, key=lambda one: one.score)[:_REFITTED]
        for refitted in (_without(evidence, one, cause[0]),)
    ]


def _counts(bare: Explanation, closes: Mapping[Tap, float], least: float) -> bool:
    return any(
        power >= max(least * (bare.by_tap[tap] - 1.0), MIN_CAUSE_POWER)
        for tap, power in closes.items()
    )


def _is_part_of_the_mass(explained: Explanation) -> bool:
    """Tell whether a mass on a spring only duplicates the axis' own mass.

    An added share μ of mass is equivalent to a correspondingly higher gain: together they give the
    motion of the whole mass, of which a part is not rigid.
    """
    gain = _gain_of(explained)
    ratios = [
        one.parameters["mass_ratio"] for one in explained.causes if "mass_ratio" in one.parameters
    ]
    return any(abs(gain - ratio) < _SAME_MASS * ratio for ratio in ratios)


def _without(evidence: Evidence, explained: Explanation, name: str) -> Explanation:
    others = [one for one in explained.fit.effects if one.id != name]
    again = fit(evidence, others, most_steps=6, near=explained.fit)
    return explanation(evidence, len(explained.causes), again)


def _gain_of(explained: Explanation) -> float:
    """Return by how much the axis' own gain is re-tuned."""
    return sum(
        one.parameters["error"]
        for one in explained.fit.effects
        if is_whole_own(one.id) and is_of(EffectFamily.GAIN, one.id)
    )


def _with_another_mass(evidence: Evidence, explained: Explanation, friction: str) -> Explanation:
    """Return an explanation with the damping of a force axis with another mass.

    A wrong mass is a gain plus proportional damping: the damping force stays as it was.
    """
    effects = explained.fit.effects
    share = _gain_of(explained)
    inertia = evidence.robot.axes[evidence.axis].inertia
    damping = {"viscous": share * (inertia.damping if inertia else 0.0)}
    others = [one for one in effects if one.id != friction]
    left = evidence.residual([*others, replace(_fitted(explained, friction), parameters=damping)])
    return replace(explained, held_out=left, by_tap=mean_squares(evidence, left))


def _fitted(explanation: Explanation, name: str) -> AxisEffect:
    return next(one for one in explanation.fit.effects if one.id == name)
