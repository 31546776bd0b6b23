"""Relations of an effect to others, for the rules that decide between effects.

An effect without these relations is fitted and compared like any other.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING

from rotemina.sim.compatibility import serve_former_names


class EffectFamily(StrEnum):
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
class EffectRelations:
    """Relations of an effect to other effects.

    Attributes
    ----------
    family : EffectFamily, optional
    prior : float
        How often the effect occurs, relative to effects whose prior is 1.
    brings_along : mapping of EffectFamily to float
        Families whose effects usually appear with this one on the same axis. The number is the
        share of the gap's power that such an effect must close to count as a separate cause; with 1
        it never does.
    accompanied_by : EffectFamily, optional
        A family that always appears with this effect, even if it closes very little of the gap.
    imitated_by : frozenset of EffectFamily
        Families that can imitate a slow formulation of this effect, because their curves fit
        almost any shape.
    narrow : frozenset of str
        Formulations that are hardly valid beyond the amplitudes to which they were fitted.
    """

    family: EffectFamily | None = None
    prior: float = 1.0
    brings_along: Mapping[EffectFamily, float] = field(default_factory=dict)
    accompanied_by: EffectFamily | None = None
    imitated_by: frozenset[EffectFamily] = frozenset()
    narrow: frozenset[str] = frozenset()


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Family="EffectFamily",
        Kinship="EffectRelations",
    )
