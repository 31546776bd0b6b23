"""The operator's intent at one instant, from all input devices: deflections and actions."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType


class OperatorAction(StrEnum):
    """Action that a button can be mapped to."""

    STOP = "stop"
    EMERGENCY_STOP = "emergency_stop"
    # Switches to the next mode: micro, nano, …
    STAGE = "stage"
    # Switches to the next scaling law.
    LAW = "law"
    # While it is held, the stick moves without the robot.
    CLUTCH = "clutch"
    # Must be held for the stick to act.
    DEAD_MAN = "dead_man"
    # While it is held, the scale is a tenth.
    FINE = "fine"
    # While it is held, the scale is ten times as large.
    COARSE = "coarse"
    # Switches to the next step preset of the scale.
    STEP_PRESET = "step_preset"
    RECENTRE = "recentre"
    # Starts or stops the penetration.
    PENETRATION = "penetration"
    # Switches the injection tool on or off.
    TOOL = "tool"
    # The operator of this device drives from now on.
    TAKE_OVER = "take_over"


@dataclass(frozen=True, slots=True)
class Intent:
    """Current request of the operator, from all input devices.

    Attributes
    ----------
    host_time_s : float
        Host time of the newest reading.
    deflections : mapping of str to float
        Deflections, −1 to 1, by degree of freedom (``x``, ``y``, ``z`` of the stick, or the name of
        a robot axis), after calibration, dead zone and response curve. A missing degree of freedom
        is not mapped or not trusted, and must not move.
    pressed : frozenset of OperatorAction
        Actions whose button was pressed since the previous intent.
    held : frozenset of OperatorAction
        Actions whose button is held now.
    device : str
        Key of the device that drives.
    loss_reason : str or None
        Why the driving device has lost control, for example because it was unplugged. The machine
        must then stop.
    """

    host_time_s: float
    deflections: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    pressed: frozenset[OperatorAction] = frozenset()
    held: frozenset[OperatorAction] = frozenset()
    device: str = ""
    loss_reason: str | None = None
