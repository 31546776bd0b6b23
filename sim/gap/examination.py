"""One axis examined: screened, fitted, selected, judged."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from rotemina.sim.effects.formulation import Stage
from rotemina.sim.effects.identification import Sign
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.gap.compare.cause_contest import Ranking, contested, rivals_of
from rotemina.sim.gap.compare.closed_share import closed
from rotemina.sim.gap.compare.companions import accompanied
from rotemina.sim.gap.compare.diagnosis_progress import Account
from rotemina.sim.gap.compare.excitation_richness import is_poor
from rotemina.sim.gap.compare.explanations import (
    Explanation,
    counted_in,
    explain,
    mean_squares,
    named_as,
    untouched,
)
from rotemina.sim.gap.compare.forward_selection import Selection
from rotemina.sim.gap.compare.many_modes import many_modes
from rotemina.sim.gap.compare.repeated_search import acts, searched
from rotemina.sim.gap.compare.retained import with_retained
from rotemina.sim.gap.compare.rivals import Key, not_ruled_out
from rotemina.sim.gap.compare.verdict import Closing, decide, is_sure
from rotemina.sim.gap.diagnosis import CORRECTING, Verdict
from rotemina.sim.gap.fit.baseline import is_whole_own
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import finished
from rotemina.sim.gap.fit.position_origins import with_origins
from rotemina.sim.gap.location.residual_features import Probe, probed
from rotemina.sim.gap.noise.coarse_reading import steps_of
from rotemina.sim.gap.noise.disturbances import Disturbance, by_effect, power_by_tap
from rotemina.sim.gap.noise.sensor_wander import wander
from rotemina.sim.gap.thresholds import CLEARLY, HALF, LEAST_POWER, MUCH, SMALL
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect

_TAILS = 0.08  # of the gap's power, that outliers have beyond the tails of what else is set aside
_WITH_TAILS = {Sign.NOISE, Sign.STEPS, Sign.TONES}


@dataclass(frozen=True, eq=False)
class Examination:
    """The findings on an axis, before they become a diagnosis.

    ``evidence`` is free of disturbances; ``declared`` is the noise floor of each tap, SI, before
    they raised it; ``disturbances`` are the ones that count. The fit of ``best`` may contain more
    than its causes: corrections that are too small or too ambiguous to be named. ``alike`` holds,
    for each cause, the effects that cannot be told from it. ``probe`` tells what the remainder
    depends on; ``black_box`` is fitted to the raw gap instead. The corrected model reads in
    ``steps``.
    """

    evidence: Evidence
    declared: Mapping[Tap, float]
    disturbances: tuple[Disturbance, ...]
    selection: Selection
    best: Explanation
    verdict: Verdict
    ranked: Ranking
    alike: Mapping[Key, tuple[str, ...]]
    probe: Probe
    black_box: Probe
    steps: tuple[AxisEffect, ...] = ()

    @property
    def fitted(self) -> tuple[AxisEffect, ...]:
        """What corrects the model: the causes and the small re-tuning that they bring along."""
        if self.verdict not in CORRECTING:
            return ()
        acting = self.best.fit.effects if self.best.causes else ()
        return (*(one for one in acting if acts(one)), *self.steps)


def examine(whole: Evidence, account: Account, *, jobs: int = 1) -> Examination:
    """Look for the causes of an axis' gap."""
    modal = many_modes(whole, account)
    if modal is not None:
        return _of_modes(whole, modal)
    whole = with_origins(whole)
    evidence, aside, selection, best = searched(whole, account, jobs)
    aside = tuple(one for one in aside if not _was_explained(whole, evidence, best, one))
    account.tell("deciding", None)
    plain = evidence.unweighted()
    shown = partial(counted_in, plain, evidence)
    drift = wander(evidence, best.fit.residual)
    disturbances = _counting(whole, plain, shown(best), aside, drift)
    found, aside_at = best, _aside_at(whole, evidence, disturbances)
    best, ranked = contested(
        evidence,
        selection,
        best,
        aside_at,
        wanders=drift is not None,
        # A reference tells what is left; where the sensor alone reads, that is its own noise.
        disturbed=bool(disturbances) and evidence.has(Tap.REF),
    )
    if best is not found:
        # What a cause that does not stand had bent away of it is the sensor's wander as well.
        drift = wander(evidence, best.fit.residual) or drift
        disturbances = _counting(whole, plain, shown(best), aside, drift)
    if drift is None:
        best, ranked = accompanied(evidence, best, ranked, selection.raw, account, jobs=jobs)
    alike = {key: not_ruled_out(ranked[key], key, selection.raw) for key in best.ids}
    poor = is_poor(whole) and not disturbances
    sure = is_sure(
        evidence,
        [ranked[key] for key in best.ids],
        [() if poor else alike[key] for key in best.ids],  # a poor motion makes sets large
    )
    sure |= bool(disturbances) and not best.causes  # a disturbance stands by itself
    bare = selection.bare if plain is evidence else untouched(plain)
    black_box = probed(plain, plain.residual())
    steady = [one for one in disturbances if one.sign is not Sign.WANDER]
    wandering = drift if len(steady) < len(disturbances) else None
    steady_at = _aside_at(whole, evidence, steady)
    closing = _closing(bare, shown(best), black_box, steady, steady_at, wandering)
    verdict = decide(closing, list(alike.values()), poor=poor, sure=sure)
    if verdict in CORRECTING and drift is None:
        best = with_retained(evidence, best, _fullest(selection, best), account, jobs=jobs)
    steps = _stepped(whole, best, disturbances) if verdict in CORRECTING else ()
    best = shown(replace(best, fit=finished(evidence, best.fit, most_steps=0)))
    return Examination(
        plain,
        _floors(whole),
        disturbances,
        replace(selection, bare=bare, retuned=shown(selection.retuned)),
        best,
        verdict,
        {
            key: tuple(replace(one, explanation=shown(one.explanation)) for one in own)
            for key, own in ranked.items()
        },
        alike,
        probed(plain, best.held_out),
        black_box,
        steps,
    )


def _closing(
    bare: Explanation,
    best: Explanation,
    black_box: Probe,
    steady: Sequence[Disturbance],
    steady_at: Mapping[Tap, float],
    drift: Disturbance | None,
) -> Closing:
    """Return how far the gap closes, with a drift and what else was set aside.

    ``steady_at`` is the power of the ``steady`` disturbances at each tap, in its floors squared.
    """
    return Closing(
        bare.score + sum(one.power for one in steady),
        max(best.score - (drift.power if drift is not None else 0.0), 1.0),
        black_box.score,
        max(
            closed(raw + steady_at.get(tap, 0.0), best.by_tap[tap])
            for tap, raw in bare.by_tap.items()
        ),
    )


def _stepped(
    whole: Evidence, best: Explanation, disturbances: Sequence[Disturbance]
) -> tuple[AxisEffect, ...]:
    """Return the steps in which the corrected model is to read, if a coarse sensor was found."""
    acting = [one for one in best.fit.effects if acts(one)] if best.causes else []
    found = (steps_of(whole, acting, one.step) for one in disturbances if one.step is not None)
    return tuple(one for one in found if one is not None)


def _was_explained(
    whole: Evidence, evidence: Evidence, best: Explanation, one: Disturbance
) -> bool:
    """Tell whether readings that stood out do so no more once the gap is explained.

    What rings, or ends at a limit, may look like spikes and dropouts to a model that lacks it.
    """
    if one.sign is not Sign.SPIKES:
        return False
    left, power, rows = whole.residual(best.fit.effects), 0.0, 0
    for part in evidence.parts:
        kept = evidence.observations[part.record].kept.get(part.tap)
        if part.tap is one.tap:
            rows += part.rows.stop - part.rows.start
            power += 0.0 if kept is None else float(np.sum(left[part.rows][~kept] ** 2))
    return power / rows < HALF * one.power


def _fullest(selection: Selection, best: Explanation) -> Sequence[Explanation]:
    """Return what explains most with the same causes and more, if that is much more."""
    named = set(best.ids)
    fuller = [
        one
        for one in selection.tried
        if named < {(own.id, own.from_axis) for own in one.fit.effects}
        and {key for key in named if not is_whole_own(key[0])} < set(one.ids)
        and one.score < MUCH * best.score
    ]
    if not fuller:
        return ()
    return (named_as(min(fuller, key=lambda one: one.score), named),)


def _of_modes(evidence: Evidence, modal: Explanation) -> Examination:
    """Return the findings on an axis that rings in many modes; search for nothing else."""
    bare = untouched(evidence)
    selection = Selection(bare, explain(evidence, ()), modal, (modal,))
    best, ranked = modal, rivals_of(evidence, selection, modal)
    alike = {key: not_ruled_out(ranked[key], key, selection.raw) for key in best.ids}
    black_box = probed(evidence, evidence.residual())
    closing = Closing(selection.raw, max(best.score, 1.0), black_box.score)
    verdict = decide(closing, (), poor=False, sure=True)
    probe = probed(evidence, best.held_out)
    floors = _floors(evidence)
    return Examination(
        evidence, floors, (), selection, best, verdict, ranked, alike, probe, black_box
    )


def _floors(evidence: Evidence) -> dict[Tap, float]:
    return {part.tap: evidence.floor(part.tap) for part in evidence.parts}


def _aside_at(
    whole: Evidence, evidence: Evidence, disturbances: Sequence[Disturbance]
) -> dict[Tap, float]:
    """Return the power of disturbances at each tap, in the floors that noise raised.

    Beyond coarse steps the floor is lower instead: these count as they are.
    """
    return {
        tap: power * min(whole.floor(tap) / evidence.floor(tap), 1.0) ** 2
        for tap, power in power_by_tap(whole, disturbances).items()
    }


def _counting(
    whole: Evidence,
    evidence: Evidence,
    best: Explanation,
    aside: Sequence[Disturbance],
    drift: Disturbance | None,
) -> tuple[Disturbance, ...]:
    """Return the disturbances that are causes: each closes its share, or most of the remainder.

    A sensor's own error, simulated by equations other than the machine's, changes with position and
    is invisible in the reference; next to one, a drift needs its share.
    """
    found = list(aside)
    misread = any(effect_named(one.id).stage is Stage.SENSOR for one in best.causes)
    if drift is not None:
        raised = (evidence.floor(drift.tap) / whole.floor(drift.tap)) ** 2
        found.append(replace(drift, power=drift.power * raised))
    raw = mean_squares(whole, whole.residual())
    by_tap = {
        tap: mean
        + sum(one.power for one in found if one.tap is tap and one.sign is not Sign.WANDER)
        for tap, mean in best.by_tap.items()
    }
    counting = []
    others = any(one.sign in _WITH_TAILS for one in found)
    for one in by_effect(found):
        left = by_tap[one.tap] - 1.0
        least = _TAILS if others and one.sign is Sign.SPIKES else SMALL
        share = one.power >= least * (raw[one.tap] - 1.0)
        clearly = one.power >= CLEARLY * left
        if one.sign is Sign.WANDER:  # of what is left, which it is still a part of
            share = share and one.power >= HALF * left
            clearly = clearly and not misread
        if one.power >= LEAST_POWER and (share or clearly):
            counting.append(one)
    return tuple(counting)
