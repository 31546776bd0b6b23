"""The state of the input devices, for displays."""

from dataclasses import dataclass
from math import inf

from rotemina.app.motion.teleoperation.input_arbiter import DeviceView
from rotemina.app.motion.teleoperation.profile import OperatorRole, Profile


@dataclass(frozen=True, slots=True)
class DevicesView:
    """All input devices for the screen, as they were at one step.

    Attributes
    ----------
    host_time_s : float
        Of the step; −inf before the first.
    devices : tuple of DeviceView
        Those that are open.
    driving : OperatorRole
    setting_up : bool
        Whether nothing is sent but stops.
    profile : Profile or None
    problems : tuple of str
        What is wrong with the profile, and with devices as it uses them.
    """

    host_time_s: float = -inf
    devices: tuple[DeviceView, ...] = ()
    driving: OperatorRole = OperatorRole.TRAINER
    setting_up: bool = False
    profile: Profile | None = None
    problems: tuple[str, ...] = ()
