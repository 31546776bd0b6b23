"""Calibration of the probabilities of a diagnosis from the outcomes of blind cases."""

from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np
from scipy.optimize import minimize

from rotemina.app.errors import BlindError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import (
    CaseOutcome,
    Cause,
    make_cause,
)
from rotemina.sim.gap.compare import Calibration, probabilities

# Penalty on the squared coefficient of other causes, for which only few cases give information.
_INTERACTION_PENALTY = 0.3
# Probabilities are clipped here, so that one outcome cannot make the likelihood zero.
_MIN_PROBABILITY = 1e-6
# With fewer causes, the fitted coefficients would mean nothing.
_MIN_CAUSES = 20


def fit_calibration(outcomes: Sequence[CaseOutcome]) -> Calibration:
    """Fit the calibration by penalised maximum likelihood.

    Raises
    ------
    BlindError
        If fewer than 20 causes were named.
    """
    weighted_causes = [cause for outcome in outcomes for cause in _list_weighted_causes(outcome)]
    if len(weighted_causes) < _MIN_CAUSES:
        raise BlindError(
            f"{len(weighted_causes)} causes were named, but a calibration needs {_MIN_CAUSES}; "
            "run more cases"
        )
    weights, other_counts, is_present = (
        np.array(column) for column in zip(*weighted_causes, strict=True)
    )

    def compute_loss(x: FloatArray) -> float:
        predicted = np.clip(
            probabilities(weights, other_counts, *x), _MIN_PROBABILITY, 1.0 - _MIN_PROBABILITY
        )
        return float(
            _INTERACTION_PENALTY * x[1] ** 2
            - np.sum(np.log(np.where(is_present, predicted, 1.0 - predicted)))
        )

    start, bounds = (2.0, -1.0, 0.5), ((-5.0, 5.0), (-5.0, 0.0), (0.0, 2.0))
    coefficients = minimize(compute_loss, start, method="Nelder-Mead", bounds=bounds).x.tolist()
    is_suspected_present = [
        cause in outcome.present_causes
        for outcome in outcomes
        for cause in _list_suspected_causes(outcome)
    ]
    # Laplace's rule of succession.
    suspected_probability = (sum(is_suspected_present) + 1.0) / (len(is_suspected_present) + 2.0)
    return Calibration(*coefficients, suspected_probability)


def _list_weighted_causes(outcome: CaseOutcome) -> Iterator[tuple[float, int, bool]]:
    """Yield weight, number of other causes on the axis, and presence of each named cause."""
    causes = outcome.answer.get("causes", [])
    axis_counts = Counter(cause["axis"] for cause in causes)
    for cause in causes:
        if cause.get("weight") is not None:
            yield (
                float(cause["weight"]),
                axis_counts[cause["axis"]] - 1,
                make_cause(cause) in outcome.present_causes,
            )


def _list_suspected_causes(outcome: CaseOutcome) -> Iterator[Cause]:
    for cause in outcome.answer.get("suspected", []):
        yield make_cause(cause)
