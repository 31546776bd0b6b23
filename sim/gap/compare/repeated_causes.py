"""Causes that are but another one again: the axis' own mode, or an overtone."""

import numpy as np

from rotemina.sim.effects import AddedStates, EffectStage, load_effect
from rotemina.sim.gap.compare.explanations import Explanation
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

_ONE_MODE = 0.03  # relative difference of frequencies that are one mode's
_ONE_PERIOD = 0.003  # the same of periods, as multiples of another's
_HARMONICS = 8


def is_own_mode(evidence: Evidence, tuned: Explanation, one: Explanation) -> bool:
    """Tell whether a further mode of an explanation is at the resonance as another has it."""
    inertia = evidence.robot.axes[evidence.axis].inertia
    off = [
        own.parameters["frequency_error"]
        for own in tuned.fit.effects
        if "frequency_error" in own.parameters
    ]
    if inertia is None or not off:
        return False
    rings_hz = np.sqrt(inertia.stiffness / inertia.mass) / (2.0 * np.pi) * (1.0 + off[0])
    return any(
        abs(value - rings_hz) < _ONE_MODE * rings_hz
        for cause in one.causes
        if _is_mode(cause)
        for name, value in cause.parameters.items()
        if name.startswith("frequency")
    )


def _is_mode(cause: AxisEffect) -> bool:
    """Tell whether a cause is linear states that the axis' own input drives."""
    effect = load_effect(cause.id)
    form = effect.find_formulation(cause.formulation)
    return form is not None and isinstance(form.acts, AddedStates) and not effect.coupled


def has_overtone(evidence: Evidence, one: Explanation) -> bool:
    """Tell whether a cause repeats a few times within the period of another: its harmonic.

    What a reference does not see is the sensor's own all the same.
    """
    told = evidence.has(Tap.REF)
    periods = [
        cause.parameters["period"]
        for cause in one.causes
        if "period" in cause.parameters
        and not (told and load_effect(cause.id).stage is EffectStage.SENSOR)
    ]
    for long in periods:
        for short in periods:
            times = round(long / short)
            if 2 <= times <= _HARMONICS and abs(long / short - times) < _ONE_PERIOD * times:
                return True
    return False
