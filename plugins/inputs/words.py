"""What screens say of input devices. Free of Qt."""

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from rotemina.app.display import label
from rotemina.app.motion.teleoperation.devices_view import DevicesView
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.mapping import DEGREES_OF_FREEDOM
from rotemina.app.motion.teleoperation.operator_desk import DeviceView
from rotemina.app.motion.teleoperation.profile import Seat
from rotemina.drivers.inputs.hub import InputHub

NOTHING_SENT = "Nothing is sent to the robot while you set up, but stops."
ACTIONS = {
    Action.STOP: "Stop",
    Action.EMERGENCY_STOP: "E-stop",
    Action.DEAD_MAN: "Dead-man",
    Action.CLUTCH: "Clutch",
    Action.FINE: "Fine",
    Action.COARSE: "Coarse",
    Action.STAGE: "Next mode",
    Action.LAW: "Next law",
    Action.STEP_PRESET: "Next preset",
    Action.RECENTRE: "Re-centre",
    Action.PENETRATION: "Penetration",
    Action.TOOL: "Tool on/off",
    Action.TAKE_OVER: "Take over",
}
ACTION_TIPS = {
    Action.STOP: "Stop all axes; works from every device, at any time",
    Action.EMERGENCY_STOP: "Stop all axes, and latch; works from every device, at any time",
    Action.DEAD_MAN: "The stick acts only while this is held",
    Action.CLUTCH: "The stick moves, and the robot does not, while this is held",
    Action.FINE: "A tenth of the scale while this is held",
    Action.COARSE: "Ten times the scale while this is held",
    Action.STAGE: "Micro, nano, and on to the next mode of steering",
    Action.LAW: "The next scaling law",
    Action.STEP_PRESET: "The next scale",
    Action.RECENTRE: "The piezos back to their middle",
    Action.PENETRATION: "Start the automatic penetration, or stop it",
    Action.TOOL: "Tool on or off",
    Action.TAKE_OVER: "Of two seats: this one drives now",
}
_WAYS = {"x": "to the right (+x)", "y": "away from you (+y)", "z": "upwards (+z)"}
_HID = re.compile(r"hid:([0-9a-f]{4}):([0-9a-f]{4}):")


@dataclass(frozen=True, slots=True)
class Entry:
    """One device in the list.

    Attributes
    ----------
    key, name : str
    standing : str
        Whether it drives, or why not, in a few words.
    problem : str or None
    """

    key: str
    name: str
    standing: str
    problem: str | None = None


@dataclass(frozen=True, slots=True)
class Trouble:
    """Something that is wrong with a source or a device, and what to type where that helps."""

    text: str
    remedy: str | None = None


def axis_targets(robot_axes: Collection[str]) -> tuple[str, ...]:
    """Return what an axis of a device may drive: x, y, z of the stick, other axes directly."""
    return (*DEGREES_OF_FREEDOM, *(axis for axis in robot_axes if axis not in DEGREES_OF_FREEDOM))


def target_name(target: str) -> str:
    """Return what an axis drives, as a row of the mapping is called."""
    name = label(target)
    return f"Stick {name}" if target in DEGREES_OF_FREEDOM else name


def target_tip(target: str) -> str:
    """Return what that means for the robot."""
    if target in DEGREES_OF_FREEDOM:
        axes = " or ".join(label(axis) for axis in DEGREES_OF_FREEDOM[target])
        return f"Moves {axes}, by the mode of steering"
    return f"Moves {label(target)} directly, whatever the mode"


def way_of(target: str) -> str:
    """Return which way a stick is to be moved for an axis to grow."""
    return _WAYS.get(target, f"the way in which {label(target)} is to grow")


def entries(view: DevicesView, hub: InputHub) -> tuple[Entry, ...]:
    """Return what is plugged in, those that cannot be opened last."""
    # The pad is always there: what was plugged in comes first.
    ordered = sorted(view.devices, key=lambda one: one.device.identity.source == "keys")
    there = [_entry(one, view) for one in ordered]
    open_keys = {one.key for one in there}
    problems = hub.problems
    closed = [
        Entry(one.key, one.name, "cannot be used", problems[one.key])
        for one in hub.devices
        if one.key not in open_keys and one.key in problems
    ]
    return (*there, *closed)


def troubles(view: DevicesView, hub: InputHub) -> tuple[Trouble, ...]:
    """Return what is wrong with sources, devices and the profile."""
    names = {one.key: one.name for one in hub.devices}
    found = [
        Trouble(
            problem if names.get(key, key) in problem else f"{names.get(key, key)}: {problem}",
            udev_rule(key) if "70-rotemina-inputs.rules" in problem else None,
        )
        for key, problem in hub.problems.items()
    ]
    return (*found, *(Trouble(problem) for problem in view.problems))


def udev_rule(key: str) -> str | None:
    """Return the line of the rule that lets a user open a joystick on Linux, by its key."""
    model = _HID.match(key)
    if model is None:
        return None
    vendor, product = model.groups()
    return (
        f'KERNEL=="hidraw*", ATTRS{{idVendor}}=="{vendor}", ATTRS{{idProduct}}=="{product}", '
        'TAG+="uaccess"'
    )


def headline(view: DevicesView, wrong: int) -> str:
    """Return who drives, and how much is ``wrong``."""
    if view.setting_up:
        return "Being set up: nothing drives."
    problems = {0: "", 1: "One problem, see below."}.get(wrong, f"{wrong} problems, see below.")
    return f"{_drivers(view)} {problems}".rstrip()


def _drivers(view: DevicesView) -> str:
    if not view.devices:
        return "No input device is plugged in."
    driving = [one for one in view.devices if one.drives]
    names = " and ".join(one.device.identity.name for one in driving)
    two = len({one.seat for one in view.devices if one.seat is not None}) > 1
    seat = f" ({view.driving})" if two else ""
    return f"{names} may drive{seat}." if names else "No device of the driving seat is there."


def control_text(controls: Mapping[str, float | None]) -> str:
    """Return controls as a row of the mapping shows them, with thresholds of axes."""
    return ", ".join(
        control if at is None else f"{control} {'>' if at > 0 else '<'} {100 * at:.0f} %"
        for control, at in controls.items()
    )


def _entry(one: DeviceView, view: DevicesView) -> Entry:
    identity = one.device.identity
    return Entry(identity.key, identity.name, _standing(one, view), one.problem)


def _standing(one: DeviceView, view: DevicesView) -> str:
    if one.problem is not None:
        return "cannot be used"
    if one.seat is None:
        return "not in the profile"
    if view.setting_up:
        return f"{one.seat}, being set up"
    if not one.drives:
        return "trainee, looks on" if one.seat is Seat.TRAINEE else "trainer, may take over"
    waiting = [axis.control for axis in one.axes if axis.drives and axis.reason is not None]
    return f"{one.seat}, waits for {', '.join(waiting)}" if waiting else f"{one.seat}, drives"
