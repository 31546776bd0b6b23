"""Accuracy and repeatability of positioning, ISO 230-2:2014.

An axis approaches m targets from both directions, n times each. ``x_ij`` is the positional
deviation at target i in approach j, ``x̄_i`` its mean over j and ``s_i`` its standard deviation
(divisor n − 1), each by direction ↑ and ↓. The figures are those of sections 2 and 8 there.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.messages import message

LEAST_RUNS = 2
ISO_RUNS, ISO_TARGETS = 5, 5  # what the standard asks for at the least, up to 2 m of travel


class Positioning(NamedTuple):
    """The figures of one axis, m or rad, ISO 230-2:2014.

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


def positioning(deviations: FloatArray) -> Positioning:
    """Return the figures of deviations (m targets, n runs, 2 directions: ↑ and ↓), m or rad.

    Raises
    ------
    CalibrationError
        If there is no target, or fewer than two runs: they have no spread.
    """
    if deviations.ndim != 3 or deviations.shape[2] != 2 or not deviations.size:
        raise CalibrationError(
            message(
                "engine", "deviations have shape {shape}; ISO 230-2 needs (targets, runs, 2)"
            ).fill(shape=str(deviations.shape))
        )
    if deviations.shape[1] < LEAST_RUNS:
        raise CalibrationError(
            message(
                "engine",
                "each target was approached {shape} times from each side; ISO 230-2 needs "
                "{iso_runs} runs, a spread at least {least_runs}",
            ).fill(shape=deviations.shape[1], iso_runs=ISO_RUNS, least_runs=LEAST_RUNS)
        )
    mean = deviations.mean(axis=1)
    spread = deviations.std(axis=1, ddof=1)
    up, down = spread[:, 0], spread[:, 1]
    reversal = mean[:, 0] - mean[:, 1]
    both = mean.mean(axis=1)
    at_target = np.max([2.0 * (up + down) + np.abs(reversal), 4.0 * up, 4.0 * down], axis=0)
    return Positioning(
        accuracy=float((mean + 2.0 * spread).max() - (mean - 2.0 * spread).min()),
        repeatability=float(at_target.max()),
        repeatability_up=float(4.0 * up.max()),
        repeatability_down=float(4.0 * down.max()),
        reversal=float(np.abs(reversal).max()),
        mean_reversal=float(reversal.mean()),
        systematic=float(np.ptp(mean)),
        mean_bidirectional=float(np.ptp(both)),
    )
