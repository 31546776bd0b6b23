"""The steps of a coarse reading as an effect, with which the model reads as the sensor does."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import AttachedEffect, EffectSignature
from rotemina.sim.gap.fit import Evidence, shown_as
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

_FIRST_REACH = 8.0  # steps about the middle, within which a step that is roughly known counts right
_WIDER = 3.0  # times that, each time that the step is known better
_SHIFTS = 100
_FINER = 8.0  # times, for the shifts about the best one
_CLOSES = 0.9  # of what was left, that is left with steps at most


def steps_of(evidence: Evidence, effects: Sequence[AxisEffect], step: float) -> AxisEffect | None:
    """Return the effect of a coarse sensor as the readings show it in addition to other effects.

    ``step`` is an estimate, SI. None if a model with steps is no nearer to the readings, for
    example if the motion is not known to a fraction of a step.
    """
    effect = shown_as(EffectSignature.STEPS)
    if effect is None:
        return None
    pairs = []
    for observation, answer in zip(evidence.observations, evidence.response(effects), strict=True):
        if Tap.MEAS in observation.real:
            reading = observation.real[Tap.MEAS]
            kept = observation.kept.get(Tap.MEAS, np.ones(len(reading), dtype=np.bool_))
            pairs.append((reading[kept], answer[Tap.MEAS][kept]))
    width = grid_width([reading for reading, _ in pairs], step)
    shifts = np.arange(_SHIFTS) / _SHIFTS - 0.5
    for _ in range(2):
        left = [_left(pairs, width, shift) for shift in shifts]
        best = float(shifts[int(np.argmin(left))])
        shifts = best + (np.arange(_SHIFTS) / _SHIFTS - 0.5) / _FINER
    plain = sum(float(np.sum((r - a - np.mean(r - a)) ** 2)) for r, a in pairs)
    if min(left) > _CLOSES * plain:
        return None
    numbers = {"step": width, "shift": (best + 0.5) % 1.0 - 0.5}
    asked = AxisEffect(axis=evidence.axis, id=effect)
    return replace(asked, parameters=AttachedEffect.of(evidence.robot, asked).clip_values(numbers))


def grid_width(readings: Sequence[FloatArray], step: float) -> float:
    """Return the width of a grid on which all readings (n,) lie, apart from noise.

    A step with a small error still counts the steps of a short distance correctly, and that refines
    it enough for a longer distance.
    """
    where = np.concatenate(readings)
    middle = float(np.median(where))
    away = where - middle
    furthest, reach, phase = float(np.abs(away).max()), _FIRST_REACH * step, 0.0
    while True:
        near = away[np.abs(away) <= reach]
        # The phase first: the middle may lie between two steps.
        turned = np.angle(np.mean(np.exp(2j * np.pi * near / step)))
        phase = float(turned) / (2.0 * np.pi)
        count = np.rint(near / step - phase)
        if np.ptp(count) > 0.0:
            step = float(np.polyfit(count, near, 1)[0])
        if reach >= furthest:
            return step
        reach *= _WIDER


def _left(pairs: Sequence[tuple[FloatArray, FloatArray]], width: float, shift: float) -> float:
    """Return what answers (n,) read in steps leave of readings (n,), each record's mean apart."""
    total = 0.0
    for reading, answer in pairs:
        gap = reading - width * (np.rint(answer / width - shift) + shift)
        total += float(np.sum((gap - gap.mean()) ** 2))
    return total
