"""How often a cause is there that has a weight among its rivals: counted on blind cases.

::

    logit p = constant + slope · logit w + another · n

with the weight w of the cause on these records, and n others that are named on its axis. No weight
knows of machines that no formula describes, so it promises too much (Platt, Advances in Large
Margin Classifiers (1999) 61-74). ``rotemina gap blind --calibrate`` writes the file.
"""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import cache
from importlib import resources
from typing import Any

import numpy as np
from scipy.special import expit, logit

from rotemina.sim.arrays import FloatArray

FORMAT = "rotemina-calibration 2"
SHIPPED = "rotemina.resources.models", "diagnosis_calibration.json"
_LEAST = 1e-3  # of a weight, and of what it lacks of 1: no more is known of it


@dataclass(frozen=True, slots=True)
class Calibration:
    """The coefficients, and the share of effects that are only suspected which are there."""

    constant: float
    slope: float
    another: float
    suspected: float

    def probability(self, weight: float, others: int) -> float:
        """Return how probable a cause of a weight is beside others on its axis."""
        (features,) = features_of([(weight, others)])
        return float(expit(features @ np.array([self.constant, self.slope, self.another])))

    def as_json(self) -> dict[str, float]:
        """Return it as the file holds it."""
        return asdict(self)


def features_of(named: list[tuple[float, int]]) -> FloatArray:
    """Return (causes, 3), which the coefficients multiply, of weights and numbers of others."""
    return np.array(
        [(1.0, float(logit(np.clip(weight, _LEAST, 1.0 - _LEAST))), n) for weight, n in named]
    ).reshape(-1, 3)


def calibration_in(document: Mapping[str, Any]) -> Calibration:
    """Return the calibration that a document holds."""
    return Calibration(**{name: float(document[name]) for name in Calibration.__slots__})


@cache
def shipped() -> Calibration:
    """Return the calibration that the program carries."""
    package, name = SHIPPED
    return calibration_in(json.loads(resources.files(package).joinpath(name).read_text("utf-8")))
