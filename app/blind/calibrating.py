"""The calibration of a diagnosis' probabilities, counted on the outcomes of blind cases."""

from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np
from scipy.optimize import minimize

from rotemina.app.blind.cases import BlindError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.scoring import Cause, Outcome, cause_of
from rotemina.sim.gap.compare.calibration import Calibration, features_of

_SHRUNK = 0.3  # half the inverse variance of coefficients that no case tells; the constant is free
_LEAST = 20  # causes below which coefficients mean nothing


def calibrated(outcomes: Sequence[Outcome]) -> Calibration:
    """Return the calibration by maximum likelihood, slightly shrunk.

    Raises
    ------
    BlindError
        If fewer than twenty causes were named.
    """
    named = [one for outcome in outcomes for one in _weighed(outcome)]
    if len(named) < _LEAST:
        raise BlindError(
            f"{len(named)} causes were named, {_LEAST} are needed for a calibration; run more cases"
        )
    features = features_of([(weight, others) for weight, others, _ in named])
    signs = np.array([1.0 if there else -1.0 for _, _, there in named])

    def loss(x: FloatArray) -> float:
        return float(np.sum(np.logaddexp(0.0, -signs * (features @ x))) + _SHRUNK * x[1:] @ x[1:])

    constant, slope, another = (float(x) for x in minimize(loss, np.zeros(3)).x)
    suspected = [one in outcome.there for outcome in outcomes for one in _suspected(outcome)]
    share = (sum(suspected) + 1.0) / (len(suspected) + 2.0)  # rule of succession
    return Calibration(constant, slope, another, share)


def _weighed(outcome: Outcome) -> Iterator[tuple[float, int, bool]]:
    """Give weight, number of others on the axis, and presence of every cause that was named."""
    causes = outcome.answer.get("causes", [])
    on_axis = Counter(one["axis"] for one in causes)
    for one in causes:
        if one.get("weight") is not None:
            yield float(one["weight"]), on_axis[one["axis"]] - 1, cause_of(one) in outcome.there


def _suspected(outcome: Outcome) -> Iterator[Cause]:
    for one in outcome.answer.get("suspected", []):
        yield cause_of(one)
