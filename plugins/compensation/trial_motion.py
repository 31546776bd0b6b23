"""The motion that tests compensation, and its remaining error; free of widgets."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.plugins.compensation import mark
from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

NAME = "compensation trial"
_RATE_HZ, _WHOLE_S, _HZ = 500.0, 6.0, 1.0
_SWING, _FADED = 0.3, 0.75  # of the range: the first swing; how much less the last one is
_ONSET_S, _SKIPPED_S = 1.0, 2.0


class Aid(StrEnum):
    """What helped the axis on a trial."""

    NONE = mark("without")
    INVERSE = mark("with the inverse")
    LOOP = mark("with feedback")
    BOTH = mark("with both")

    @classmethod
    def of(cls, *, inverse: bool, loop: bool) -> "Aid":
        """Return it for what was on."""
        if inverse:
            return cls.BOTH if loop else cls.INVERSE
        return cls.LOOP if loop else cls.NONE


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """What one play of the motion left, SI: rms about the mean, the mean, and the loop (n,)."""

    by: Aid
    rms: float
    offset: float
    wanted: FloatArray
    position: FloatArray


def trial_motion(robot: Robot, axis: str) -> Record:
    """Return swings about mid-range that grow at first and fade then."""
    described = robot.axes[axis]
    time_s = np.arange(round(_WHOLE_S * _RATE_HZ)) / _RATE_HZ
    onset = np.minimum(time_s / _ONSET_S, 1.0)
    onset = onset**3 * (10.0 - 15.0 * onset + 6.0 * onset**2)
    swing = _SWING * (1.0 - _FADED * time_s / _WHOLE_S) * onset
    shares = 0.5 + swing * np.sin(2.0 * np.pi * _HZ * time_s)
    path = described.range[0] + described.span * shares
    units = {axis: robot.unit(axis) or "m"}
    return Record.from_signals(time_s, {(axis, Tap.CMD): path}, units, {"name": NAME})


def trial_of(record: Record, axis: str) -> Trial | None:
    """Return the result of a recorded trial of an axis; None if incomplete."""
    if record.metadata.get("trajectory") != NAME or not record.has(axis, Tap.MEAS):
        return None
    since = record.time_s >= record.time_s[0] + _SKIPPED_S
    if not since.any():
        return None
    wanted = record.signal(axis, Tap.CMD)[since]
    position = record.signal(axis, Tap.MEAS)[since]
    left = position - wanted
    return Trial(
        Aid.of(
            inverse=f"compensation {axis}" in record.metadata,
            loop=f"feedback {axis}" in record.metadata,
        ),
        float(np.std(left)),
        float(np.mean(left)),
        wanted,
        position,
    )
