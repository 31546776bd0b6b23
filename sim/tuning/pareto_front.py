"""Second objective of a search, points of its Pareto front, and the choice of a point."""

from enum import StrEnum

import numpy as np
from pydantic.dataclasses import dataclass

from rotemina.sim.arrays import FloatArray
from rotemina.sim.feedback import ControllerGains
from rotemina.sim.robot import FORBID_UNKNOWN
from rotemina.sim.tuning.performance_figures import TuningFigures


class SecondObjective(StrEnum):
    """The second objective, in addition to the tracking error."""

    SETTLING = "settling"
    EFFORT = "effort"


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class FrontPoint:
    """A set of gains and its figures."""

    gains: ControllerGains
    figures: TuningFigures


def find_knee(objectives: FloatArray) -> int:
    """Return the index of the knee of a front (n, 2) of two objectives to minimise.

    The knee is the point farthest from the straight line between the ends of the front, with each
    objective divided by its spread. In a front of one or two points, it is the best point of the
    first objective.

    Source: Das, Structural Optimization 18 (1999) 107–115.
    """
    best_of_first = int(np.argmin(objectives[:, 0]))
    low, high = objectives.min(axis=0), objectives.max(axis=0)
    if len(objectives) < 3 or (high <= low).any():
        return best_of_first
    normalised = (objectives - low) / (high - low)
    # The ends lie at (0, 1) and (1, 0), so this is proportional to the distance from their line.
    distance = 1.0 - normalised.sum(axis=1)
    return int(np.argmax(distance)) if distance.max() > 0.0 else best_of_first
