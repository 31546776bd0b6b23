"""Constants by which a corrected model is off at each tap, where all records agree on them.

The constant part of one record may be its own: an odd start, or the origin of its counter. A
constant common to all records belongs to the machine, and is predicted.
"""

from collections.abc import Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.diagnosis import Offset
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect

_PIECES = 4  # of a single record
_BLOCKS = 8  # of a piece, whose means tell how sure its constant is
_AGREED = 0.04  # of the power of constants, that the others' mean may leave of each


def offsets(evidence: Evidence, effects: Sequence[AxisEffect] = ()) -> dict[Tap, Offset | None]:
    """Return the constant at each tap of a model with further effects; None where records disagree.

    Each record's constant, or that of each quarter of a single record, is foretold by those of the
    others: they agree where that leaves next to nothing.
    """
    by_tap: dict[Tap, list[FloatArray]] = {}
    answers = evidence.response(effects)
    for observation, answer in zip(evidence.observations, answers, strict=True):
        for tap, real in observation.real.items():
            kept = observation.kept.get(tap)
            gap = real - answer[tap]
            by_tap.setdefault(tap, []).append(gap if kept is None else gap[kept])
    return {tap: _offset(gaps) for tap, gaps in by_tap.items()}


def _offset(gaps: Sequence[FloatArray]) -> Offset | None:
    """Return the constant that gaps, each (n,) of a record, share."""
    pieces = gaps if len(gaps) > 1 else np.array_split(gaps[0], _PIECES)
    means = np.array([float(np.mean(piece)) for piece in pieces])
    count = len(means)
    foretold = (means.sum() - means) / (count - 1)
    within = np.array([_error(piece) for piece in pieces])
    left = np.sum((means - foretold) ** 2) - np.sum(within**2) * count / (count - 1)
    if left > _AGREED * np.sum(means**2):
        return None
    scatter = float(np.std(means, ddof=1)) / np.sqrt(count)
    return Offset(
        float(means.mean()), float(np.hypot(scatter, np.sqrt(np.mean(within**2) / count)))
    )


def _error(piece: FloatArray) -> float:
    """Return the standard error of the mean of a piece (n,) with correlated neighbours."""
    blocks = np.array([float(np.mean(one)) for one in np.array_split(piece, _BLOCKS)])
    return float(np.std(blocks, ddof=1)) / float(np.sqrt(_BLOCKS))
