"""Trial motion that shows the remaining error of the compensation, without widgets."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.plugins.compensation import mark
from rotemina.sim.arrays import FloatArray
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot

TRIAL_NAME = "compensation trial"
_RATE_HZ, _DURATION_S, _OSCILLATION_HZ = 500.0, 6.0, 1.0

# Amplitude of the first oscillation relative to the range, and its relative decrease by the end.
_FIRST_AMPLITUDE_RATIO, _DECAY_RATIO = 0.3, 0.75

# The oscillations grow during the onset. The evaluation skips the first part of the trial.
_ONSET_S, _SKIPPED_S = 1.0, 2.0


class CompensationMode(StrEnum):
    """Compensation that was active during a trial."""

    NONE = mark("without")
    INVERSE = mark("with the inverse")
    LOOP = mark("with feedback")
    BOTH = mark("with both")

    @classmethod
    def from_flags(cls, *, inverse: bool, loop: bool) -> "CompensationMode":
        """Return the mode for an active inverse and an active loop."""
        if inverse:
            return cls.BOTH if loop else cls.INVERSE
        return cls.LOOP if loop else cls.NONE


@dataclass(frozen=True, slots=True, eq=False)
class CompensationTrial:
    """Result of one trial in SI units.

    ``rms`` is the rms of the error about its mean, ``offset`` the mean of the error. ``reference``
    and ``position`` have shape (n,).
    """

    mode: CompensationMode
    rms: float
    offset: float
    reference: FloatArray
    position: FloatArray


def make_trial_motion(robot: Robot, axis: str) -> Record:
    """Return oscillations about mid-range. They grow during the onset and then decay."""
    axis_model = robot.axes[axis]
    time_s = np.arange(round(_DURATION_S * _RATE_HZ)) / _RATE_HZ
    onset_time = np.minimum(time_s / _ONSET_S, 1.0)
    onset = onset_time**3 * (10.0 - 15.0 * onset_time + 6.0 * onset_time**2)
    amplitude = _FIRST_AMPLITUDE_RATIO * (1.0 - _DECAY_RATIO * time_s / _DURATION_S) * onset
    relative_position = 0.5 + amplitude * np.sin(2.0 * np.pi * _OSCILLATION_HZ * time_s)
    command = axis_model.range[0] + axis_model.span * relative_position
    units = {axis: robot.unit(axis) or "m"}
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, units, {"name": TRIAL_NAME})


def evaluate_trial(record: Record, axis: str) -> CompensationTrial | None:
    """Return the result of a trial of an axis, or None if the record is not of a trial."""
    if record.metadata.get("trajectory") != TRIAL_NAME or not record.has(axis, Tap.MEAS):
        return None
    rows = record.time_s >= record.time_s[0] + _SKIPPED_S
    if not rows.any():
        return None
    reference = record.signal(axis, Tap.CMD)[rows]
    position = record.signal(axis, Tap.MEAS)[rows]
    error = position - reference
    return CompensationTrial(
        CompensationMode.from_flags(
            inverse=f"compensation {axis}" in record.metadata,
            loop=f"feedback {axis}" in record.metadata,
        ),
        float(np.std(error)),
        float(np.mean(error)),
        reference,
        position,
    )
