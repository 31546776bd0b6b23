"""What is said of an axis: an examination in words and numbers."""

import numpy as np

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Stage
from rotemina.sim.effects.identification import Sign
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.gap.compare import calibration
from rotemina.sim.gap.compare.closed_share import closed
from rotemina.sim.gap.compare.explanations import Explanation
from rotemina.sim.gap.compare.rivals import paired_blocks, probability
from rotemina.sim.gap.compare.shrinkage import LeftBy, at_tap, closing, rms, shrinkage
from rotemina.sim.gap.diagnosis import (
    CORRECTING,
    UNKNOWN,
    AxisDiagnosis,
    Cause,
    Derived,
    FittedParameter,
    Ranked,
    Remainder,
    Suspected,
    Verdict,
)
from rotemina.sim.gap.examination import Examination
from rotemina.sim.gap.fit.evidence import Evidence, Part, block_rows
from rotemina.sim.gap.fit.position_origins import origin_remarks
from rotemina.sim.gap.fit.row_blocks import drawn_means
from rotemina.sim.gap.location.located_gap import LocatedGap
from rotemina.sim.gap.noise.disturbances import Disturbance
from rotemina.sim.gap.output.wording import group
from rotemina.sim.gap.thresholds import NOTICED
from rotemina.sim.messages import Listed, Message, message
from rotemina.sim.quantities import percent
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect

_MOST_GROUPS = 3  # that a remark names
_SURE = 1.96  # standard deviations of a 95 % interval
_SMALL = 1e-4  # of a parameter's size, for a derivative
_RANKED = 8  # rivals that are listed


def concluded(
    examination: Examination, places: tuple[LocatedGap, ...], rng: np.random.Generator
) -> AxisDiagnosis:
    """Put an examination into words and numbers."""
    evidence, best = examination.evidence, examination.best
    explained = examination.verdict in CORRECTING
    causes: list[Cause] = []
    left_by = LeftBy(evidence, best)
    if explained:
        causes = [_cause(examination, number, left_by, rng) for number in range(len(best.causes))]
        named = {one.effect for one in causes}
        causes += [
            _disturbance(examination, one, one.effect)
            for one in examination.disturbances
            # What was set aside may leave more of the same.
            if one.effect is not None and one.effect not in named
        ]
        causes.sort(key=lambda one: -one.gap_before)
    elif examination.verdict is Verdict.UNKNOWN:
        causes = [_unknown(examination, places, rng)]
    shown = best if explained else examination.selection.retuned
    left_by = left_by if explained else LeftBy(evidence, shown)
    return AxisDiagnosis(
        axis=evidence.axis,
        verdict=examination.verdict,
        places=places,
        causes=tuple(causes),
        shrinkage=tuple(
            shrinkage(
                evidence,
                examination.selection.retuned,
                shown,
                examination.black_box,
                tap,
                rng,
                left_by,
            )
            for tap in dict.fromkeys(place.tap for place in places if place.significant)
        ),
        ranking=_ranking(examination, rng),
        remarks=_remarks(examination),
        fitted=examination.fitted,
        suspected=_suspected(examination),
        remainder=_remainder(examination, shown),
    )


def _suspected(examination: Examination) -> tuple[Suspected, ...]:
    """Return what corrects the model without being named."""
    causes = {(one.id, one.from_axis) for one in examination.best.causes}
    return tuple(
        Suspected(one.id, one.from_axis, calibration.shipped().suspected, in_model=True)
        for one in examination.fitted
        if (one.id, one.from_axis) not in causes and one not in examination.steps
    )


def _remainder(examination: Examination, shown: Explanation) -> Remainder:
    """Return the remainder at the last tap, above the floor."""
    evidence = examination.evidence
    tap = _last_tap(evidence)
    rows, floor = at_tap(evidence, tap), evidence.floor(tap)
    left = float(np.mean(shown.held_out[rows] ** 2))
    raw = float(np.mean(evidence.residual()[rows] ** 2))
    return Remainder(
        rms=floor * float(np.sqrt(max(left - 1.0, 0.0))),
        share=1.0 - closed(raw, left),
        depends_on=examination.probe.depends_on,
    )


def _last_tap(evidence: Evidence) -> Tap:
    return list(dict.fromkeys(part.tap for part in sorted(evidence.parts, key=_place)))[-1]


def _place(part: Part) -> int:
    return list(Tap).index(part.tap)


def _cause(
    examination: Examination, number: int, left_by: LeftBy, rng: np.random.Generator
) -> Cause:
    evidence, best = examination.evidence, examination.best
    asked = best.causes[number]
    key = asked.id, asked.from_axis
    attached = Attached.of(evidence.robot, asked)
    before = left_by(frozenset(range(len(best.causes))) - {number})
    tap = _first_tap(evidence, attached.effect.stage)
    shown, floor = at_tap(evidence, tap), evidence.floor(tap)
    share, interval = closing(evidence, before, best.held_out, tap, rng)
    weight = probability(examination.ranked[key], key)
    return Cause(
        axis=evidence.axis,
        effect=asked.id,
        formulation=attached.formulation.name,
        stage=attached.effect.stage.value,
        tap=tap,
        from_axis=asked.from_axis,
        probability=_calibrated(examination, weight),
        weight=weight,
        ambiguous_with=examination.alike[key],
        gap_before=floor * rms(before[shown]),
        gap_after=floor * rms(best.held_out[shown]),
        closed=share,
        closed_interval=interval,
        parameters=_parameters(evidence, best, asked),
        derived=derived(evidence, best, asked),
    )


def _calibrated(examination: Examination, weight: float) -> float:
    """Return how probable a cause of a weight is beside what else is named."""
    causes = len(examination.best.causes) + len(examination.disturbances)
    return calibration.shipped().probability(weight, max(causes - 1, 0))


def _disturbance(examination: Examination, one: Disturbance, effect: str) -> Cause:
    evidence, best = examination.evidence, examination.best
    floor = examination.declared[one.tap]  # that its power counts in
    left = best.by_tap[one.tap]
    if one.sign is Sign.WANDER:
        left = max(left - one.power, 1.0)
    before = left + one.power
    share = closed(before, left)
    return Cause(
        axis=evidence.axis,
        effect=effect,
        formulation=None,
        stage=effect_named(effect).stage.value,
        tap=one.tap,
        from_axis=None,
        probability=_calibrated(examination, 1.0),
        weight=1.0,
        ambiguous_with=(),
        gap_before=floor * float(np.sqrt(before)),
        gap_after=floor * float(np.sqrt(left)),
        closed=share,
        closed_interval=(share, share),
    )


def _unknown(
    examination: Examination, places: tuple[LocatedGap, ...], rng: np.random.Generator
) -> Cause:
    evidence = examination.evidence
    tap = next((one.tap for one in places if one.significant), places[-1].tap)
    shown, floor = at_tap(evidence, tap), evidence.floor(tap)
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
    if attached.formulation.by_spectra:
        return ()  # too many to be read; the corrected model holds them
    deviation = fitted.deviation(block_rows(evidence))
    spreads = {
        free.name: (free.size, x, spread)
        for free, x, spread in zip(fitted.free, fitted.x, deviation, strict=True)
        if free.effect == number
    }
    told = []
    for parameter in attached.formulation.parameters:
        size, x, spread = spreads.get(parameter.name, (1.0, 0.0, np.inf))
        least, most = parameter.bounds(attached.facts)
        low, high = (
            float(np.clip((x + sign * _SURE * spread) * size, least, most)) for sign in (-1.0, 1.0)
        )
        told.append(
            FittedParameter(
                name=parameter.name,
                value=attached.values[parameter.name],
                unit=parameter.unit_on(attached.facts),
                interval=(low, high) if np.isfinite(spread) else None,
                at_bound=fitted.at_bound.get((number, parameter.name)),
            )
        )
    return tuple(told)


def derived(evidence: Evidence, best: Explanation, asked: AxisEffect) -> tuple[Derived, ...]:
    """Return the figure that the records determine for all relatives of a cause: its delay.

    Its interval follows from the gradient with respect to the fitted parameters.
    """
    late_s = effect_named(asked.id).identification.lateness_s
    if late_s is None:
        return ()
    fitted = best.fit
    number = next(n for n, one in enumerate(fitted.effects) if one is asked or one == asked)
    values = Attached.of(evidence.robot, asked).values
    value = late_s(values)
    slopes = np.zeros(len(fitted.free))
    for column, free in enumerate(fitted.free):
        if free.effect == number:
            then = late_s({**values, free.name: values[free.name] + _SMALL * free.size})
            slopes[column] = (then - value) / _SMALL
    (spread,) = fitted.deviation_along(slopes[None, :], block_rows(evidence))
    if not np.isfinite(spread):
        return ()
    interval = max(value - _SURE * spread, 0.0), value + _SURE * spread
    return (Derived("lateness", float(value), interval, "s"),)


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
                probability=_calibrated(examination, one.probability),
                held_out_rms=rms(left[at_tap(evidence, tap)]),
                held_out_interval=(float(low), float(high)),
            )
        )
    return tuple(told)


def _remarks(examination: Examination) -> tuple[Message, ...]:
    best, probe = examination.best, examination.probe
    said = (
        *(one.note for one in examination.disturbances),
        *origin_remarks(examination.evidence),
    )
    if best.score <= NOTICED or not probe.depends_on:
        return said
    share = message("gap", "{group} ({percent})")
    groups = Listed(
        tuple(
            share.fill(group=group(name), percent=percent(part, 2))
            for name, part in probe.depends_on[:_MOST_GROUPS]
        )
    )
    depends = message("gap", "The rest depends on {groups}, as far as simple features predict it.")
    return (*said, depends.fill(groups=groups))
