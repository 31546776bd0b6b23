"""Comparison of commands and readings in slow motion, where the dynamics of an axis average out.

The signals are averaged over blocks that are long compared with the natural period of the axis.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import (
    Axis,
    ForceAxis,
    StepperAxis,
)

# A block covers at least this many natural periods of the axis, and this many rows.
_MIN_BLOCK_PERIODS = 10.0
_MIN_BLOCK_ROWS = 20
_MIN_BLOCKS = 10
# The block means must keep this fraction of the variance of the command.
_MIN_VARIANCE_RATIO = 0.1


@dataclass(frozen=True, slots=True, eq=False)
class SlowMotion:
    """Block means (b,) of the commands of an axis and of the other moving axes.

    The mean of each signal is removed. ``rows`` is the length of a block.
    """

    command: FloatArray
    others: Mapping[str, FloatArray]
    rows: int

    @classmethod
    def of(cls, described: Axis, record: Record, axis: str) -> Self | None:
        """Return the slow motion of an axis, or None if the record contains too little."""
        step_s = float(np.median(np.diff(record.time_s)))
        rows = max(
            round(_MIN_BLOCK_PERIODS * _find_natural_period_s(described, record) / step_s),
            _MIN_BLOCK_ROWS,
        )
        full_command = record.signal(axis, Tap.CMD)
        if len(full_command) < _MIN_BLOCKS * rows:
            return None
        command = _average_blocks(full_command, rows)
        if np.var(command) <= _MIN_VARIANCE_RATIO * np.var(full_command):
            return None
        others = {
            other: _average_blocks(record.signal(other, Tap.CMD), rows)
            for other in record.axes
            if other != axis
            and record.has(other, Tap.CMD)
            and np.ptp(record.signal(other, Tap.CMD)) > 0.0
        }
        return cls(command, others, rows)

    def average(self, signal: FloatArray) -> FloatArray:
        """Return the block means (b,) of a signal (n,) of the record, without their mean."""
        return _average_blocks(signal, self.rows)


def follows_command(described: Axis, record: Record) -> bool:
    """Return whether the position of an axis in slow motion follows the command, not a force."""
    return not isinstance(described, ForceAxis) or is_controlled(described, record)


def is_controlled(described: Axis, record: Record) -> bool:
    """Return whether an axis ran in a closed loop."""
    if isinstance(described, StepperAxis):
        return False
    return record.closed_loop and described.controller is not None


def _find_natural_period_s(axis: Axis, record: Record) -> float:
    if not isinstance(axis, StepperAxis) and is_controlled(axis, record):
        assert axis.controller is not None
        return 2.0 * pi / axis.controller.kp
    inertia = axis.inertia
    if inertia is None or inertia.stiffness == 0.0:
        return 0.0
    return 2.0 * pi * float(np.sqrt(inertia.mass / inertia.stiffness))


def _average_blocks(signal: FloatArray, rows: int) -> FloatArray:
    block_count = len(signal) // rows
    means = signal[: block_count * rows].reshape(block_count, rows).mean(axis=1)
    return np.asarray(means - means.mean())
