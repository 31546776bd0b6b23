"""Rests of a record's set-point, and the direction of each approach."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray, IntArray
from rotemina.sim.calibration.iso230 import LEAST_RUNS

LEAST_HOLD_S = 0.1
_SETTLED = 0.5  # the later share of a hold is averaged
_SAME = 1e-9  # relative to the travel: targets that are one


class Approaches(NamedTuple):
    """Targets (m,) that were approached from both sides as often.

    ``rows`` (m, n, 2) are begins and ``ends`` (m, n, 2) ends of the settled part of each hold, by
    target, run and direction (↑, ↓).
    """

    targets: FloatArray
    rows: IntArray
    ends: IntArray

    def means(self, signal: FloatArray, sound: BoolArray) -> FloatArray:
        """Return means (m, n, 2) of a signal over the holds; NaN where no row of one is sound."""
        total = np.concatenate([[0.0], np.cumsum(np.where(sound, signal, 0.0))])
        count = np.concatenate([[0], np.cumsum(sound)])
        with np.errstate(invalid="ignore"):
            return np.asarray(
                (total[self.ends] - total[self.rows]) / (count[self.ends] - count[self.rows])
            )


def find_holds(time_s: FloatArray, command: FloatArray) -> IntArray:
    """Return begins and ends (h, 2) of where a command (n,) rests for 0.1 s after a move."""
    changes = np.flatnonzero(np.diff(command) != 0.0) + 1
    begins = np.concatenate([[0], changes])
    ends = np.concatenate([changes, [len(command)]])
    held = time_s[np.minimum(ends, len(time_s) - 1)] - time_s[begins] >= LEAST_HOLD_S
    held[0] = False  # it is not known from which side it was reached
    return np.stack([begins[held], ends[held]], axis=1)


def approaches(time_s: FloatArray, command: FloatArray) -> Approaches | None:
    """Find holds of ``command`` (n,) of at least 0.1 s; None where none was reached both ways.

    A target that was reached more often from one side counts as often as from the other.
    """
    begins, ends = find_holds(time_s, command).T
    rising = command[begins] > command[begins - 1]
    span = float(np.ptp(command)) or 1.0
    place = np.rint(command[begins] / (_SAME * span)).astype(np.int64)
    found = []
    for target in np.unique(place):
        sides = [np.flatnonzero((place == target) & (rising == up)) for up in (True, False)]
        if min(map(len, sides)) >= LEAST_RUNS:
            found.append(sides)
    if not found:
        return None
    runs = min(len(side) for sides in found for side in sides)
    holds = np.array([[side[:runs] for side in sides] for sides in found]).transpose(0, 2, 1)
    first = begins[holds] + np.ceil((ends[holds] - begins[holds]) * _SETTLED).astype(np.int64)
    return Approaches(command[begins[holds[:, 0, 0]]], first, ends[holds])
