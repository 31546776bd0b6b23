"""Which of the model's own parameters, re-tuned along with the causes, is a cause itself."""

from dataclasses import replace

from rotemina.sim.gap.baseline import GAIN, baseline
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import fit, held_out
from rotemina.sim.gap.models import Explanation
from rotemina.sim.gap.selection import LEAST_SHARE
from rotemina.sim.robot.model import AxisEffect

_BRINGS_ALONG = {"hysteresis": (GAIN,)}  # what the shape of a loop cannot be told from


def attributed(evidence: Evidence, raw: float, explanation: Explanation) -> Explanation:
    """Return the explanation with those own parameters as causes that alone close their share.

    What does not is left where it was, as a small re-tuning that the causes bring along.
    """
    named = {cause.id for cause in explanation.causes}
    own = [one for one in baseline(evidence) if one.id not in named]
    brought = {name for cause in named for name in _BRINGS_ALONG.get(cause, ())}
    found = list(explanation.causes)
    alone = {one.id: _score_without(evidence, explanation, one.id) for one in own}
    for one in own:
        closes = alone[one.id] - explanation.score >= LEAST_SHARE * (raw - 1.0)
        if closes and one.id not in brought:
            found.append(_fitted(explanation, one.id))
    if not found and own:
        # Either would do: the one without which most is left.
        most = max(own, key=lambda one: alone[one.id])
        found.append(_fitted(explanation, most.id))
    return replace(explanation, causes=tuple(found))


def _score_without(evidence: Evidence, explanation: Explanation, name: str) -> float:
    others = [one for one in explanation.fit.effects if one.id != name]
    fitted = fit(evidence, others, most_steps=6)
    left = held_out(evidence, fitted)
    return float((left**2).mean())


def _fitted(explanation: Explanation, name: str) -> AxisEffect:
    return next(one for one in explanation.fit.effects if one.id == name)
