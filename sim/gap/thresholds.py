"""The levels on which a diagnosis decides.

They mean the same wherever they occur: how much of a gap is something, how near two scores are, how
far above the noise floor a remainder tells anything. A number of a single step, or one that only
steers a computation, stands with it.
"""

# Shares, of a gap's power that closes or is left, or of a weight or a probability.
NEXT_TO_NOTHING = 0.01
SMALL = 0.03  # the least that a cause closes
SIGNIFICANCE = 0.05  # p-value, up to which a cause is more than a part of the remainder
REMAINDER = 0.09  # of a gap's power at most, that real machines do beyond every catalogue
SOME = 0.3  # worth a name, or worth going on
HALF = 0.5
MUCH = 0.7  # closed: more than what bends to anything closes; left: another is much better
CLEARLY = 0.8  # of the rest, closed: it counts whatever its size
NEARLY_ALL = 0.9
EXPLAINED = 0.95  # closed, so that what is left is not worth a word

# Ratios of two scores: mean squares that explanations leave of data that no fit saw.
SAME_SCORE = 1.05  # they differ by chance
TIED = 1.5  # they do as well, as no formula is quite right
NARROW = 1.3  # so much more is left elsewhere by what fits only the swings that it saw
VOUCHES = 1.25  # a black box that leaves more knows too little to compare with
DISTINCT = 2.5  # one is clearly more than the other
NEAR = 4.0  # the worse one is not hopeless
HOPELESS = 10.0

# Mean squares over the noise floor.
LEAST_POWER = 0.2  # that a cause closes
ADEQUATE = 1.3  # what is left may be all noise
GAP = 1.5  # there is something to explain
NOTICED = 2.0  # what is left may have a cause, and a formula is not quite right
SEEN = 9.0  # an effect counts whatever its share
FAR_OFF = 25.0  # no formula is near

# How likely a hypothesis is before any record, beside another.
EFFECT = 0.07  # for each effect that it holds
SIMPLER = 6.0  # for each parameter less, on a tie
ANOTHER_MACHINE = 0.02  # with an own parameter of the model at a bound
POSSIBLE = 0.15  # of the likeliest one's probability, from which a rival is not ruled out
MOST_RIVALS = 4  # from which a set tells nothing
