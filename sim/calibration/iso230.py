"""Accuracy and repeatability of positioning after ISO 230-2:2014.

An axis approaches m targets from both directions, n times each. ``x_ij`` is the positional
deviation at target i in approach j, ``x̄_i`` its mean over j and ``s_i`` its standard deviation
(divisor n − 1), each by direction ↑ and ↓. Sections 2 and 8 of the standard define the figures.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import SensorCalibrationError

# A standard deviation needs two runs.
MIN_SPREAD_RUNS = 2
# The standard requires at least these numbers for up to 2 m of travel.
MIN_ISO_RUNS, MIN_ISO_TARGETS = 5, 5


class PositioningFigures(NamedTuple):
    """The positioning figures of one axis, m or rad, ISO 230-2:2014.

    ``accuracy``                A  = max(x̄_i + 2 s_i) − min(x̄_i − 2 s_i), over both directions
    ``repeatability``           R  = max_i max(2 s_i↑ + 2 s_i↓ + |B_i|, 4 s_i↑, 4 s_i↓)
    ``repeatability_up``        R↑ = max_i 4 s_i↑, and ``repeatability_down`` R↓
    ``reversal``                B  = max_i |B_i|, B_i = x̄_i↑ − x̄_i↓
    ``mean_reversal``           B̄  = mean of B_i, with its sign
    ``systematic``              E  = max x̄_i − min x̄_i, over both directions
    ``mean_bidirectional``      M  = max x̿_i − min x̿_i, x̿_i = (x̄_i↑ + x̄_i↓)/2
    """

    accuracy: float
    repeatability: float
    repeatability_up: float
    repeatability_down: float
    reversal: float
    mean_reversal: float
    systematic: float
    mean_bidirectional: float


def compute_positioning(deviations: FloatArray) -> PositioningFigures:
    """Return the figures of deviations (m targets, n runs, 2 directions: ↑ and ↓), m or rad.

    Raises
    ------
    SensorCalibrationError
        If there is no target, or if there are fewer than two runs.
    """
    if deviations.ndim != 3 or deviations.shape[2] != 2 or not deviations.size:
        raise SensorCalibrationError(
            "deviations have shape {shape}; ISO 230-2 needs (targets, runs, 2)",
            shape=str(deviations.shape),
        )
    if deviations.shape[1] < MIN_SPREAD_RUNS:
        raise SensorCalibrationError(
            "each target was approached {shape} times from each side; ISO 230-2 needs "
            "{iso_runs} runs; a standard deviation needs at least {least_runs}",
            shape=deviations.shape[1],
            iso_runs=MIN_ISO_RUNS,
            least_runs=MIN_SPREAD_RUNS,
        )
    means = deviations.mean(axis=1)
    spreads = deviations.std(axis=1, ddof=1)
    up, down = spreads[:, 0], spreads[:, 1]
    reversal = means[:, 0] - means[:, 1]
    bidirectional_mean = means.mean(axis=1)
    target_repeatability = np.max(
        [2.0 * (up + down) + np.abs(reversal), 4.0 * up, 4.0 * down], axis=0
    )
    return PositioningFigures(
        accuracy=float((means + 2.0 * spreads).max() - (means - 2.0 * spreads).min()),
        repeatability=float(target_repeatability.max()),
        repeatability_up=float(4.0 * up.max()),
        repeatability_down=float(4.0 * down.max()),
        reversal=float(np.abs(reversal).max()),
        mean_reversal=float(reversal.mean()),
        systematic=float(np.ptp(means)),
        mean_bidirectional=float(np.ptp(bidirectional_mean)),
    )
