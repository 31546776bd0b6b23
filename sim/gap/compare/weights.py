"""How likely each hypothesis is beside the others: pseudo-BMA+ of tempered held-out power.

::

    log w = −½ Σ_channel n_c log(max(MSE, 1) + 0.05) + k log ρ

with the mean square MSE over the power that no hypothesis takes below, the k effects that a
hypothesis holds, and ρ for each of them. It is averaged over draws of the weights of blocks
(Bayesian bootstrap), so that what rests on a few moments alone is not taken for sure: Yao, Vehtari,
Simpson, Gelman, Bayesian Analysis 13 (2018) 917-1007, section 3.4.
"""

from collections.abc import Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.compare.held_out_power import Power
from rotemina.sim.gap.limits import PRIOR_FACTOR_PER_EFFECT

SLACK = 0.05  # of the power that is left, by which hypotheses differ by chance
DRAWS = 400
_SEED = 0  # same evidence, same weights


def weigh(powers: Sequence[Power], effects: Sequence[int]) -> FloatArray:
    """Return the weights (hypotheses,), which sum to 1.

    Parameters
    ----------
    powers : sequence of Power
        One for each channel.
    effects : sequence of int
        How many effects each hypothesis holds.
    """
    rng = np.random.default_rng(_SEED)
    priors = np.log(PRIOR_FACTOR_PER_EFFECT) * np.asarray(effects, dtype=np.float64)
    drawn = np.zeros((DRAWS, len(priors))) + priors
    for one in powers:
        shares = rng.dirichlet(np.ones(len(one.rows)), DRAWS)
        mean = (shares @ one.squares.T) / (shares @ one.rows)[:, None]
        least = np.maximum(mean.min(axis=1, keepdims=True), 1.0)
        drawn -= 0.5 * one.counted * np.log(np.maximum(mean / least, 1.0) + SLACK)
    relative = np.exp(drawn - drawn.max(axis=1, keepdims=True))
    return np.asarray((relative / relative.sum(axis=1, keepdims=True)).mean(axis=0))
