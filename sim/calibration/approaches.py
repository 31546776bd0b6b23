"""Holds of a record's set-point, and the direction of each approach."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.calibration.iso230 import MIN_SPREAD_RUNS

MIN_HOLD_S = 0.1
# A hold is averaged only after this share of its duration, when the axis has settled.
_SETTLED_SHARE = 0.5
# Targets that differ by less than this share of the travel are the same target.
_SAME_TARGET_SHARE = 1e-9


class TargetApproaches(NamedTuple):
    """Targets (m,) that were approached equally often from both sides.

    ``begins`` (m, n, 2) and ``ends`` (m, n, 2) are the rows of the settled part of each hold, by
    target, run and direction (↑, ↓).
    """

    targets: FloatArray
    begins: IntArray
    ends: IntArray

    def compute_means(self, signal: FloatArray, valid: BoolArray) -> FloatArray:
        """Return the means (m, n, 2) of a signal over the holds.

        Only rows where ``valid`` (n,) is true count. A hold without such a row gives NaN.
        """
        total = np.concatenate([[0.0], np.cumsum(np.where(valid, signal, 0.0))])
        count = np.concatenate([[0], np.cumsum(valid)])
        with np.errstate(invalid="ignore"):
            return np.asarray(
                (total[self.ends] - total[self.begins]) / (count[self.ends] - count[self.begins])
            )


def find_holds(time_s: FloatArray, command: FloatArray) -> IntArray:
    """Return begins and ends (h, 2) of the holds of a command (n,) that last 0.1 s or more."""
    changes = np.flatnonzero(np.diff(command) != 0.0) + 1
    begins = np.concatenate([[0], changes])
    ends = np.concatenate([changes, [len(command)]])
    is_hold = time_s[np.minimum(ends, len(time_s) - 1)] - time_s[begins] >= MIN_HOLD_S
    # It is not known from which side the first hold was reached.
    is_hold[0] = False
    return np.stack([begins[is_hold], ends[is_hold]], axis=1)


def find_approaches(time_s: FloatArray, command: FloatArray) -> TargetApproaches | None:
    """Find the holds of ``command`` (n,) of at least 0.1 s, by target and direction.

    Every target keeps the same number of approaches from each side; any further ones are
    discarded. Return None if no target was approached at least twice from each side.
    """
    begins, ends = find_holds(time_s, command).T
    rising = command[begins] > command[begins - 1]
    span = float(np.ptp(command)) or 1.0
    target_indices = np.rint(command[begins] / (_SAME_TARGET_SHARE * span)).astype(np.int64)
    holds_by_target = []
    for target in np.unique(target_indices):
        sides = [
            np.flatnonzero((target_indices == target) & (rising == up)) for up in (True, False)
        ]
        if min(map(len, sides)) >= MIN_SPREAD_RUNS:
            holds_by_target.append(sides)
    if not holds_by_target:
        return None
    run_count = min(len(side) for sides in holds_by_target for side in sides)
    holds = np.array([[side[:run_count] for side in sides] for sides in holds_by_target]).transpose(
        0, 2, 1
    )
    settled_begins = begins[holds] + np.ceil((ends[holds] - begins[holds]) * _SETTLED_SHARE).astype(
        np.int64
    )
    return TargetApproaches(command[begins[holds[:, 0, 0]]], settled_begins, ends[holds])
