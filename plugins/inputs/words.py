"""Texts about input devices."""

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from rotemina.app.language import get_axis_label, translate_message
from rotemina.app.motion.inputs import (
    DEGREES_OF_FREEDOM,
    InputDeviceView,
    InputDisplayState,
    OperatorAction,
    OperatorRole,
)
from rotemina.drivers.inputs import InputHub, InputIdentity
from rotemina.plugins.inputs import mark, tr
from rotemina.sim.messages import format_fixed

SET_UP_BANNER = mark("During set-up only stops are sent to the robot.")
ACTION_NAMES = {
    OperatorAction.STOP: mark("Stop"),
    OperatorAction.EMERGENCY_STOP: mark("Stop and lock"),
    OperatorAction.DEAD_MAN: mark("Dead-man"),
    OperatorAction.CLUTCH: mark("Clutch"),
    OperatorAction.FINE: mark("Fine"),
    OperatorAction.COARSE: mark("Coarse"),
    OperatorAction.STAGE: mark("Next mode"),
    OperatorAction.LAW: mark("Next law"),
    OperatorAction.STEP_PRESET: mark("Next preset"),
    OperatorAction.RECENTRE: mark("Re-centre"),
    OperatorAction.PENETRATION: mark("Penetration"),
    OperatorAction.TOOL: mark("Tool on/off"),
    OperatorAction.TAKE_OVER: mark("Take over"),
}
ACTION_TIPS = {
    OperatorAction.STOP: mark("Stop all axes; works from every device at any time"),
    OperatorAction.EMERGENCY_STOP: mark(
        "Stop all axes and lock; works from every device at any time"
    ),
    OperatorAction.DEAD_MAN: mark("The stick acts only while this is pressed"),
    OperatorAction.CLUTCH: mark("While this is pressed, the stick moves without the robot"),
    OperatorAction.FINE: mark("A tenth of the scale while this is pressed"),
    OperatorAction.COARSE: mark("Ten times the scale while this is pressed"),
    OperatorAction.STAGE: mark("Next control mode: micro, nano and so on"),
    OperatorAction.LAW: mark("Next scaling law"),
    OperatorAction.STEP_PRESET: mark("Next scale preset"),
    OperatorAction.RECENTRE: mark("Move the piezos back to mid-range"),
    OperatorAction.PENETRATION: mark("Start or stop the automatic penetration"),
    OperatorAction.TOOL: mark("Tool on or off"),
    OperatorAction.TAKE_OVER: mark("This seat takes over control"),
}
_DIRECTIONS = {
    "x": mark("to the right (+x)"),
    "y": mark("away from you (+y)"),
    "z": mark("upwards (+z)"),
}
_SEAT_NAMES = {OperatorRole.TRAINER: mark("trainer"), OperatorRole.TRAINEE: mark("trainee")}
# The source and the name of the on-screen pad.
_SCREEN_PAD = ("keys", mark("pad"))
_PAD_BUTTONS = (mark("clutch"), mark("fine"), mark("coarse"), mark("take_over"))
_HID_KEY_PATTERN = re.compile(r"hid:([0-9a-f]{4}):([0-9a-f]{4}):")


@dataclass(frozen=True, slots=True)
class DeviceEntry:
    """Entry of a device in the list.

    Attributes
    ----------
    key, name : str
    status : str
        Whether the device is in control, or why not, in a few words.
    problem : str or None
    """

    key: str
    name: str
    status: str
    problem: str | None = None


@dataclass(frozen=True, slots=True)
class InputProblem:
    """Problem of a device, of a source of devices or of the profile.

    ``remedy`` is a text to copy that solves the problem, such as a udev rule.
    """

    text: str
    remedy: str | None = None


def list_axis_targets(robot_axes: Collection[str]) -> tuple[str, ...]:
    """Return the targets that a device axis can move: x, y and z of the stick, and robot axes."""
    return (*DEGREES_OF_FREEDOM, *(axis for axis in robot_axes if axis not in DEGREES_OF_FREEDOM))


def format_target_name(target: str) -> str:
    """Return the name of a target on the screen."""
    name = get_axis_label(target)
    return tr("Stick {name}").format(name=name) if target in DEGREES_OF_FREEDOM else name


def format_control_name(control: str) -> str:
    """Return the name of a control on the screen. Buttons of the pad are named by their action."""
    return tr(control) if control in _PAD_BUTTONS else control


def format_device_name(identity: InputIdentity) -> str:
    """Return the name of a device on the screen. The name of the pad is translated."""
    is_pad = (identity.source, identity.name) == _SCREEN_PAD
    return tr(identity.name) if is_pad else identity.name


def describe_target(target: str) -> str:
    """Return what a target moves on the robot."""
    if target in DEGREES_OF_FREEDOM:
        axes = tr(" or ").join(get_axis_label(axis) for axis in DEGREES_OF_FREEDOM[target])
        return tr("Moves {axes}, depending on the control mode").format(axes=axes)
    return tr("Moves {target} directly in any mode").format(target=get_axis_label(target))


def describe_direction(target: str) -> str:
    """Return the direction in which a stick must be moved to increase a target."""
    if target in _DIRECTIONS:
        return tr(_DIRECTIONS[target])
    return tr("the direction of increasing {target}").format(target=get_axis_label(target))


def list_device_entries(view: InputDisplayState, hub: InputHub) -> tuple[DeviceEntry, ...]:
    """Return the entries of all connected devices, with those that cannot be opened last."""
    # The on-screen pad always exists, so the connected devices come before it.
    sorted_devices = sorted(
        view.devices, key=lambda device: device.device.identity.source == "keys"
    )
    usable = [_make_entry(device, view) for device in sorted_devices]
    open_keys = {entry.key for entry in usable}
    problems = hub.problems
    unusable = [
        DeviceEntry(device.key, device.name, tr("cannot be used"), problems[device.key])
        for device in hub.devices
        if device.key not in open_keys and device.key in problems
    ]
    return (*usable, *unusable)


def list_problems(view: InputDisplayState, hub: InputHub) -> tuple[InputProblem, ...]:
    """Return the problems of sources, devices and the profile."""
    names = {device.key: device.name for device in hub.devices}
    hub_problems = [
        InputProblem(
            problem if names.get(key, key) in problem else f"{names.get(key, key)}: {problem}",
            make_udev_rule(key) if "70-rotemina-inputs.rules" in problem else None,
        )
        for key, problem in hub.problems.items()
    ]
    return (*hub_problems, *(InputProblem(translate_message(problem)) for problem in view.problems))


def make_udev_rule(key: str) -> str | None:
    """Return the udev rule that permits a user to open a joystick on Linux.

    Return None if the key does not belong to a HID joystick.
    """
    match = _HID_KEY_PATTERN.match(key)
    if match is None:
        return None
    vendor, product = match.groups()
    return (
        f'KERNEL=="hidraw*", ATTRS{{idVendor}}=="{vendor}", ATTRS{{idProduct}}=="{product}", '
        'TAG+="uaccess"'
    )


def describe_control(view: InputDisplayState, problem_count: int) -> str:
    """Describe which devices are in control, and how many problems there are."""
    if view.is_mapping_open:
        return tr("Set-up: no device controls the robot.")
    problems_text = {0: "", 1: tr("One problem, see below.")}.get(
        problem_count, tr("{wrong} problems, see below.").format(wrong=problem_count)
    )
    return f"{_describe_controlling_devices(view)} {problems_text}".rstrip()


def _describe_controlling_devices(view: InputDisplayState) -> str:
    if not view.devices:
        return tr("No input device is connected.")
    driving_devices = [device for device in view.devices if device.is_driving]
    names = tr(" and ").join(
        format_device_name(device.device.identity) for device in driving_devices
    )
    has_two_seats = len({device.seat for device in view.devices if device.seat is not None}) > 1
    seat_text = f" ({_format_seat(view.driving_seat)})" if has_two_seats else ""
    return (
        tr("{names} may control the robot{seat}.").format(names=names, seat=seat_text)
        if names
        else tr("No device of the controlling seat is connected.")
    )


def format_controls(controls: Mapping[str, float | None]) -> str:
    """Return the names of controls, with the thresholds of axes.

    ``controls`` maps each control to its threshold, or to None for a button.
    """
    return ", ".join(
        format_control_name(control)
        if threshold is None
        else f"{format_control_name(control)} {'>' if threshold > 0 else '<'} "
        f"{format_fixed(100 * threshold, 0)} %"
        for control, threshold in controls.items()
    )


def _format_seat(seat: OperatorRole) -> str:
    return tr(_SEAT_NAMES[seat])


def _make_entry(device: InputDeviceView, view: InputDisplayState) -> DeviceEntry:
    identity = device.device.identity
    return DeviceEntry(
        identity.key, format_device_name(identity), _describe_status(device, view), device.problem
    )


def _describe_status(device: InputDeviceView, view: InputDisplayState) -> str:
    if device.problem is not None:
        return tr("cannot be used")
    if device.seat is None:
        return tr("not in the profile")
    if view.is_mapping_open:
        return tr("{seat}, being set up").format(seat=_format_seat(device.seat))
    if not device.is_driving:
        return (
            tr("trainee, watching")
            if device.seat is OperatorRole.TRAINEE
            else tr("trainer, may take over")
        )
    waiting_axes = [axis.control for axis in device.axes if axis.drives and axis.reason is not None]
    return (
        tr("{seat}, waiting for {waiting}").format(
            seat=_format_seat(device.seat), waiting=", ".join(waiting_axes)
        )
        if waiting_axes
        else tr("{seat}, in control").format(seat=_format_seat(device.seat))
    )
