"""Effects that may explain the gap of an axis: all effects of the catalogue that fit the axis.

Random effects (noise, drift, outliers, lost steps) cannot be fitted to a response; they are found
by their traces instead.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import isfinite

import numpy as np

from rotemina.sim.effects import AttachedEffect, Effect, EffectTrait, ReadingFunction, load_effect
from rotemina.sim.errors import EffectError, PlantError
from rotemina.sim.gap.fit import NUMERICAL, Evidence, Signals, catalogue
from rotemina.sim.plant import Plant
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

# Change over a record, in noise floors, below which an effect does not act at all.
_MIN_CHANGE_FLOORS = 1e-6


def candidates(evidence: Evidence) -> tuple[AxisEffect, ...]:
    """Return every formulation of every effect that the axis may have, with its presets.

    Effects that come from another axis are listed once for each axis that a record commands.
    """
    found: list[AxisEffect] = []
    sources = _other_axes(evidence)
    for effect in catalogue():
        if effect.identification.fitted:
            found += _formulations(evidence, effect, sources if effect.coupled else [None])
    if _has_motion(evidence):
        return tuple(one for one in found if not _is_shown_at_rest(one))
    unchanged = evidence.response()
    return tuple(one for one in found if _is_excited(evidence, one, unchanged))


def _has_motion(evidence: Evidence) -> bool:
    return any(
        np.ptp(observation.record.signal(evidence.axis, Tap.CMD)) > 0.0
        for observation in evidence.observations
    )


def _is_shown_at_rest(candidate: AxisEffect) -> bool:
    return candidate.formulation in load_effect(candidate.id).identification.shown_at_rest


def _is_excited(evidence: Evidence, candidate: AxisEffect, unchanged: Sequence[Signals]) -> bool:
    """Tell whether an axis that is held shows an effect that starts at rest.

    Time excites drift and vibration, and other axes excite a coupling. Without either, a mode would
    ring only from a start that is fitted to the record, and could take the shape of any remainder.
    """
    formulation = AttachedEffect.of(evidence.robot, candidate).formulation
    if EffectTrait.LOCKED_TO_TIME in formulation.traits:
        return True
    try:
        changed = evidence.response([candidate])
    except (EffectError, PlantError, *NUMERICAL):
        return False
    return any(
        np.ptp(signal - before[tap]) > _MIN_CHANGE_FLOORS * observation.floor[tap]
        for observation, after, before in zip(
            evidence.observations, changed, unchanged, strict=True
        )
        for tap, signal in after.items()
        if tap in observation.floor
    )


def scouts(evidence: Evidence, own: Sequence[AxisEffect]) -> list[AxisEffect]:
    """Return the candidates for the first look: the formulations that are quick to simulate.

    For an effect without a quick formulation, return the most informative one, or the usual one.
    """
    quick = [one for one in own if not is_slow(evidence, one)]
    seen = {(one.id, one.from_axis) for one in quick}
    for one in sorted(own, key=lambda one: not _tells_most(one)):
        if (one.id, one.from_axis) not in seen:
            seen.add((one.id, one.from_axis))
            quick.append(one)
    return quick


def _tells_most(candidate: AxisEffect) -> bool:
    return load_effect(candidate.id).identification.scout == candidate.formulation


def siblings(chosen: Sequence[AxisEffect], own: Sequence[AxisEffect]) -> list[AxisEffect]:
    """Return the other formulations of chosen effects among the candidates."""
    effects = {(one.id, one.from_axis) for one in chosen}
    known = {(one.id, one.from_axis, one.formulation) for one in chosen}
    return [
        one
        for one in own
        if (one.id, one.from_axis) in effects
        and (one.id, one.from_axis, one.formulation) not in known
    ]


def is_slow(evidence: Evidence, candidate: AxisEffect) -> bool:
    """Tell whether a candidate needs steps finer than the records'."""
    attached = AttachedEffect.of(evidence.robot, candidate)
    return bool(isfinite(attached.formulation.inner_step_s(attached.values, attached.facts)))


def _formulations(
    evidence: Evidence, effect: Effect, sources: Sequence[str | None]
) -> Iterator[AxisEffect]:
    for formulation in effect.formulations:
        if isinstance(formulation.acts, ReadingFunction) and formulation.acts.random:
            continue
        if formulation.by_spectra:
            continue
        for source in sources:
            asked = AxisEffect(
                axis=evidence.axis, id=effect.id, formulation=formulation.name, from_axis=source
            )
            if _can_sit(evidence, asked):
                yield asked


def _can_sit(evidence: Evidence, asked: AxisEffect) -> bool:
    """Tell whether an axis of this kind, with its mass and stiffness, can have the effect."""
    try:
        Plant.of(replace(evidence.robot, effects=(asked,)), only={evidence.axis})
    except EffectError:
        return False
    return True


def _other_axes(evidence: Evidence) -> list[str | None]:
    commanded = dict.fromkeys(
        name
        for observation in evidence.observations
        for name in observation.record.axes
        if observation.record.has(name, Tap.CMD)
    )
    return [name for name in commanded if name != evidence.axis]
