"""Causes that are but another one again: the axis' own mode, or an overtone."""

import numpy as np

from rotemina.sim.gap.baseline import RESONANCE
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.models import Explanation
from rotemina.sim.records.record import Tap

_ONE_MODE = 0.03  # relative difference of frequencies that are one mode's
_ONE_PERIOD = 0.003  # the same of periods, as multiples of another's
_HARMONICS = 8


def is_own_mode(evidence: Evidence, tuned: Explanation, one: Explanation) -> bool:
    """Tell whether a further mode of an explanation is at the resonance as another has it."""
    inertia = evidence.robot.axes[evidence.axis].inertia
    off = [own.parameters["frequency_error"] for own in tuned.fit.effects if own.id == RESONANCE]
    if inertia is None or not off:
        return False
    rings_hz = np.sqrt(inertia.stiffness / inertia.mass) / (2.0 * np.pi) * (1.0 + off[0])
    return any(
        abs(value - rings_hz) < _ONE_MODE * rings_hz
        for cause in one.causes
        if cause.id == "flexible_mode"
        for name, value in cause.parameters.items()
        if name.startswith("frequency")
    )


def has_overtone(evidence: Evidence, one: Explanation) -> bool:
    """Tell whether a cause repeats a few times within the period of another: its harmonic.

    What a reference does not see is the sensor's own all the same.
    """
    apart = {"encoder_interpolation"} if evidence.has(Tap.REF) else set()
    periods = [
        cause.parameters["period"]
        for cause in one.causes
        if cause.id not in apart and "period" in cause.parameters
    ]
    for long in periods:
        for short in periods:
            times = round(long / short)
            if 2 <= times <= _HARMONICS and abs(long / short - times) < _ONE_PERIOD * times:
                return True
    return False
