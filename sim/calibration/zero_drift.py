"""A drifting zero, which depends on time, not on the axis, and cannot be calibrated."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.regression_columns import Run
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact

_BLOCKS = 8  # of each run
_BINS = 40  # of the travel, whose means belong to the axis
_RELATED = 0.5  # correlation of neighbours from which the means of blocks wander
_OVER = 4.0  # times what the scatter within blocks explains


def zero_drifts(runs: list[Run], remainders: list[FloatArray], unit: str) -> list[str]:
    """Say whether what the model leaves (n,) of each run wanders with time.

    The means of blocks of rows, without what repeats at the same positions, scatter by chance as
    the rows inside them let expect. Where they scatter by far more, and each is like the one
    before, the zero wanders.
    """
    position = np.concatenate([run.reference for run in runs])
    rest = np.concatenate(remainders)
    low, span = float(position.min()), float(np.ptp(position)) or 1.0
    bins = np.minimum(((position - low) / span * _BINS).astype(np.int64), _BINS - 1)
    counts = np.maximum(np.bincount(bins, minlength=_BINS), 1)
    rest = rest - (np.bincount(bins, rest, minlength=_BINS) / counts)[bins]
    blocks = np.array_split(rest, _BLOCKS * len(runs))
    means = np.array([block.mean() for block in blocks])
    inside = np.mean([np.mean(np.diff(block) ** 2) / (2.0 * len(block)) for block in blocks])
    spread = float(means.var())
    related = float(np.mean(means[1:] * means[:-1])) / spread if spread else 0.0
    if spread < _OVER * inside or related < _RELATED:
        return []
    drift = exact(float(f"{np.sqrt(spread):.3g}"), unit)
    return [
        message(
            "engine",
            "the zero drifts by {drift} rms during the runs: it depends on time, not on the "
            "axis, and no calibration removes it; warm up, or calibrate often",
        ).fill(drift=drift)
    ]
