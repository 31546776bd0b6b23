"""An operator's intent at one instant, by stick, key or pad: deflections and actions."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType


class Action(StrEnum):
    """What a button can be mapped to."""

    STOP = "stop"
    EMERGENCY_STOP = "emergency_stop"
    STAGE = "stage"  # micro ↔ nano, and on to the next mode
    LAW = "law"  # the next scaling law
    CLUTCH = "clutch"  # held: the stick moves, the robot does not
    DEAD_MAN = "dead_man"  # must be held for the stick to act
    FINE = "fine"  # held: a tenth
    COARSE = "coarse"  # held: ten times
    STEP_PRESET = "step_preset"  # the next scale
    RECENTRE = "recentre"
    PENETRATION = "penetration"  # start or stop
    TOOL = "tool"  # inject: on or off
    TAKE_OVER = "take_over"  # of two devices: this one drives now


@dataclass(frozen=True, slots=True)
class Intent:
    """The present request of the operator's devices.

    Attributes
    ----------
    host_time_s : float
        When the newest reading that is in it came in.
    deflections : mapping of str to float
        Of each degree of freedom that is mapped (``x``, ``y``, ``z`` of the stick, or the name of
        a robot's axis), −1 to 1: calibrated, dead zone and response curve applied. Missing: not
        trusted, or not mapped; it must then not move.
    pressed : frozenset of Action
        Actions whose button went down since the intent before.
    held : frozenset of Action
        Actions whose button is held now.
    device : str
        Key of the device that drives.
    lost : str or None
        Why the device that drove does so no more: unplugged, taken over. It means stop.
    """

    host_time_s: float
    deflections: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    pressed: frozenset[Action] = frozenset()
    held: frozenset[Action] = frozenset()
    device: str = ""
    lost: str | None = None
