"""Moves from level to level as the jumps that they stand for, so that steps can be measured."""

from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Channel, Record, Tap

_HOLD_ROWS = 50  # at least, as the measuring of steps wants them


def jumped(record: Record, axis: str, drive: Tap) -> tuple[Record, float]:
    """Return a record whose input jumps where it moved one way between two holds.

    An axis that declares speed and acceleration is never told to jump: its levels are ramps of
    some rows. The jump is put where the ramp begins, so rise and delay count the ramp in.

    Returns
    -------
    Record
        The same one where the input has no such ramp, or is noisy.
    float
        The longest ramp, s; 0 without any.
    """
    command = record.signal(axis, drive)
    moving = np.flatnonzero(np.diff(command))  # from this row to the next
    if len(moving) == 0:
        return record, 0.0
    breaks = np.flatnonzero(np.diff(moving) >= _HOLD_ROWS)
    begins = moving[np.concatenate([[0], breaks + 1])]
    ends = moving[np.concatenate([breaks, [len(moving) - 1]])] + 1
    levels, longest_s = command.copy(), 0.0
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        if end - begin < 2 or not _one_way(command[begin : end + 1]):
            continue
        levels[begin + 1 : end] = command[end]
        longest_s = max(longest_s, float(record.time_s[end] - record.time_s[begin]))
    if longest_s == 0.0:
        return record, 0.0
    column = record.columns.index(Channel(axis, drive))
    values = record.values.copy()
    values[:, column] = levels
    return replace(record, values=values), longest_s


def _one_way(values: FloatArray) -> bool:
    steps = np.diff(values)
    return bool((steps >= 0.0).all() or (steps <= 0.0).all())
