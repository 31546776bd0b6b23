"""One axis examined: screened, fitted, selected, judged."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Stage
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.gap.attribution import attributed, without_own
from rotemina.sim.gap.baseline import GAIN, is_own
from rotemina.sim.gap.blocks import drawn_means
from rotemina.sim.gap.diagnosis import (
    UNKNOWN,
    AxisDiagnosis,
    Cause,
    FittedParameter,
    Ranked,
    Verdict,
)
from rotemina.sim.gap.disturbances import Disturbance, by_effect, set_aside, wander
from rotemina.sim.gap.evidence import Evidence, block_rows
from rotemina.sim.gap.models import Explanation, explain, mean_squares, untouched
from rotemina.sim.gap.probe import Probe, probed
from rotemina.sim.gap.richness import alike_axes, is_poor
from rotemina.sim.gap.rivals import Key, Rival, not_ruled_out, paired_blocks, rivals
from rotemina.sim.gap.selection import (
    CLEARLY,
    LEAST_POWER,
    LEAST_SHARE,
    NOTICED,
    Selection,
    select,
)
from rotemina.sim.gap.shrinkage import at_tap, closing, floor_of, rms, shrinkage
from rotemina.sim.gap.verdict import closed, decide
from rotemina.sim.gap.where import Place
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect

_SURE = 1.96  # standard deviations of a 95 % interval
_GAP = 1.5  # mean square over the floor from which there is something to explain
_TWINS = {
    "gain_error": ("sensor_gain",),
    "static_nonlinearity": ("sensor_nonlinearity",),
    "amplifier_lag": ("sensor_lag",),
    "delay": ("sensor_lag",),
    "leadscrew_error": ("encoder_interpolation",),
    "microstep_error": ("encoder_interpolation",),
}
_DOUBTED = 0.1  # probability below which one cause of several is none
_BESIDE_A_WANDER = 0.3  # of the gap's power, that a cause closes at least
_LIKELIER = 0.6  # probability from which a rival takes a cause's place
_NEAR = 4.0  # times the best score, up to which a re-tuning alone is a rival
_NOT_NOISE = 0.6  # of a raised floor's power: a fit that leaves less shows that it was no noise
_SURE_OF_DISTURBANCES = 0.95
_RANKED = 8  # rivals that are listed

Told = Callable[[str, str | None], None]


@dataclass(frozen=True, eq=False)
class Examination:
    """What was found on an axis, before it is put into words.

    ``evidence`` is without what was set aside; ``disturbances`` are what of that counts.
    """

    evidence: Evidence
    disturbances: tuple[Disturbance, ...]
    selection: Selection
    best: Explanation
    verdict: Verdict
    ranked: dict[Key, tuple[Rival, ...]]
    probe: Probe

    @property
    def fitted(self) -> tuple[AxisEffect, ...]:
        """What corrects the model: the causes and the small re-tuning that they bring along."""
        if self.verdict is not Verdict.EXPLAINED or not self.best.causes:
            return ()
        return tuple(one for one in self.best.fit.effects if _acts(one))


def examine(whole: Evidence, told: Told, *, jobs: int = 1) -> Examination:
    """Look for the causes of an axis' gap."""
    evidence, aside = set_aside(whole)
    selection, best = _explained(evidence, told, jobs)
    raised = [one for one in aside if one.effect == "sensor_noise"]
    if raised and best.fit.cost < _NOT_NOISE:
        # What seemed noise was explained: the sensor is as good as declared.
        aside = tuple(one for one in aside if one.effect != "sensor_noise")
        evidence = evidence.with_observations(
            [
                replace(own, floor=was.floor)
                for own, was in zip(evidence.observations, whole.observations, strict=True)
            ]
        )
        selection, best = _explained(evidence, told, jobs)
    told("deciding", None)
    drift = wander(evidence, best.fit.residual)
    disturbances = _counting(whole, evidence, best, [*aside, *([drift] if drift else [])])
    ranked = _ranked(evidence, selection, best)
    likelier = _likelier(ranked)
    if likelier is not None:
        best = attributed(evidence, selection.bare, likelier)
        ranked = _ranked(evidence, selection, best)
    doubted = [key for key, own in ranked.items() if _probability(own, key) < _DOUBTED]
    if drift:
        doubted += [key for key in best.ids if _bends_to(evidence, best, key)]
    if doubted and (len(best.causes) > 1 or drift):
        # Several others would do as well in its place: it stands for what the rest leaves.
        kept = [one for one in best.causes if (one.id, one.from_axis) not in doubted]
        best = _with_only(evidence, selection, kept)
        ranked = _ranked(evidence, selection, best)
    ambiguous = [not_ruled_out(ranked[key], key) for key in best.ids]
    power = sum(one.power for one in disturbances)
    wandered = sum(one.power for one in disturbances if one.effect == "sensor_drift")
    verdict = decide(selection.raw + power - wandered, max(best.score - wandered, 1.0), ambiguous)
    if is_poor(whole) and verdict is not Verdict.NONE and not disturbances:
        verdict = Verdict.INSUFFICIENT
    return Examination(
        evidence,
        disturbances,
        selection,
        best,
        verdict,
        ranked,
        probed(evidence, best.held_out),
    )


def _likelier(ranked: Mapping[Key, Sequence[Rival]]) -> Explanation | None:
    """Return the explanation with a rival in the place of a cause, if that is by far likelier.

    It does about as well with fewer parameters.
    """
    found = [own[0] for key, own in ranked.items() if (own[0].effect, own[0].from_axis) != key]
    surest = max(found, key=lambda one: one.probability, default=None)
    return None if surest is None or surest.probability < _LIKELIER else surest.explanation


def _bends_to(evidence: Evidence, best: Explanation, key: Key) -> bool:
    """Tell whether a cause closes so little beside a wander that it may only follow that."""
    others = [one for one in best.causes if (one.id, one.from_axis) != key]
    before = float(np.mean(evidence.residual(others) ** 2))
    return closed(before, best.score) < _BESIDE_A_WANDER


def _with_only(
    evidence: Evidence, selection: Selection, kept: Sequence[AxisEffect]
) -> Explanation:
    """Return the explanation by some of the causes."""
    if not kept:
        return selection.bare
    causes = [one for one in kept if not is_own(evidence, one)]
    return attributed(evidence, selection.bare, explain(evidence, causes))


def _ranked(
    evidence: Evidence, selection: Selection, best: Explanation
) -> dict[Key, tuple[Rival, ...]]:
    """Return the rivals of each cause of an explanation."""
    tried = _with_twins(evidence, best, _with_retuned(evidence, selection, best))
    return {
        key: rivals(evidence, best, without_own(evidence, best, tried, key), key, selection.raw)
        for key in best.ids
    }


def _probability(ranked: Sequence[Rival], key: Key) -> float:
    return next(one.probability for one in ranked if (one.effect, one.from_axis) == key)


def _explained(evidence: Evidence, told: Told, jobs: int) -> tuple[Selection, Explanation]:
    """Return the selection, and the best explanation with its own parameters as causes."""
    bare = untouched(evidence)
    if max(bare.by_tap.values()) < _GAP:
        return Selection(bare, bare, bare, ()), bare
    selection = select(evidence, told, jobs=jobs)
    return selection, attributed(evidence, selection.bare, selection.best)


def _with_retuned(
    evidence: Evidence, selection: Selection, best: Explanation
) -> tuple[Explanation, ...]:
    """Return what was tried, the model's own parameters by name if they come near."""
    if not selection.tried or selection.retuned.score > _NEAR * best.score:
        return selection.tried
    named = attributed(evidence, selection.bare, selection.retuned)
    others = [one for one in selection.tried if one is not selection.retuned]
    return (*others, replace(named, causes=named.causes[:1]))


def _with_twins(
    evidence: Evidence, best: Explanation, tried: Sequence[Explanation]
) -> tuple[Explanation, ...]:
    """Add what does much the same as a cause, if it was not tried.

    The sensor, where no reference was recorded; another axis that moved alike, for a gain.
    """
    more = list(tried)
    for cause in best.causes:
        own = is_own(evidence, cause)
        others = [one for one in best.causes if one is not cause and not is_own(evidence, one)]
        for asked in _twins(evidence, cause):
            if any((asked.id, asked.from_axis) in one.ids for one in tried) and not own:
                continue
            more.append(explain(evidence, [*others, asked]))
    return tuple(more)


def _twins(evidence: Evidence, cause: AxisEffect) -> list[AxisEffect]:
    found = []
    if not evidence.has(Tap.REF):
        for twin in _TWINS.get(cause.id, ()):
            found.append(AxisEffect(axis=evidence.axis, id=twin, parameters=_alike(cause, twin)))
    if cause.id == GAIN:
        for axis, k in alike_axes(evidence).items():
            numbers = {"k": k * cause.parameters["error"]}
            found.append(
                AxisEffect(
                    axis=evidence.axis, id="cross_coupling", from_axis=axis, parameters=numbers
                )
            )
    return found


def _alike(cause: AxisEffect, twin: str) -> dict[str, float]:
    """Return the numbers of a cause that its twin has too."""
    names = {parameter.name for parameter in effect_named(twin).formulations[0].parameters}
    return {name: value for name, value in cause.parameters.items() if name in names}


def _counting(
    whole: Evidence, evidence: Evidence, best: Explanation, found: Sequence[Disturbance]
) -> tuple[Disturbance, ...]:
    """Return the disturbances that are a cause: each closes its share, or clearly what is left."""
    raw = mean_squares(whole, whole.residual())
    by_tap = {
        tap: mean
        + sum(one.power for one in found if one.tap is tap and one.effect != "sensor_drift")
        for tap, mean in best.by_tap.items()
    }
    counting = []
    for one in by_effect(found):
        left = by_tap[one.tap] - 1.0
        share = one.power >= LEAST_SHARE * (raw[one.tap] - 1.0)
        if one.power >= LEAST_POWER and (share or one.power >= CLEARLY * left):
            counting.append(one)
    return tuple(counting)


def told_of(
    examination: Examination, places: tuple[Place, ...], rng: np.random.Generator
) -> AxisDiagnosis:
    """Put an examination into words and numbers."""
    evidence, best = examination.evidence, examination.best
    explained = examination.verdict is Verdict.EXPLAINED
    causes: list[Cause] = []
    if explained:
        causes = [_cause(examination, number, rng) for number in range(len(best.causes))]
        causes += [_disturbance(examination, one) for one in examination.disturbances]
        causes.sort(key=lambda one: -one.gap_before)
    elif examination.verdict is Verdict.UNKNOWN:
        causes = [_unknown(examination, places, rng)]
    shown = best if explained else examination.selection.retuned
    return AxisDiagnosis(
        axis=evidence.axis,
        verdict=examination.verdict,
        places=places,
        causes=tuple(causes),
        shrinkage=tuple(
            shrinkage(evidence, examination.selection.retuned, shown, examination.probe, tap, rng)
            for tap in dict.fromkeys(place.tap for place in places if place.significant)
        ),
        ranking=_ranking(examination, rng),
        remarks=_remarks(examination),
        fitted=examination.fitted,
    )


def _cause(examination: Examination, number: int, rng: np.random.Generator) -> Cause:
    evidence, best = examination.evidence, examination.best
    asked = best.causes[number]
    key = asked.id, asked.from_axis
    attached = Attached.of(evidence.robot, asked)
    others = [one for one in best.causes if one is not asked]
    before = evidence.residual(others)
    tap = _first_tap(evidence, attached.effect.stage)
    shown, floor = at_tap(evidence, tap), floor_of(evidence, tap)
    share, interval = closing(evidence, before, best.held_out, tap, rng)
    ranked = examination.ranked[key]
    return Cause(
        axis=evidence.axis,
        effect=asked.id,
        formulation=attached.formulation.name,
        stage=attached.effect.stage.value,
        tap=tap,
        from_axis=asked.from_axis,
        probability=_probability(ranked, key),
        ambiguous_with=not_ruled_out(ranked, key),
        gap_before=floor * rms(before[shown]),
        gap_after=floor * rms(best.held_out[shown]),
        closed=share,
        closed_interval=interval,
        parameters=_parameters(evidence, best, asked),
    )


def _disturbance(examination: Examination, one: Disturbance) -> Cause:
    evidence, best = examination.evidence, examination.best
    floor = floor_of(evidence, one.tap)
    left = best.by_tap[one.tap]
    if one.effect == "sensor_drift":
        left = max(left - one.power, 1.0)
    before = left + one.power
    share = closed(before, left)
    return Cause(
        axis=evidence.axis,
        effect=one.effect,
        formulation=None,
        stage=effect_named(one.effect).stage.value,
        tap=one.tap,
        from_axis=None,
        probability=_SURE_OF_DISTURBANCES,
        ambiguous_with=(),
        gap_before=floor * float(np.sqrt(before)),
        gap_after=floor * float(np.sqrt(left)),
        closed=share,
        closed_interval=(share, share),
    )


def _unknown(
    examination: Examination, places: tuple[Place, ...], rng: np.random.Generator
) -> Cause:
    evidence = examination.evidence
    tap = next((one.tap for one in places if one.significant), places[-1].tap)
    shown, floor = at_tap(evidence, tap), floor_of(evidence, tap)
    before, after = evidence.residual(), examination.best.held_out
    share, interval = closing(evidence, before, after, tap, rng)
    left = 1.0 - closed(examination.selection.raw, examination.best.score)
    return Cause(
        axis=evidence.axis,
        effect=UNKNOWN,
        formulation=None,
        stage=None,
        tap=tap,
        from_axis=None,
        probability=float(np.clip(left, 0.5, 0.99)),
        ambiguous_with=(),
        gap_before=floor * rms(before[shown]),
        gap_after=floor * rms(after[shown]),
        closed=share,
        closed_interval=interval,
    )


def _parameters(
    evidence: Evidence, best: Explanation, asked: AxisEffect
) -> tuple[FittedParameter, ...]:
    fitted = best.fit
    number = next(n for n, one in enumerate(fitted.effects) if one is asked or one == asked)
    attached = Attached.of(evidence.robot, asked)
    deviation = fitted.deviation(block_rows(evidence))
    told = []
    for free, x, spread in zip(fitted.free, fitted.x, deviation, strict=True):
        if free.effect != number:
            continue
        parameter = attached.formulation.parameter(free.name)
        assert parameter is not None
        low, high = (float((x + sign * _SURE * spread) * free.size) for sign in (-1.0, 1.0))
        told.append(
            FittedParameter(
                name=free.name,
                value=asked.parameters[free.name],
                unit=parameter.unit_on(attached.facts),
                interval=(low, high) if np.isfinite(spread) else None,
                at_bound=fitted.at_bound.get((number, free.name)),
            )
        )
    return tuple(told)


def _first_tap(evidence: Evidence, stage: Stage) -> Tap:
    """Return the first tap behind a stage that was measured."""
    order = {Stage.ELECTRONICS: 0, Stage.ACTUATOR: 1, Stage.MECHANICS: 1, Stage.SENSOR: 2}
    taps = [Tap.U, Tap.REF, Tap.MEAS]
    measured = {tap for observation in evidence.observations for tap in observation.taps}
    behind = [tap for tap in taps[order[stage] :] if tap in measured]
    return behind[0] if behind else next(tap for tap in reversed(taps) if tap in measured)


def _ranking(examination: Examination, rng: np.random.Generator) -> tuple[Ranked, ...]:
    evidence, best = examination.evidence, examination.best
    if not best.causes:
        return ()
    leading = (best.causes[0].id, best.causes[0].from_axis)
    tap = next(reversed(evidence.observations[0].taps))
    told = []
    for one in examination.ranked[leading][:_RANKED]:
        left = one.explanation.held_out
        drawn = np.sqrt(drawn_means(paired_blocks(evidence, [left], tap), rng)[:, 0])
        low, high = np.percentile(drawn, [2.5, 97.5])
        formulation = next(
            (c.formulation for c in one.explanation.causes if c.id == one.effect), None
        )
        told.append(
            Ranked(
                effect=one.effect,
                formulation=formulation,
                from_axis=one.from_axis,
                probability=one.probability,
                held_out_rms=rms(left[at_tap(evidence, tap)]),
                held_out_interval=(float(low), float(high)),
            )
        )
    return tuple(told)


def _remarks(examination: Examination) -> tuple[str, ...]:
    best, probe = examination.best, examination.probe
    said = tuple(one.note for one in examination.disturbances)
    if best.score <= NOTICED or not probe.depends_on:
        return said
    groups = ", ".join(f"{name} ({share:.0%})" for name, share in probe.depends_on[:3])
    return (
        *said,
        f"What is left depends on {groups}, as far as simple features predict it.",
    )


def _acts(effect: AxisEffect) -> bool:
    return any(value != 0.0 for value in effect.parameters.values())
