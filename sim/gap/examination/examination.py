"""Examination of one axis: screening, fits, selection and verdict."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from rotemina.sim.effects import EffectSignature, EffectStage, load_effect
from rotemina.sim.gap.compare import (
    Closing,
    Explanation,
    Key,
    Ranking,
    Selection,
    accompanied,
    acts,
    contested,
    counted_in,
    decide,
    explain,
    is_poor,
    is_sure,
    many_modes,
    mean_squares,
    named_as,
    not_ruled_out,
    rivals_of,
    searched,
    untouched,
    with_retained,
)
from rotemina.sim.gap.fit import Evidence, finished, is_whole_own, with_origins
from rotemina.sim.gap.limits import (
    LARGE_SHARE,
    MIN_CAUSE_POWER,
    MIN_CAUSE_SHARE,
    MIN_DOMINANT_SHARE_OF_REMAINDER,
    MIN_MAJORITY_SHARE,
)
from rotemina.sim.gap.location import ResidualProbe, probe_residual
from rotemina.sim.gap.noise import (
    Disturbance,
    by_effect,
    power_by_tap,
    steps_of,
    wander,
)
from rotemina.sim.gap.result import CORRECTING_VERDICTS, Account, GapVerdict, closed
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

# If there is also a heavy-tailed disturbance, spikes count only above this fraction of the power of
# the gap.
_MIN_SPIKE_POWER_RATIO = 0.08
_HEAVY_TAILED_SIGNS = {EffectSignature.NOISE, EffectSignature.STEPS, EffectSignature.TONES}


@dataclass(frozen=True, eq=False)
class AxisExamination:
    """The findings on an axis, from which the conclusions are drawn.

    Attributes
    ----------
    evidence : Evidence
        The records without the disturbances.
    declared_floors : mapping of Tap to float
        Noise floor of each tap, SI, before disturbances raised it.
    disturbances : tuple of Disturbance
        The disturbances that count as causes.
    selection : Selection
    best : Explanation
        The best explanation of the gap. Its fit may contain effects besides its causes, which are
        too small or too ambiguous to be named.
    verdict : GapVerdict
    ranked : Ranking
    ambiguous_with : mapping of Key to tuple of str
        For each cause, the effects that cannot be distinguished from it.
    probe : ResidualProbe
        A black-box model of the remainder; it shows which quantities the remainder depends on.
    black_box : ResidualProbe
        A black-box model of the same kind, fitted to the raw gap.
    reading_steps : tuple of AxisEffect
        The steps of a coarse sensor, which the corrected model reproduces.
    """

    evidence: Evidence
    declared_floors: Mapping[Tap, float]
    disturbances: tuple[Disturbance, ...]
    selection: Selection
    best: Explanation
    verdict: GapVerdict
    ranked: Ranking
    ambiguous_with: Mapping[Key, tuple[str, ...]]
    probe: ResidualProbe
    black_box: ResidualProbe
    reading_steps: tuple[AxisEffect, ...] = ()

    @property
    def fitted(self) -> tuple[AxisEffect, ...]:
        """The effects that correct the model: causes, and small corrections fitted with them."""
        if self.verdict not in CORRECTING_VERDICTS:
            return ()
        acting = self.best.fit.effects if self.best.causes else ()
        return (*(effect for effect in acting if acts(effect)), *self.reading_steps)


def examine(all_evidence: Evidence, account: Account, *, jobs: int = 1) -> AxisExamination:
    """Find the causes of the gap of an axis.

    Parameters
    ----------
    all_evidence : Evidence
        All records of the axis, with their disturbances.
    account : Account
        Reports the progress.
    jobs : int
        Number of candidates that are tried at the same time.
    """
    modes = many_modes(all_evidence, account)
    if modes is not None:
        return _examine_modes(all_evidence, modes)
    all_evidence = with_origins(all_evidence)
    evidence, candidate_disturbances, selection, best = searched(all_evidence, account, jobs)
    candidate_disturbances = tuple(
        disturbance
        for disturbance in candidate_disturbances
        if not _is_removed_by(all_evidence, evidence, best, disturbance)
    )
    account.tell("deciding", None)
    unweighted_evidence = evidence.unweighted()
    recount = partial(counted_in, unweighted_evidence, evidence)
    drift = wander(evidence, best.fit.residual)
    disturbances = _select_causal_disturbances(
        all_evidence, unweighted_evidence, recount(best), candidate_disturbances, drift
    )
    selected_best, disturbance_power = (
        best,
        _disturbance_power_by_tap(all_evidence, evidence, disturbances),
    )
    best, ranked = contested(
        evidence,
        selection,
        best,
        disturbance_power,
        wanders=drift is not None,
        # With a reference, the remaining gap is visible in spite of disturbances. Without it, the
        # disturbances are part of the sensor noise.
        disturbed=bool(disturbances) and evidence.has(Tap.REF),
    )
    if best is not selected_best:
        # A rejected cause had absorbed part of the sensor drift, so the drift is estimated again.
        drift = wander(evidence, best.fit.residual) or drift
        disturbances = _select_causal_disturbances(
            all_evidence, unweighted_evidence, recount(best), candidate_disturbances, drift
        )
    if drift is None:
        best, ranked = accompanied(evidence, best, ranked, selection.raw, account, jobs=jobs)
    ambiguous_with = {key: not_ruled_out(ranked[key], key, selection.raw) for key in best.ids}
    is_poor_motion = is_poor(all_evidence) and not disturbances
    is_certain = is_sure(
        evidence,
        [ranked[key] for key in best.ids],
        # A poor motion leaves many effects possible, so the sets of alternatives say nothing.
        [() if is_poor_motion else ambiguous_with[key] for key in best.ids],
    )
    # Disturbances need no comparison with rivals.
    is_certain |= bool(disturbances) and not best.causes
    bare = selection.bare if unweighted_evidence is evidence else untouched(unweighted_evidence)
    black_box = probe_residual(unweighted_evidence, unweighted_evidence.residual())
    others = [
        disturbance
        for disturbance in disturbances
        if disturbance.sign is not EffectSignature.WANDER
    ]
    causal_drift = drift if len(others) < len(disturbances) else None
    power_of_others = _disturbance_power_by_tap(all_evidence, evidence, others)
    closing = _make_closing(bare, recount(best), black_box, others, power_of_others, causal_drift)
    verdict = decide(closing, list(ambiguous_with.values()), poor=is_poor_motion, sure=is_certain)
    if verdict in CORRECTING_VERDICTS and drift is None:
        best = with_retained(
            evidence, best, _find_richer_explanation(selection, best), account, jobs=jobs
        )
    steps = (
        _find_reading_steps(all_evidence, best, disturbances)
        if verdict in CORRECTING_VERDICTS
        else ()
    )
    best = recount(replace(best, fit=finished(evidence, best.fit, most_steps=0)))
    return AxisExamination(
        unweighted_evidence,
        _floors_by_tap(all_evidence),
        disturbances,
        replace(selection, bare=bare, retuned=recount(selection.retuned)),
        best,
        verdict,
        {
            key: tuple(replace(rival, explanation=recount(rival.explanation)) for rival in rivals)
            for key, rivals in ranked.items()
        },
        ambiguous_with,
        probe_residual(unweighted_evidence, best.held_out),
        black_box,
        steps,
    )


def _make_closing(
    bare: Explanation,
    best: Explanation,
    black_box: ResidualProbe,
    others: Sequence[Disturbance],
    power_of_others: Mapping[Tap, float],
    drift: Disturbance | None,
) -> Closing:
    """Return how much of the gap is closed if the disturbances count as explained.

    ``others`` are the disturbances apart from ``drift``; ``power_of_others`` is their power at each
    tap, in floors squared.
    """
    return Closing(
        bare.score + sum(disturbance.power for disturbance in others),
        max(best.score - (drift.power if drift is not None else 0.0), 1.0),
        black_box.score,
        max(
            closed(raw_power + power_of_others.get(tap, 0.0), best.by_tap[tap])
            for tap, raw_power in bare.by_tap.items()
        ),
    )


def _find_reading_steps(
    evidence: Evidence, best: Explanation, disturbances: Sequence[Disturbance]
) -> tuple[AxisEffect, ...]:
    effects = [effect for effect in best.fit.effects if acts(effect)] if best.causes else []
    steps = (
        steps_of(evidence, effects, disturbance.step)
        for disturbance in disturbances
        if disturbance.step is not None
    )
    return tuple(step for step in steps if step is not None)


def _is_removed_by(
    all_evidence: Evidence, evidence: Evidence, best: Explanation, disturbance: Disturbance
) -> bool:
    """Return whether the best explanation removes the spikes of a disturbance.

    If the model lacks an effect such as ringing or a limit, its gap may look like spikes.
    """
    if disturbance.sign is not EffectSignature.SPIKES:
        return False
    residual, power, rows = all_evidence.residual(best.fit.effects), 0.0, 0
    for part in evidence.parts:
        is_kept = evidence.observations[part.record].kept.get(part.tap)
        if part.tap is disturbance.tap:
            rows += part.rows.stop - part.rows.start
            power += 0.0 if is_kept is None else float(np.sum(residual[part.rows][~is_kept] ** 2))
    return power / rows < MIN_MAJORITY_SHARE * disturbance.power


def _find_richer_explanation(selection: Selection, best: Explanation) -> Sequence[Explanation]:
    """Return the best explanation with the same causes and others, if it is much better."""
    named_causes = set(best.ids)
    richer = [
        explanation
        for explanation in selection.tried
        if named_causes < {(effect.id, effect.from_axis) for effect in explanation.fit.effects}
        and {key for key in named_causes if not is_whole_own(key[0])} < set(explanation.ids)
        and explanation.score < LARGE_SHARE * best.score
    ]
    if not richer:
        return ()
    return (named_as(min(richer, key=lambda explanation: explanation.score), named_causes),)


def _examine_modes(evidence: Evidence, modes: Explanation) -> AxisExamination:
    """Return the findings on an axis that rings in many modes, without a further search."""
    bare = untouched(evidence)
    selection = Selection(bare, explain(evidence, ()), modes, (modes,))
    best, ranked = modes, rivals_of(evidence, selection, modes)
    ambiguous_with = {key: not_ruled_out(ranked[key], key, selection.raw) for key in best.ids}
    black_box = probe_residual(evidence, evidence.residual())
    closing = Closing(selection.raw, max(best.score, 1.0), black_box.score)
    verdict = decide(closing, (), poor=False, sure=True)
    probe = probe_residual(evidence, best.held_out)
    floors = _floors_by_tap(evidence)
    return AxisExamination(
        evidence, floors, (), selection, best, verdict, ranked, ambiguous_with, probe, black_box
    )


def _floors_by_tap(evidence: Evidence) -> dict[Tap, float]:
    return {part.tap: evidence.floor(part.tap) for part in evidence.parts}


def _disturbance_power_by_tap(
    all_evidence: Evidence, evidence: Evidence, disturbances: Sequence[Disturbance]
) -> dict[Tap, float]:
    """Return the power of disturbances at each tap, in squared floors of ``evidence``.

    The power is scaled only if ``evidence`` has the higher floor, as after noise. Coarse steps
    lower the floor.
    """
    return {
        tap: power * min(all_evidence.floor(tap) / evidence.floor(tap), 1.0) ** 2
        for tap, power in power_by_tap(all_evidence, disturbances).items()
    }


def _select_causal_disturbances(
    all_evidence: Evidence,
    evidence: Evidence,
    best: Explanation,
    candidates: Sequence[Disturbance],
    drift: Disturbance | None,
) -> tuple[Disturbance, ...]:
    """Return the disturbances that count as causes.

    Each of them closes a sufficient share of the gap, or most of the remainder. If a sensor effect
    is among the causes, a drift must close a sufficient share of the gap. An error of the sensor
    changes with position and is invisible in the reference, so it could pass for drift.
    """
    disturbances = list(candidates)
    has_sensor_cause = any(
        load_effect(effect.id).stage is EffectStage.SENSOR for effect in best.causes
    )
    if drift is not None:
        floor_ratio = (evidence.floor(drift.tap) / all_evidence.floor(drift.tap)) ** 2
        disturbances.append(replace(drift, power=drift.power * floor_ratio))
    gap_power = mean_squares(all_evidence, all_evidence.residual())
    remaining_by_tap = {
        tap: mean
        + sum(
            disturbance.power
            for disturbance in disturbances
            if disturbance.tap is tap and disturbance.sign is not EffectSignature.WANDER
        )
        for tap, mean in best.by_tap.items()
    }
    causes = []
    has_heavy_tails = any(disturbance.sign in _HEAVY_TAILED_SIGNS for disturbance in disturbances)
    for disturbance in by_effect(disturbances):
        remaining = remaining_by_tap[disturbance.tap] - 1.0
        min_share = (
            _MIN_SPIKE_POWER_RATIO
            if has_heavy_tails and disturbance.sign is EffectSignature.SPIKES
            else MIN_CAUSE_SHARE
        )
        closes_share = disturbance.power >= min_share * (gap_power[disturbance.tap] - 1.0)
        is_clear = disturbance.power >= MIN_DOMINANT_SHARE_OF_REMAINDER * remaining
        # Unlike other disturbances, a drift was not set aside: it is still part of the remainder.
        if disturbance.sign is EffectSignature.WANDER:
            closes_share = closes_share and disturbance.power >= MIN_MAJORITY_SHARE * remaining
            is_clear = is_clear and not has_sensor_cause
        if disturbance.power >= MIN_CAUSE_POWER and (closes_share or is_clear):
            causes.append(disturbance)
    return tuple(causes)
