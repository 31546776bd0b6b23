"""What the gains of a loop are searched for, and what they must keep."""

from dataclasses import dataclass
from enum import StrEnum

from rotemina.sim.feedback.stability import PEAK_SENSITIVITY


class SecondObjective(StrEnum):
    """The second objective, beside the tracking error."""

    SETTLING = "settling"
    EFFORT = "effort"


@dataclass(frozen=True, slots=True, kw_only=True)
class Constraints:
    """What no point of a front may exceed; ``limited`` samples are never allowed.

    Attributes
    ----------
    peak_sensitivity : float
    overshoot : float
        Share of the step.
    """

    peak_sensitivity: float = PEAK_SENSITIVITY
    overshoot: float = 0.02
