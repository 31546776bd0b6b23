"""The automatic profile of a device without one, from the names of its controls."""

from collections.abc import Sequence

from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    Profile,
    ProfileError,
)
from rotemina.app.motion.teleoperation.profile_check import DEGREES_OF_FREEDOM, PluggedDevice
from rotemina.sim.messages import message

#: What may be the third axis, best first: a twist or the second stick of a gamepad comes back to
#: its centre, as a slider or a trigger does not.
_THIRD = ("rz", "z", "ry", "rx", "twist", "rudder")
_NEVER_CENTRED = ("slider", "dial", "wheel", "throttle", "accelerator", "brake", "clutch", "hat")

#: Of a stick: the first button is under the finger that holds it.
_MANY_BUTTONS = (
    Action.DEAD_MAN,
    Action.STOP,
    Action.STAGE,
    Action.FINE,
    Action.COARSE,
    Action.CLUTCH,
    Action.LAW,
    Action.STEP_PRESET,
    Action.RECENTRE,
    Action.PENETRATION,
    Action.TOOL,
    Action.TAKE_OVER,
)
#: Of a device with few: the paper's start/stop button, and its mode button.
_FEW_BUTTONS = (Action.PENETRATION, Action.STAGE)
_SAID_BY_NAME = {
    "penetration": Action.PENETRATION,
    "mode": Action.STAGE,
    "stage": Action.STAGE,
    "emergency": Action.EMERGENCY_STOP,
    "dead": Action.DEAD_MAN,
    "take over": Action.TAKE_OVER,
    "preset": Action.STEP_PRESET,
    "recentre": Action.RECENTRE,
}


def default_profile(device: PluggedDevice) -> Profile:
    """Return a profile that drives x, y and z by the device's likeliest axes.

    Buttons whose names say what they are for do that; numbered ones are given out in the order of
    their use, the first to the dead-man if there are more than two.

    Raises
    ------
    ProfileError
        If the device has no control at all.
    """
    if not device.axes and not device.buttons:
        raise ProfileError(
            message("engine", "{device} has neither axes nor buttons to map").fill(
                device=str(device)
            )
        )
    sticks = _sticks(device.axes)
    axes = tuple(
        AxisMapping(control=control, drives=drives, inverted=_inverted(device, drives))
        for drives, control in zip(DEGREES_OF_FREEDOM, sticks, strict=False)
    )
    mapping = DeviceMapping(key=device.identity.key, axes=axes, actions=_actions(device.buttons))
    return Profile(name="Default", devices=(mapping,))


def _sticks(axes: Sequence[str]) -> list[str]:
    """Return up to three axes, those that are x, y and z first."""
    by_name = {axis.casefold(): axis for axis in reversed(axes)}
    chosen = [by_name[name] for name in ("x", "y") if name in by_name]
    if len(chosen) == 2:
        chosen += [by_name[name] for name in _THIRD if name in by_name][:1]
    usable = [axis for axis in axes if not axis.casefold().startswith(_NEVER_CENTRED)]
    return (chosen + [axis for axis in usable if axis not in chosen])[: len(DEGREES_OF_FREEDOM)]


def _inverted(device: PluggedDevice, drives: str) -> bool:
    """Whether it counts towards the operator, and clockwise seen from above, as HID sticks do.

    Away is along y, and a screw that is turned clockwise goes down.
    """
    return device.identity.source == "hid" and drives != "x"


def _actions(buttons: Sequence[str]) -> tuple[ActionMapping, ...]:
    named = {button: _named(button) for button in buttons}
    told = {button: action for button, action in named.items() if action is not None}
    if not told:
        order = _MANY_BUTTONS if len(buttons) > len(_FEW_BUTTONS) else _FEW_BUTTONS
        told = dict(zip(buttons, order, strict=False))
    return tuple(ActionMapping(control=button, action=action) for button, action in told.items())


def _named(button: str) -> Action | None:
    """Return the action that a button's name is, or contains."""
    name = button.casefold().replace("_", " ").replace("-", " ")
    for action in Action:
        if name == action.value.replace("_", " "):
            return action
    return next((action for word, action in _SAID_BY_NAME.items() if word in name), None)
