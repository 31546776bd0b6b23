"""Which re-tunings of the model's own parameters the corrected model keeps beside its causes.

They take part in every fit, and where a formula is not quite right they bend to what it leaves. On
another motion such a re-tuning is worse than none: each stays only where unseen data ask for it.
"""

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from rotemina.sim.gap.baseline import is_own
from rotemina.sim.gap.compare.score import held_out_powers
from rotemina.sim.gap.compare.weights import weigh
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import fit
from rotemina.sim.gap.models import MOST_STEPS, Explanation, explanation
from rotemina.sim.robot.model import AxisEffect


def with_retained(evidence: Evidence, best: Explanation) -> Explanation:
    """Return an explanation by the same causes with the likeliest of its re-tunings."""
    causes = best.causes
    named = {one.id for one in causes}
    own = [one for one in best.fit.effects if one.id not in named and is_own(evidence, one)]
    others = [one for one in best.fit.effects if one not in own and one not in causes]
    if not causes or not own:
        return best
    tried = [best]
    numbers = [len(own)]
    for kept in _fewer(own):
        fitted = fit(evidence, [*causes, *others, *kept], most_steps=MOST_STEPS)
        tried.append(explanation(evidence, len(causes), fitted))
        numbers.append(len(kept))
    weights = weigh(held_out_powers(evidence, [one.held_out for one in tried]), numbers)
    return tried[int(np.argmax(weights))]


def _fewer(own: Sequence[AxisEffect]) -> list[tuple[AxisEffect, ...]]:
    return [kept for count in range(len(own)) for kept in combinations(own, count)]
