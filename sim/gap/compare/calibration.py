"""How often a cause is there that has a weight among its rivals: counted on blind cases.

::

    p = wˢ / (1 + exp(−c − b n))

with the weight w of the cause on these records, and n others that are named on its axis. Weights
tell rivals apart; they know nothing of machines that no formula describes, where all are wrong
(Platt, Advances in Large Margin Classifiers (1999) 61-74). ``rotemina gap blind --calibrate``
writes the file.
"""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from functools import cache
from importlib import resources
from typing import Any

import numpy as np
from scipy.special import expit

from rotemina.sim.arrays import FloatArray, IntArray

FORMAT = "rotemina-calibration 1"
SHIPPED = "rotemina.resources.models", "diagnosis_calibration.json"


@dataclass(frozen=True, slots=True)
class Calibration:
    """The coefficients c, b and s, and the share of effects only suspected that are there."""

    intercept: float
    per_other_cause: float
    exponent: float
    suspected: float

    def probability(self, weight: float, others: int) -> float:
        """Return how probable a cause of a weight is beside others on its axis."""
        coefficients = self.intercept, self.per_other_cause, self.exponent
        return float(probabilities(np.array([weight]), np.array([others]), *coefficients)[0])

    def as_json(self) -> dict[str, float]:
        """Return it as the file holds it."""
        return asdict(self)


def probabilities(
    weights: FloatArray,
    others: IntArray,
    intercept: float,
    per_other_cause: float,
    exponent: float,
) -> FloatArray:
    """Return the probabilities (causes,) of weights (causes,) beside others (causes,)."""
    return np.asarray(weights**exponent * expit(intercept + per_other_cause * others))


def calibration_in(document: Mapping[str, Any]) -> Calibration:
    """Return the calibration that a document holds."""
    return Calibration(**{one.name: float(document[one.name]) for one in fields(Calibration)})


@cache
def shipped() -> Calibration:
    """Return the calibration that the program carries."""
    package, name = SHIPPED
    return calibration_in(json.loads(resources.files(package).joinpath(name).read_text("utf-8")))
