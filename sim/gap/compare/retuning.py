"""Re-tuning of the model's own parameters alone, from several starting resonances."""

from dataclasses import replace

import numpy as np

from rotemina.sim.gap.compare.explanations import Explanation, explanation
from rotemina.sim.gap.fit import Evidence, baseline, fit
from rotemina.sim.gap.limits import MIN_DOMINANT_SHARE_OF_REMAINDER
from rotemina.sim.robot import AxisEffect

_STEPS = 30  # a resonance that is far off is not found sooner
_OFF = np.arange(-0.28, 0.281, 0.04)  # of its frequency: closer than a peak is wide


def retuned(evidence: Evidence) -> Explanation:
    """Return the explanation by the model's own parameters alone.

    A fit finds a ring of another frequency only from a start near that frequency; from farther away
    it only broadens the resonance.
    """
    own = baseline(evidence)
    near = fit(evidence, own, most_steps=_STEPS)
    if any("frequency_error" in one.parameters for one in own):
        begun = min(
            (_off(own, float(share)) for share in _OFF), key=lambda one: _left(evidence, one)
        )
        if _left(evidence, begun) < _left(evidence, own):
            far = fit(evidence, begun, most_steps=_STEPS)
            near = far if far.cost < MIN_DOMINANT_SHARE_OF_REMAINDER * near.cost else near
    return explanation(evidence, 0, near)


def _off(own: tuple[AxisEffect, ...], share: float) -> tuple[AxisEffect, ...]:
    return tuple(
        replace(one, parameters={**one.parameters, "frequency_error": share})
        if "frequency_error" in one.parameters
        else one
        for one in own
    )


def _left(evidence: Evidence, effects: tuple[AxisEffect, ...]) -> float:
    return float(np.mean(evidence.residual(effects) ** 2))
