"""Constant offsets of a corrected model at each tap, if they are the same in all records.

An offset in only one record may come from an unusual start or from the origin of a counter. An
offset common to all records belongs to the machine, so it is part of the prediction.
"""

from collections.abc import Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.result import ModelOffset
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

# A single record is split into this many pieces.
_PIECES_PER_RECORD = 4
# The scatter of the means of this many blocks gives the standard error of the offset of a piece.
_BLOCKS_PER_PIECE = 8
# The differences of the offsets from the means of the others may have this fraction of their power.
_MAX_DISAGREEMENT_RATIO = 0.04


def estimate_offsets(
    evidence: Evidence, effects: Sequence[AxisEffect] = ()
) -> dict[Tap, ModelOffset | None]:
    """Return the offset at each tap of the model with ``effects``; None if the records disagree.

    The offset of each record, or of each quarter of a single record, is predicted by the mean of
    the others. The records agree if the errors of this prediction are small.
    """
    gaps_by_tap: dict[Tap, list[FloatArray]] = {}
    responses = evidence.response(effects)
    for observation, response in zip(evidence.observations, responses, strict=True):
        for tap, real in observation.real.items():
            is_kept = observation.kept.get(tap)
            gap = real - response[tap]
            gaps_by_tap.setdefault(tap, []).append(gap if is_kept is None else gap[is_kept])
    return {tap: _estimate_offset(gaps) for tap, gaps in gaps_by_tap.items()}


def _estimate_offset(gaps: Sequence[FloatArray]) -> ModelOffset | None:
    pieces = gaps if len(gaps) > 1 else np.array_split(gaps[0], _PIECES_PER_RECORD)
    means = np.array([float(np.mean(piece)) for piece in pieces])
    count = len(means)
    means_of_others = (means.sum() - means) / (count - 1)
    standard_errors = np.array([_estimate_standard_error(piece) for piece in pieces])
    disagreement = np.sum((means - means_of_others) ** 2) - np.sum(standard_errors**2) * count / (
        count - 1
    )
    if disagreement > _MAX_DISAGREEMENT_RATIO * np.sum(means**2):
        return None
    scatter = float(np.std(means, ddof=1)) / np.sqrt(count)
    return ModelOffset(
        float(means.mean()), float(np.hypot(scatter, np.sqrt(np.mean(standard_errors**2) / count)))
    )


def _estimate_standard_error(piece: FloatArray) -> float:
    """Return the standard error of the mean of a piece (n,) whose samples are correlated."""
    blocks = np.array([float(np.mean(block)) for block in np.array_split(piece, _BLOCKS_PER_PIECE)])
    return float(np.std(blocks, ddof=1)) / float(np.sqrt(_BLOCKS_PER_PIECE))
