"""Text about input devices."""

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from rotemina.app.display_units import label
from rotemina.app.motion.teleoperation.input_arbiter import DevicesView, DeviceView
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import OperatorRole
from rotemina.app.motion.teleoperation.profile_check import DEGREES_OF_FREEDOM
from rotemina.app.shell.engine_words import spoken
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.drivers.inputs.hub import InputHub
from rotemina.plugins.inputs import mark, tr
from rotemina.sim.quantities import fixed

NOTHING_SENT = mark("During set-up only stops are sent to the robot.")
ACTIONS = {
    Action.STOP: mark("Stop"),
    Action.EMERGENCY_STOP: mark("Stop and lock"),
    Action.DEAD_MAN: mark("Dead-man"),
    Action.CLUTCH: mark("Clutch"),
    Action.FINE: mark("Fine"),
    Action.COARSE: mark("Coarse"),
    Action.STAGE: mark("Next mode"),
    Action.LAW: mark("Next law"),
    Action.STEP_PRESET: mark("Next preset"),
    Action.RECENTRE: mark("Re-centre"),
    Action.PENETRATION: mark("Penetration"),
    Action.TOOL: mark("Tool on/off"),
    Action.TAKE_OVER: mark("Take over"),
}
ACTION_TIPS = {
    Action.STOP: mark("Stop all axes; works from every device at any time"),
    Action.EMERGENCY_STOP: mark("Stop all axes and lock; works from every device at any time"),
    Action.DEAD_MAN: mark("The stick acts only while this is pressed"),
    Action.CLUTCH: mark("While this is pressed, the stick moves without the robot"),
    Action.FINE: mark("A tenth of the scale while this is pressed"),
    Action.COARSE: mark("Ten times the scale while this is pressed"),
    Action.STAGE: mark("Next control mode: micro, nano and so on"),
    Action.LAW: mark("Next scaling law"),
    Action.STEP_PRESET: mark("Next scale preset"),
    Action.RECENTRE: mark("Move the piezos back to mid-range"),
    Action.PENETRATION: mark("Start or stop the automatic penetration"),
    Action.TOOL: mark("Tool on or off"),
    Action.TAKE_OVER: mark("This seat takes over control"),
}
_WAYS = {"x": mark("to the right (+x)"), "y": mark("away from you (+y)"), "z": mark("upwards (+z)")}
_SEATS = {OperatorRole.TRAINER: mark("trainer"), OperatorRole.TRAINEE: mark("trainee")}
#: What the pad on the screen and its buttons are called.
_PAD = ("keys", mark("pad"))  # source and name
_PAD_BUTTONS = (mark("clutch"), mark("fine"), mark("coarse"), mark("take_over"))
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
    return tr("Stick {name}").format(name=name) if target in DEGREES_OF_FREEDOM else name


def control_name(control: str) -> str:
    """Return what a control is called on the screen: the pad's buttons by what they do."""
    return tr(control) if control in _PAD_BUTTONS else control


def device_name(identity: InputIdentity) -> str:
    """Return how an operator calls a device: the pad on the screen by what it is."""
    pad = (identity.source, identity.name) == _PAD
    return tr(identity.name) if pad else identity.name


def target_tip(target: str) -> str:
    """Return what that means for the robot."""
    if target in DEGREES_OF_FREEDOM:
        axes = tr(" or ").join(label(axis) for axis in DEGREES_OF_FREEDOM[target])
        return tr("Moves {axes}, depending on the control mode").format(axes=axes)
    return tr("Moves {target} directly in any mode").format(target=label(target))


def way_of(target: str) -> str:
    """Return which way a stick is to be moved for an axis to grow."""
    if target in _WAYS:
        return tr(_WAYS[target])
    return tr("the direction of increasing {target}").format(target=label(target))


def entries(view: DevicesView, hub: InputHub) -> tuple[Entry, ...]:
    """Return what is plugged in, those that cannot be opened last."""
    # The pad is always there: what was plugged in comes first.
    ordered = sorted(view.devices, key=lambda one: one.device.identity.source == "keys")
    there = [_entry(one, view) for one in ordered]
    open_keys = {one.key for one in there}
    problems = hub.problems
    closed = [
        Entry(one.key, one.name, tr("cannot be used"), problems[one.key])
        for one in hub.devices
        if one.key not in open_keys and one.key in problems
    ]
    return (*there, *closed)


def troubles(view: DevicesView, hub: InputHub) -> tuple[Trouble, ...]:
    """Return the problems of sources, devices and the profile."""
    names = {one.key: one.name for one in hub.devices}
    found = [
        Trouble(
            problem if names.get(key, key) in problem else f"{names.get(key, key)}: {problem}",
            udev_rule(key) if "70-rotemina-inputs.rules" in problem else None,
        )
        for key, problem in hub.problems.items()
    ]
    return (*found, *(Trouble(spoken(problem)) for problem in view.problems))


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
        return tr("Set-up: no device controls the robot.")
    problems = {0: "", 1: tr("One problem, see below.")}.get(
        wrong, tr("{wrong} problems, see below.").format(wrong=wrong)
    )
    return f"{_drivers(view)} {problems}".rstrip()


def _drivers(view: DevicesView) -> str:
    if not view.devices:
        return tr("No input device is connected.")
    driving = [one for one in view.devices if one.drives]
    names = tr(" and ").join(device_name(one.device.identity) for one in driving)
    two = len({one.seat for one in view.devices if one.seat is not None}) > 1
    seat = f" ({_seat(view.driving)})" if two else ""
    return (
        tr("{names} may control the robot{seat}.").format(names=names, seat=seat)
        if names
        else tr("No device of the controlling seat is connected.")
    )


def control_text(controls: Mapping[str, float | None]) -> str:
    """Return controls as a row of the mapping shows them, with thresholds of axes."""
    return ", ".join(
        name if at is None else f"{name} {'>' if at > 0 else '<'} {fixed(100 * at, 0)} %"
        for name, at in ((control_name(control), at) for control, at in controls.items())
    )


def _seat(seat: OperatorRole) -> str:
    return tr(_SEATS[seat])


def _entry(one: DeviceView, view: DevicesView) -> Entry:
    identity = one.device.identity
    return Entry(identity.key, device_name(identity), _standing(one, view), one.problem)


def _standing(one: DeviceView, view: DevicesView) -> str:
    if one.problem is not None:
        return tr("cannot be used")
    if one.seat is None:
        return tr("not in the profile")
    if view.setting_up:
        return tr("{seat}, being set up").format(seat=_seat(one.seat))
    if not one.drives:
        return (
            tr("trainee, watching")
            if one.seat is OperatorRole.TRAINEE
            else tr("trainer, may take over")
        )
    waiting = [axis.control for axis in one.axes if axis.drives and axis.reason is not None]
    return (
        tr("{seat}, waiting for {waiting}").format(seat=_seat(one.seat), waiting=", ".join(waiting))
        if waiting
        else tr("{seat}, in control").format(seat=_seat(one.seat))
    )
