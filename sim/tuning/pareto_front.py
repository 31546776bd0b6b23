"""Points of a Pareto front, and the one to recommend."""

import numpy as np
from pydantic.dataclasses import dataclass

from rotemina.sim.arrays import FloatArray
from rotemina.sim.feedback.gains import Gains
from rotemina.sim.robot.numbers import FORBID_UNKNOWN
from rotemina.sim.tuning.performance_figures import Figures


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Point:
    """A set of gains with its figures."""

    gains: Gains
    figures: Figures


def knee_of(objectives: FloatArray) -> int:
    """Return which row (n, 2) of a front bends away most from the line between its ends.

    Both objectives are least; each is taken as a share of its spread. Of a front of one or two
    points, the best of the first objective.

    Source: Das, Structural Optimization 18 (1999) 107–115.
    """
    first = int(np.argmin(objectives[:, 0]))
    low, high = objectives.min(axis=0), objectives.max(axis=0)
    if len(objectives) < 3 or (high <= low).any():
        return first
    shares = (objectives - low) / (high - low)
    distance = 1.0 - shares.sum(axis=1)  # the ends lie at (0, 1) and (1, 0)
    return int(np.argmax(distance)) if distance.max() > 0.0 else first
