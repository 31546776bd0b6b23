"""Effects that do much the same as a cause in other words.

The sensor instead of the drive, where no reference was recorded; a lag of high order instead of a
delay; a coupling to an axis that moved alike instead of a gain; a mass on a spring instead of a
re-tuned resonance.
"""

from dataclasses import replace

import numpy as np

from rotemina.sim.effects import AttachedEffect, EffectFamily, EffectStage, InputDelay, load_effect
from rotemina.sim.gap.compare.excitation_richness import alike_axes
from rotemina.sim.gap.fit import (
    Evidence,
    catalogue,
    is_of,
    is_whole_own,
    with_parameter,
)
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

# What does the same at the sensor as elsewhere, where no reference was recorded.
AT_THE_SENSOR = {EffectFamily.GAIN, EffectFamily.CURVE, EffectFamily.LATE, EffectFamily.PERIOD}
_BUTTERWORTH = "third_order"  # of a lag, as it is with its presets
_LOAD_ABOVE = 1.8  # times an axis' resonance, from where that of a mass on it is looked for


def substitutes(evidence: Evidence, cause: AxisEffect) -> list[AxisEffect]:
    """Return effects that do much the same as a cause, with numbers by which they do."""
    found = []
    if not evidence.has(Tap.REF):
        found += [_alike(cause, twin) for twin in _elsewhere(cause.id)]
    if _is_transport(cause):
        found += [_as_late(cause, lag) for lag in _lags(EffectStage.ELECTRONICS)]
    if is_whole_own(cause.id) and is_of(EffectFamily.GAIN, cause.id):
        for axis, k in alike_axes(evidence).items():
            numbers = {"k": k * cause.parameters["error"]}
            found += [
                AxisEffect(axis=evidence.axis, id=one.id, from_axis=axis, parameters=numbers)
                for one in catalogue()
                if one.coupled and one.formulations[0].find_parameter("k")
            ]
    if is_of(EffectFamily.RESONANCE, cause.id):
        found += _loads(evidence, cause)
    return [_within_bounds(evidence, twin) for twin in found]


def _elsewhere(name: str) -> list[str]:
    """Return what does the same at the sensor; of a curve of the sensor, what does it elsewhere."""
    own = load_effect(name)
    if own.kinship.family not in AT_THE_SENSOR:
        return []
    at_the_sensor = own.stage is EffectStage.SENSOR
    if at_the_sensor and own.kinship.family is not EffectFamily.CURVE:
        return []
    return [
        one.id
        for one in catalogue()
        if one.kinship.family is own.kinship.family
        and (one.stage is EffectStage.SENSOR) is not at_the_sensor
    ]


def _is_transport(cause: AxisEffect) -> bool:
    """Tell whether a cause makes everything later and nothing else."""
    effect = load_effect(cause.id)
    return isinstance(effect.formulations[0].acts, InputDelay) and is_of(
        EffectFamily.LATE, cause.id
    )


def _lags(stage: EffectStage) -> list[str]:
    return [
        one.id
        for one in catalogue()
        if one.stage is stage
        and one.find_formulation(_BUTTERWORTH)
        and is_of(EffectFamily.LATE, one.id)
    ]


def _loads(evidence: Evidence, cause: AxisEffect) -> list[AxisEffect]:
    """Return a mass on a spring that makes an axis ring as much slower as a re-tuned resonance is.

    With μ of the axis' mass, at ν times its resonance, both ring at r of that where
    1 - r² = μ r² / (1 - r²/ν²) (the dynamic vibration absorber: Den Hartog, Mechanical Vibrations,
    1956, ch. 3).
    """
    inertia, off = evidence.robot.axes[evidence.axis].inertia, cause.parameters["frequency_error"]
    if inertia is None or off >= 0.0:
        return []
    rings_hz = float(np.sqrt(inertia.stiffness / inertia.mass)) / (2.0 * np.pi)
    slower = (1.0 + off) ** 2
    share = (1.0 / slower - 1.0) * (1.0 - slower / _LOAD_ABOVE**2)
    numbers = {"frequency": _LOAD_ABOVE * rings_hz, "mass_ratio": share}
    load = with_parameter("mass_ratio")
    if load is None:
        return []
    effect, form = load
    return [AxisEffect(axis=evidence.axis, id=effect.id, formulation=form.name, parameters=numbers)]


def _as_late(cause: AxisEffect, lag: str) -> AxisEffect:
    """Return the Butterworth filter of the third order that is as late as a delay: 2τ."""
    late_s = load_effect(cause.id).identification.lateness_s
    assert late_s is not None
    numbers = {"time_constant": 0.5 * late_s(cause.parameters)}
    return replace(cause, id=lag, formulation=_BUTTERWORTH, parameters=numbers)


def _within_bounds(evidence: Evidence, twin: AxisEffect) -> AxisEffect:
    """Return a twin with the nearest numbers that it may have: its bounds may be closer."""
    bare = AttachedEffect.of(evidence.robot, replace(twin, parameters={}))
    return replace(twin, parameters=bare.clip_values(twin.parameters))


def _alike(cause: AxisEffect, twin: str) -> AxisEffect:
    """Return the twin of a cause, in the form of the same name and with the numbers of both.

    That of a delay is a lag as late.
    """
    if _is_transport(cause):
        return _as_late(cause, twin)
    forms = load_effect(twin).formulations
    form = next((one for one in forms if one.name == cause.formulation), forms[0])
    names = {parameter.name for parameter in form.parameters}
    numbers = {name: value for name, value in cause.parameters.items() if name in names}
    return replace(cause, id=twin, formulation=form.name, parameters=numbers)
