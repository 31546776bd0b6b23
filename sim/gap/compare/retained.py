"""Elements that the corrected model keeps in addition to its causes.

Re-tuned own parameters take part in every fit, and absorb errors of an imperfect formula; so may
effects that are too uncertain to be named. On another motion they can do harm, so each stays only
if unseen data require it.
"""

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from rotemina.sim.gap.baseline import is_own
from rotemina.sim.gap.compare.held_out_power import held_out_powers
from rotemina.sim.gap.compare.weights import weigh
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.explanations import MOST_STEPS, Explanation, explanation
from rotemina.sim.gap.fit import fit


def with_retained(evidence: Evidence, best: Explanation, *fuller: Explanation) -> Explanation:
    """Return the explanation with the same causes and the likeliest additional elements.

    The ``fuller`` ones have the causes of ``best`` and additional, unnamed elements.
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
