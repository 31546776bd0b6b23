"""The calibration of a diagnosis' probabilities, counted on the outcomes of blind cases."""

from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np
from scipy.optimize import minimize

from rotemina.app.blind.cases import BlindError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.scoring import Cause, Outcome, cause_of
from rotemina.sim.gap.compare.calibration import Calibration, probabilities

_SHRUNK = 0.3  # of the square of what another cause changes, which few cases tell
_NEVER = 1e-6  # the least probability that is counted
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
    weights, others, there = (np.array(column) for column in zip(*named, strict=True))

    def loss(x: FloatArray) -> float:
        told = np.clip(probabilities(weights, others, *x), _NEVER, 1.0 - _NEVER)
        return float(_SHRUNK * x[1] ** 2 - np.sum(np.log(np.where(there, told, 1.0 - told))))

    start, bounds = (2.0, -1.0, 0.5), ((-5.0, 5.0), (-5.0, 0.0), (0.0, 2.0))
    coefficients = minimize(loss, start, method="Nelder-Mead", bounds=bounds).x.tolist()
    suspected = [one in outcome.there for outcome in outcomes for one in _suspected(outcome)]
    share = (sum(suspected) + 1.0) / (len(suspected) + 2.0)  # rule of succession
    return Calibration(*coefficients, share)


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
