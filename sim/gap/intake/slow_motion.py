"""Commands and readings in slow motion, where an axis' own dynamics have averaged out.

They are compared by means over blocks that are long compared with the axis' own period.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis, ForceAxis, StepperAxis

_PERIODS = 10.0  # of the axis, in one block
_ROWS = 20  # in one block, at least
_BLOCKS = 10  # in a record, at least
_SLOW_SHARE = 0.1  # of a command's variance, that blocks must keep


@dataclass(frozen=True, slots=True, eq=False)
class SlowMotion:
    """Means over blocks, without their mean: the axis' command (b,) and those of others that move.

    ``rows`` are those of a block.
    """

    command: FloatArray
    others: Mapping[str, FloatArray]
    rows: int

    @classmethod
    def of(cls, described: Axis, record: Record, axis: str) -> Self | None:
        """Return the slow motion of an axis, or None where a record holds too little of it."""
        step_s = float(np.median(np.diff(record.time_s)))
        rows = max(round(_PERIODS * _own_period_s(described, record) / step_s), _ROWS)
        asked = record.signal(axis, Tap.CMD)
        if len(asked) < _BLOCKS * rows:
            return None
        command = _block_means(asked, rows)
        if np.var(command) <= _SLOW_SHARE * np.var(asked):
            return None
        others = {
            other: _block_means(record.signal(other, Tap.CMD), rows)
            for other in record.axes
            if other != axis
            and record.has(other, Tap.CMD)
            and np.ptp(record.signal(other, Tap.CMD)) > 0.0
        }
        return cls(command, others, rows)

    def read(self, signal: FloatArray) -> FloatArray:
        """Return the means (b,) of a signal (n,) of the record."""
        return _block_means(signal, self.rows)


def follows_command(described: Axis, record: Record) -> bool:
    """Tell whether a slow position follows the command, and not a force."""
    return not isinstance(described, ForceAxis) or under_controller(described, record)


def under_controller(described: Axis, record: Record) -> bool:
    """Whether an axis ran in a closed loop."""
    if isinstance(described, StepperAxis):
        return False
    return record.closed_loop and described.controller is not None


def _own_period_s(described: Axis, record: Record) -> float:
    if not isinstance(described, StepperAxis) and under_controller(described, record):
        assert described.controller is not None
        return 2.0 * pi / described.controller.kp
    inertia = described.inertia
    if inertia is None or inertia.stiffness == 0.0:
        return 0.0
    return 2.0 * pi * float(np.sqrt(inertia.mass / inertia.stiffness))


def _block_means(signal: FloatArray, rows: int) -> FloatArray:
    blocks = len(signal) // rows
    means = signal[: blocks * rows].reshape(blocks, rows).mean(axis=1)
    return np.asarray(means - means.mean())
