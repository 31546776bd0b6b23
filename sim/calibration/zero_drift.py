"""Detection of a drifting zero, which depends on time and cannot be calibrated."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.regression_columns import SensorRun
from rotemina.sim.messages import message
from rotemina.sim.units import format_exact

_BLOCKS_PER_RUN = 8
# The travel is divided into this many bins. The mean error in each bin depends on the position,
# not on time.
_BIN_COUNT = 40
# The means of blocks drift if neighbouring means have at least this correlation.
_MIN_CORRELATION = 0.5
# The variance of the means must be this many times the variance that chance explains.
_MIN_SPREAD_RATIO = 4.0


def find_zero_drift(runs: list[SensorRun], remainders: list[FloatArray], unit: str) -> list[str]:
    """Return a message if the remaining errors (n,) of the runs drift with time.

    Errors that repeat at the same positions are removed first. Without drift, the means of blocks
    of rows then scatter only by chance, and the noise inside the blocks shows by how much. If they
    scatter far more and neighbouring means are similar, the zero drifts.
    """
    position = np.concatenate([run.reference for run in runs])
    remaining = np.concatenate(remainders)
    low, span = float(position.min()), float(np.ptp(position)) or 1.0
    bins = np.minimum(((position - low) / span * _BIN_COUNT).astype(np.int64), _BIN_COUNT - 1)
    counts = np.maximum(np.bincount(bins, minlength=_BIN_COUNT), 1)
    remaining = remaining - (np.bincount(bins, remaining, minlength=_BIN_COUNT) / counts)[bins]
    blocks = np.array_split(remaining, _BLOCKS_PER_RUN * len(runs))
    means = np.array([block.mean() for block in blocks])
    chance_variance = np.mean(
        [np.mean(np.diff(block) ** 2) / (2.0 * len(block)) for block in blocks]
    )
    variance = float(means.var())
    neighbour_correlation = float(np.mean(means[1:] * means[:-1])) / variance if variance else 0.0
    if variance < _MIN_SPREAD_RATIO * chance_variance or neighbour_correlation < _MIN_CORRELATION:
        return []
    drift = format_exact(float(f"{np.sqrt(variance):.3g}"), unit)
    return [
        message(
            "engine",
            "the zero drifts by {drift} rms during the runs: it depends on time, not on the "
            "axis, and no calibration removes it; warm up, or calibrate often",
        ).fill(drift=drift)
    ]
