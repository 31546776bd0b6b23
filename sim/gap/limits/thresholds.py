"""Thresholds for the decisions of a diagnosis.

A threshold has the same meaning wherever it is used. A number that only one step uses, or that only
controls a computation, is defined in the module of that step.
"""

# Fractions of the power of a gap, of a weight or of a probability.
NEGLIGIBLE_SHARE = 0.01
# A cause must close at least this share of the gap.
MIN_CAUSE_SHARE = 0.03
# With at most this p-value, a cause is not just part of the remainder.
MAX_P_VALUE = 0.05
# On real machines, up to this share of the power of a gap comes from effects in no catalogue.
MAX_UNMODELLED_SHARE = 0.09
# At least this share must be closed to name a cause, or to continue the search.
MIN_SHARE_TO_NAME = 0.3
MIN_MAJORITY_SHARE = 0.5
# As a closed share: more than an arbitrary flexible model can close. As a ratio of two remainders:
# below it, the explanation with the smaller remainder is much better.
LARGE_SHARE = 0.7
# A cause that closes this share of the remainder counts, however small it is.
MIN_DOMINANT_SHARE_OF_REMAINDER = 0.8
MIN_ALMOST_COMPLETE_SHARE = 0.9
# If at least this share is closed, the remainder needs no further cause.
MIN_EXPLAINED_SHARE = 0.95

# Ratios of two scores. A score is the mean square of the gap that an explanation leaves on held-out
# data.
# Up to this ratio, two scores differ by chance.
MAX_CHANCE_SCORE_RATIO = 1.05
# Up to this ratio, two explanations are equally good, because no formula is exact.
MAX_TIED_SCORE_RATIO = 1.5
# An explanation fitted to a narrow range of swings may leave this many times more on other motions.
NARROW_FIT_SCORE_FACTOR = 1.3
# A black-box model that leaves more than this many times the remainder is not a benchmark.
MAX_BLACK_BOX_SCORE_RATIO = 1.25
# If the ratio is at least this, one of the two is clearly larger.
MIN_DISTINCT_RATIO = 2.5
# Up to this ratio, the worse explanation is kept in the search.
MAX_NEAR_SCORE_RATIO = 4.0
HOPELESS_SCORE_RATIO = 10.0

# Mean squares in units of the noise floor squared.
# A cause must close at least this power.
MIN_CAUSE_POWER = 0.2
# A remainder up to this power may be noise alone.
MAX_NOISE_POWER = 1.3
# A gap with at least this power needs an explanation.
MIN_GAP_POWER = 1.5
# A remainder with at least this power may have a cause, or a formula may not be exact.
MIN_NOTICEABLE_POWER = 2.0
# An effect with at least this power counts, however small its share is.
MIN_OBVIOUS_POWER = 9.0
# With at least this power, no formula is close.
FAR_OFF_POWER = 25.0

# Prior odds of hypotheses.
# Factor for each effect that a hypothesis contains.
PRIOR_FACTOR_PER_EFFECT = 0.07
# Factor for each parameter that one of two equally good explanations does without.
PRIOR_FACTOR_PER_PARAMETER = 6.0
# Factor for a parameter of the original model that ends at a bound.
PRIOR_FACTOR_AT_BOUND = 0.02
# A rival is not ruled out if its probability has at least this ratio to the largest one.
MIN_RIVAL_PROBABILITY_RATIO = 0.15
# A set of this many rivals is too ambiguous to name a cause.
MAX_AMBIGUOUS_RIVALS = 4
