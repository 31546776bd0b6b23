"""Conclusions about an axis: findings of an examination become causes, figures and remarks."""

import numpy as np

from rotemina.sim.effects import AttachedEffect, EffectSignature, EffectStage, load_effect
from rotemina.sim.gap.compare import (
    Explanation,
    LeftBy,
    at_tap,
    calibration,
    closing,
    paired_blocks,
    probability,
    rms,
    shrinkage,
)
from rotemina.sim.gap.examination import AxisExamination
from rotemina.sim.gap.fit import (
    Evidence,
    Part,
    block_rows,
    drawn_means,
    origin_remarks,
)
from rotemina.sim.gap.limits import MIN_NOTICEABLE_POWER
from rotemina.sim.gap.location import LocatedGap
from rotemina.sim.gap.noise import Disturbance
from rotemina.sim.gap.output import name_group
from rotemina.sim.gap.result import (
    CORRECTING_VERDICTS,
    UNKNOWN_EFFECT_ID,
    AxisDiagnosis,
    DerivedFigure,
    FittedParameter,
    GapCause,
    GapRemainder,
    GapVerdict,
    RankedCandidate,
    SuspectedEffect,
    closed,
)
from rotemina.sim.messages import (
    FieldList,
    Message,
    message,
)
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.units import format_percent

# A remark names at most this many groups of predictors.
_MAX_NAMED_GROUPS = 3
# Half width of a 95 % interval of a normal distribution, in standard deviations.
_INTERVAL_HALF_WIDTH = 1.96
# Step of a numerical derivative, relative to the size of the parameter.
_DERIVATIVE_STEP_RATIO = 1e-4
_MAX_LISTED_RIVALS = 8


def draw_conclusions(
    examination: AxisExamination, places: tuple[LocatedGap, ...], rng: np.random.Generator
) -> AxisDiagnosis:
    """Return the result for an axis from the findings of its examination.

    Parameters
    ----------
    examination : AxisExamination
    places : tuple of LocatedGap
        The gap of the axis at each of its taps.
    rng : Generator
        Random generator for the resampling that gives the intervals.
    """
    evidence, best = examination.evidence, examination.best
    is_explained = examination.verdict in CORRECTING_VERDICTS
    causes: list[GapCause] = []
    residual_left_by = LeftBy(evidence, best)
    if is_explained:
        causes = [
            _make_cause(examination, number, residual_left_by, rng)
            for number in range(len(best.causes))
        ]
        named_effects = {cause.effect for cause in causes}
        causes += [
            _make_disturbance_cause(examination, disturbance, disturbance.effect)
            for disturbance in examination.disturbances
            # Part of a fitted effect may also have been set aside as a disturbance. The effect is
            # named only once.
            if disturbance.effect is not None and disturbance.effect not in named_effects
        ]
        causes.sort(key=lambda cause: -cause.gap_before)
    elif examination.verdict is GapVerdict.UNKNOWN:
        causes = [_make_unknown_cause(examination, places, rng)]
    final_explanation = best if is_explained else examination.selection.retuned
    residual_left_by = residual_left_by if is_explained else LeftBy(evidence, final_explanation)
    return AxisDiagnosis(
        axis=evidence.axis,
        verdict=examination.verdict,
        places=places,
        causes=tuple(causes),
        shrinkage=tuple(
            shrinkage(
                evidence,
                examination.selection.retuned,
                final_explanation,
                examination.black_box,
                tap,
                rng,
                residual_left_by,
            )
            for tap in dict.fromkeys(place.tap for place in places if place.is_significant)
        ),
        ranking=_rank_candidates(examination, rng),
        remarks=_write_remarks(examination),
        fitted=examination.fitted,
        suspected=_list_suspected_effects(examination),
        remainder=_measure_remainder(examination, final_explanation),
    )


def _list_suspected_effects(examination: AxisExamination) -> tuple[SuspectedEffect, ...]:
    causes = {(effect.id, effect.from_axis) for effect in examination.best.causes}
    return tuple(
        SuspectedEffect(effect.id, effect.from_axis, calibration.shipped().suspected, in_model=True)
        for effect in examination.fitted
        if (effect.id, effect.from_axis) not in causes and effect not in examination.reading_steps
    )


def _measure_remainder(examination: AxisExamination, explanation: Explanation) -> GapRemainder:
    evidence = examination.evidence
    tap = _find_last_tap(evidence)
    rows, floor = at_tap(evidence, tap), evidence.floor(tap)
    remaining_power = float(np.mean(explanation.held_out[rows] ** 2))
    raw_power = float(np.mean(evidence.residual()[rows] ** 2))
    return GapRemainder(
        rms=floor * float(np.sqrt(max(remaining_power - 1.0, 0.0))),
        share=1.0 - closed(raw_power, remaining_power),
        depends_on=examination.probe.depends_on,
    )


def _find_last_tap(evidence: Evidence) -> Tap:
    return list(dict.fromkeys(part.tap for part in sorted(evidence.parts, key=_tap_order)))[-1]


def _tap_order(part: Part) -> int:
    return list(Tap).index(part.tap)


def _make_cause(
    examination: AxisExamination, index: int, residual_left_by: LeftBy, rng: np.random.Generator
) -> GapCause:
    evidence, best = examination.evidence, examination.best
    effect = best.causes[index]
    key = effect.id, effect.from_axis
    attached = AttachedEffect.of(evidence.robot, effect)
    before = residual_left_by(frozenset(range(len(best.causes))) - {index})
    tap = _find_first_tap(evidence, attached.effect.stage)
    tap_rows, floor = at_tap(evidence, tap), evidence.floor(tap)
    closed_share, interval = closing(evidence, before, best.held_out, tap, rng)
    weight = probability(examination.ranked[key], key)
    return GapCause(
        axis=evidence.axis,
        effect=effect.id,
        formulation=attached.formulation.name,
        stage=attached.effect.stage.value,
        tap=tap,
        from_axis=effect.from_axis,
        probability=_calibrate_probability(examination, weight),
        weight=weight,
        ambiguous_with=examination.ambiguous_with[key],
        gap_before=floor * rms(before[tap_rows]),
        gap_after=floor * rms(best.held_out[tap_rows]),
        closed=closed_share,
        closed_interval=interval,
        parameters=_list_parameters(evidence, best, effect),
        derived=derive_figures(evidence, best, effect),
    )


def _calibrate_probability(examination: AxisExamination, weight: float) -> float:
    causes = len(examination.best.causes) + len(examination.disturbances)
    return calibration.shipped().probability(weight, max(causes - 1, 0))


def _make_disturbance_cause(
    examination: AxisExamination, disturbance: Disturbance, effect_id: str
) -> GapCause:
    evidence, best = examination.evidence, examination.best
    # The power of a disturbance is in units of the declared floor squared.
    floor = examination.declared_floors[disturbance.tap]
    remaining = best.by_tap[disturbance.tap]
    if disturbance.sign is EffectSignature.WANDER:
        remaining = max(remaining - disturbance.power, 1.0)
    before = remaining + disturbance.power
    closed_share = closed(before, remaining)
    return GapCause(
        axis=evidence.axis,
        effect=effect_id,
        formulation=None,
        stage=load_effect(effect_id).stage.value,
        tap=disturbance.tap,
        from_axis=None,
        probability=_calibrate_probability(examination, 1.0),
        weight=1.0,
        ambiguous_with=(),
        gap_before=floor * float(np.sqrt(before)),
        gap_after=floor * float(np.sqrt(remaining)),
        closed=closed_share,
        closed_interval=(closed_share, closed_share),
    )


def _make_unknown_cause(
    examination: AxisExamination, places: tuple[LocatedGap, ...], rng: np.random.Generator
) -> GapCause:
    evidence = examination.evidence
    tap = next((place.tap for place in places if place.is_significant), places[-1].tap)
    tap_rows, floor = at_tap(evidence, tap), evidence.floor(tap)
    before, after = evidence.residual(), examination.best.held_out
    closed_share, interval = closing(evidence, before, after, tap, rng)
    remaining_share = 1.0 - closed(examination.selection.raw, examination.best.score)
    return GapCause(
        axis=evidence.axis,
        effect=UNKNOWN_EFFECT_ID,
        formulation=None,
        stage=None,
        tap=tap,
        from_axis=None,
        probability=float(np.clip(remaining_share, 0.5, 0.99)),
        ambiguous_with=(),
        gap_before=floor * rms(before[tap_rows]),
        gap_after=floor * rms(after[tap_rows]),
        closed=closed_share,
        closed_interval=interval,
    )


def _list_parameters(
    evidence: Evidence, best: Explanation, effect: AxisEffect
) -> tuple[FittedParameter, ...]:
    fitted = best.fit
    effect_index = next(
        index
        for index, candidate in enumerate(fitted.effects)
        if candidate is effect or candidate == effect
    )
    attached = AttachedEffect.of(evidence.robot, effect)
    if attached.formulation.by_spectra:
        # There are too many parameters to report, but the corrected model contains them.
        return ()
    deviation = fitted.deviation(block_rows(evidence))
    spreads = {
        free_parameter.name: (free_parameter.size, scaled_value, spread)
        for free_parameter, scaled_value, spread in zip(
            fitted.free, fitted.x, deviation, strict=True
        )
        if free_parameter.effect == effect_index
    }
    parameters = []
    for parameter in attached.formulation.parameters:
        size, scaled_value, spread = spreads.get(parameter.name, (1.0, 0.0, np.inf))
        lower_bound, upper_bound = parameter.bounds(attached.facts)
        low, high = (
            float(
                np.clip(
                    (scaled_value + sign * _INTERVAL_HALF_WIDTH * spread) * size,
                    lower_bound,
                    upper_bound,
                )
            )
            for sign in (-1.0, 1.0)
        )
        parameters.append(
            FittedParameter(
                name=parameter.name,
                value=attached.values[parameter.name],
                unit=parameter.unit_on(attached.facts),
                interval=(low, high) if np.isfinite(spread) else None,
                at_bound=fitted.at_bound.get((effect_index, parameter.name)),
            )
        )
    return tuple(parameters)


def derive_figures(
    evidence: Evidence, best: Explanation, effect: AxisEffect
) -> tuple[DerivedFigure, ...]:
    """Return the delay that a cause shares with related effects, or nothing if it causes none.

    The records determine this delay even if they cannot tell the related effects apart. Its
    interval follows from its gradient with respect to the fitted parameters.
    """
    lateness_s = load_effect(effect.id).identification.lateness_s
    if lateness_s is None:
        return ()
    fitted = best.fit
    effect_index = next(
        index
        for index, candidate in enumerate(fitted.effects)
        if candidate is effect or candidate == effect
    )
    values = AttachedEffect.of(evidence.robot, effect).values
    value = lateness_s(values)
    gradient = np.zeros(len(fitted.free))
    for column, free_parameter in enumerate(fitted.free):
        if free_parameter.effect == effect_index:
            shifted_value = lateness_s(
                {
                    **values,
                    free_parameter.name: values[free_parameter.name]
                    + _DERIVATIVE_STEP_RATIO * free_parameter.size,
                }
            )
            gradient[column] = (shifted_value - value) / _DERIVATIVE_STEP_RATIO
    (spread,) = fitted.deviation_along(gradient[None, :], block_rows(evidence))
    if not np.isfinite(spread):
        return ()
    interval = (
        max(value - _INTERVAL_HALF_WIDTH * spread, 0.0),
        value + _INTERVAL_HALF_WIDTH * spread,
    )
    return (DerivedFigure("lateness", float(value), interval, "s"),)


def _find_first_tap(evidence: Evidence, stage: EffectStage) -> Tap:
    """Return the first measured tap downstream of a stage, or else the last measured tap."""
    first_tap_index = {
        EffectStage.ELECTRONICS: 0,
        EffectStage.ACTUATOR: 1,
        EffectStage.MECHANICS: 1,
        EffectStage.SENSOR: 2,
    }
    taps = [Tap.U, Tap.REF, Tap.MEAS]
    measured = {tap for observation in evidence.observations for tap in observation.taps}
    downstream = [tap for tap in taps[first_tap_index[stage] :] if tap in measured]
    return downstream[0] if downstream else next(tap for tap in reversed(taps) if tap in measured)


def _rank_candidates(
    examination: AxisExamination, rng: np.random.Generator
) -> tuple[RankedCandidate, ...]:
    evidence, best = examination.evidence, examination.best
    if not best.causes:
        return ()
    leading_cause = (best.causes[0].id, best.causes[0].from_axis)
    tap = next(reversed(evidence.observations[0].taps))
    candidates = []
    for rival in examination.ranked[leading_cause][:_MAX_LISTED_RIVALS]:
        held_out = rival.explanation.held_out
        drawn_rms = np.sqrt(drawn_means(paired_blocks(evidence, [held_out], tap), rng)[:, 0])
        low, high = np.percentile(drawn_rms, [2.5, 97.5])
        formulation = next(
            (c.formulation for c in rival.explanation.causes if c.id == rival.effect), None
        )
        candidates.append(
            RankedCandidate(
                effect=rival.effect,
                formulation=formulation,
                from_axis=rival.from_axis,
                probability=_calibrate_probability(examination, rival.probability),
                held_out_rms=rms(held_out[at_tap(evidence, tap)]),
                held_out_interval=(float(low), float(high)),
            )
        )
    return tuple(candidates)


def _write_remarks(examination: AxisExamination) -> tuple[Message, ...]:
    best, probe = examination.best, examination.probe
    texts = (
        *(disturbance.note for disturbance in examination.disturbances),
        *origin_remarks(examination.evidence),
    )
    if best.score <= MIN_NOTICEABLE_POWER or not probe.depends_on:
        return texts
    group_share = message("gap", "{group} ({percent})")
    groups = FieldList(
        tuple(
            group_share.fill(group=name_group(name), percent=format_percent(predicted_share, 2))
            for name, predicted_share in probe.depends_on[:_MAX_NAMED_GROUPS]
        )
    )
    sentence = message("gap", "Judging by simple features, the rest depends on {groups}.")
    return (*texts, sentence.fill(groups=groups))
