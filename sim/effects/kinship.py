"""Properties of an effect for the rules that decide between effects: family and companions.

An effect without these properties is fitted and compared like any other.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum


class Family(StrEnum):
    """Family of effects that change a signal in a similar way, anywhere in the chain."""

    GAIN = "gain"
    CURVE = "curve"
    LIMIT = "limit"
    LOOP = "loop"
    CREEP = "creep"
    DRIFT = "drift"
    LATE = "late"
    LOST_MOTION = "lost motion"
    PERIOD = "period"
    RESONANCE = "resonance"


@dataclass(frozen=True, slots=True, kw_only=True)
class Kinship:
    """How an effect relates to others.

    Attributes
    ----------
    family : Family, optional
    prior : float
        How often it is met, beside others whose prior is 1.
    brings_along : mapping of Family to float
        What moves along with it on the same axis, with the share of the gap's power that this must
        close to be a cause of its own; 1: it never is.
    accompanied_by : Family, optional
        What comes with it by its nature, however little that closes beside it.
    imitated_by : frozenset of Family
        What a slow formulation of it may be taken for, as that bends to anything.
    narrow : frozenset of str
        Formulations that hardly hold beyond the swings that they were fitted to.
    """

    family: Family | None = None
    prior: float = 1.0
    brings_along: Mapping[Family, float] = field(default_factory=dict)
    accompanied_by: Family | None = None
    imitated_by: frozenset[Family] = frozenset()
    narrow: frozenset[str] = frozenset()
