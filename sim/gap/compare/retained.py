"""What the corrected model holds beside its causes.

Re-tunings of the model's own parameters take part in every fit, and where a formula is not quite
right they bend to what it leaves; further effects that are not sure enough to be named may do so
as well. On another motion they are then worse than none: each stays only where unseen data ask for
it.
"""

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from rotemina.sim.gap.baseline import is_own
from rotemina.sim.gap.compare.score import held_out_powers
from rotemina.sim.gap.compare.weights import weigh
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.explanations import MOST_STEPS, Explanation, explanation
from rotemina.sim.gap.fit import fit


def with_retained(evidence: Evidence, best: Explanation, *fuller: Explanation) -> Explanation:
    """Return an explanation by the same causes with the likeliest of what it may hold beside them.

    ``fuller`` ones have the causes of ``best``, and hold more beside these that is named by none.
    """
    if not best.causes:
        return best
    tried = [other for one in (best, *fuller) for other in _with_fewer(evidence, one)]
    numbers = [len(one.fit.effects) for one in tried]
    weights = weigh(held_out_powers(evidence, [one.held_out for one in tried]), numbers)
    return tried[int(np.argmax(weights))]


def _with_fewer(evidence: Evidence, best: Explanation) -> Iterator[Explanation]:
    """Give an explanation, and it with fewer re-tunings of the model's own parameters."""
    yield best
    causes, held = best.causes, best.fit.effects
    own = [one for one in held if one not in causes and is_own(evidence, one)]
    others = [one for one in held if one not in causes and one not in own]
    for count in range(len(own)):
        for kept in combinations(own, count):
            fitted = fit(evidence, [*causes, *others, *kept], most_steps=MOST_STEPS)
            yield explanation(evidence, len(causes), fitted)
