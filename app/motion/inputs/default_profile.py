"""Automatic profile of a device without a profile, made from the names of its controls."""

from collections.abc import Sequence

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs.intent import OperatorAction
from rotemina.app.motion.inputs.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    InputProfile,
)
from rotemina.app.motion.inputs.profile_check import DEGREES_OF_FREEDOM, PluggedDevice

# Names of possible third axes, the most suitable first. The twist of a stick or the second stick of
# a gamepad returns to its centre, unlike a slider or a trigger.
_THIRD_AXIS_NAMES = ("rz", "z", "ry", "rx", "twist", "rudder")
_UNCENTRED_NAME_PREFIXES = (
    "slider",
    "dial",
    "wheel",
    "throttle",
    "accelerator",
    "brake",
    "clutch",
    "hat",
)

#: Actions of a device with many buttons. The first one is usually under the operator's finger.
_MANY_BUTTON_ACTIONS = (
    OperatorAction.DEAD_MAN,
    OperatorAction.STOP,
    OperatorAction.STAGE,
    OperatorAction.FINE,
    OperatorAction.COARSE,
    OperatorAction.CLUTCH,
    OperatorAction.LAW,
    OperatorAction.STEP_PRESET,
    OperatorAction.RECENTRE,
    OperatorAction.PENETRATION,
    OperatorAction.TOOL,
    OperatorAction.TAKE_OVER,
)
#: Actions of a device with few buttons: the start/stop button and the mode button of the paper.
_FEW_BUTTON_ACTIONS = (OperatorAction.PENETRATION, OperatorAction.STAGE)
_ACTION_BY_WORD = {
    "penetration": OperatorAction.PENETRATION,
    "mode": OperatorAction.STAGE,
    "stage": OperatorAction.STAGE,
    "emergency": OperatorAction.EMERGENCY_STOP,
    "dead": OperatorAction.DEAD_MAN,
    "take over": OperatorAction.TAKE_OVER,
    "preset": OperatorAction.STEP_PRESET,
    "recentre": OperatorAction.RECENTRE,
}


def make_default_profile(device: PluggedDevice) -> InputProfile:
    """Return a profile in which the most suitable axes of a device drive x, y and z.

    A button that is named after an action gets this action. If no button is, the buttons get the
    most important actions in order, beginning with the dead-man if there are more than two.

    Raises
    ------
    InputProfileError
        If the device has no controls.
    """
    if not device.axes and not device.buttons:
        raise InputProfileError("{device} has neither axes nor buttons to map", device=str(device))
    stick_axes = _choose_axes(device.axes)
    axes = tuple(
        AxisMapping(control=control, drives=drives, inverted=_is_inverted(device, drives))
        for drives, control in zip(DEGREES_OF_FREEDOM, stick_axes, strict=False)
    )
    mapping = DeviceMapping(
        key=device.identity.key, axes=axes, actions=_map_buttons(device.buttons)
    )
    return InputProfile(name="Default", devices=(mapping,))


def _choose_axes(axes: Sequence[str]) -> list[str]:
    by_name = {axis.casefold(): axis for axis in reversed(axes)}
    chosen_axes = [by_name[name] for name in ("x", "y") if name in by_name]
    if len(chosen_axes) == 2:
        chosen_axes += [by_name[name] for name in _THIRD_AXIS_NAMES if name in by_name][:1]
    centred_axes = [
        axis for axis in axes if not axis.casefold().startswith(_UNCENTRED_NAME_PREFIXES)
    ]
    return (chosen_axes + [axis for axis in centred_axes if axis not in chosen_axes])[
        : len(DEGREES_OF_FREEDOM)
    ]


def _is_inverted(device: PluggedDevice, drives: str) -> bool:
    """Return whether an axis must be inverted, as y and z of HID sticks.

    HID sticks count positive towards the operator, and clockwise seen from above. The robot's y
    points away from the operator. A clockwise twist should move down, like a screw.
    """
    return device.identity.source == "hid" and drives != "x"


def _map_buttons(buttons: Sequence[str]) -> tuple[ActionMapping, ...]:
    action_by_button = {button: _find_action(button) for button in buttons}
    actions = {button: action for button, action in action_by_button.items() if action is not None}
    if not actions:
        default_actions = (
            _MANY_BUTTON_ACTIONS if len(buttons) > len(_FEW_BUTTON_ACTIONS) else _FEW_BUTTON_ACTIONS
        )
        actions = dict(zip(buttons, default_actions, strict=False))
    return tuple(ActionMapping(control=button, action=action) for button, action in actions.items())


def _find_action(button: str) -> OperatorAction | None:
    name = button.casefold().replace("_", " ").replace("-", " ")
    for action in OperatorAction:
        if name == action.value.replace("_", " "):
            return action
    return next((action for word, action in _ACTION_BY_WORD.items() if word in name), None)
