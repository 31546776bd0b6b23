"""Checks that a profile fits the robot's axes, the connected devices and their controls."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from types import MappingProxyType

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    InputProfile,
    OperatorRole,
)
from rotemina.drivers.inputs import InputIdentity
from rotemina.sim.messages import (
    FieldList,
    join_messages,
    marked,
    message,
)

#: Degrees of freedom of the stick, and the robot's axes that each can move, depending on the mode.
#: The tilt thy moves the tip of a pin along x, and the tilt thx along y.
DEGREES_OF_FREEDOM: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"x": ("x", "thy"), "y": ("y", "thx"), "z": ("z", "zn")}
)


@dataclass(frozen=True, slots=True)
class PluggedDevice:
    """Input device that is open.

    Attributes
    ----------
    identity : InputIdentity
    axes, buttons : tuple of str
        Names of the controls, in the order of the readings.
    streams : bool
        Whether the device reports continuously, so that silence means a fault.
    """

    identity: InputIdentity
    axes: tuple[str, ...]
    buttons: tuple[str, ...]
    streams: bool = False

    def __str__(self) -> str:
        return f"{self.identity.name} ({self.identity.key})"


def check_profile(profile: InputProfile, robot_axes: Collection[str]) -> None:
    """Refuse a profile that cannot be used with this robot, whatever devices are plugged in.

    Raises
    ------
    InputProfileError
        If the robot does not have a driven axis, two controls of one operator would drive the same
        axis, a control has two functions, or no device belongs to the trainer.
    """
    for seat in OperatorRole:
        owners: dict[str, AxisMapping] = {}
        seat_devices = (device for device in profile.devices if device.seat is seat)
        for mapping in (axis for device in seat_devices for axis in device.axes):
            for axis in _find_driven_axes(profile, mapping, robot_axes):
                previous_owner = owners.setdefault(axis, mapping)
                if previous_owner is not mapping:
                    raise InputProfileError(
                        "profile {name}: robot axis {axis} would have two owners, {owner} and "
                        "{other_owner}; let one of them drive something else",
                        name=repr(profile.name),
                        axis=axis,
                        owner=_describe_owner(profile, previous_owner),
                        other_owner=_describe_owner(profile, mapping),
                    )
    for device in profile.devices:
        _check_single_use(profile, device)
    if not any(device.seat is OperatorRole.TRAINER for device in profile.devices):
        raise InputProfileError(
            "profile {name}: every device has seat = 'trainee'; one must have 'trainer'",
            name=repr(profile.name),
        )


def assign_mappings(
    profile: InputProfile, devices: Iterable[PluggedDevice]
) -> Mapping[str, DeviceMapping]:
    """Return the mapping of each plugged device by key. Devices without a mapping do nothing.

    An exact key takes precedence over a pattern. If several devices match a pattern, the first one
    gets the mapping.
    """
    unassigned = [device.identity.key for device in devices]
    mappings: dict[str, DeviceMapping] = {}
    for mapping in sorted(profile.devices, key=lambda device: device.key not in unassigned):
        for key in unassigned:
            if key == mapping.key or fnmatchcase(key, mapping.key):
                mappings[key] = mapping
                unassigned.remove(key)
                break
    return mappings


def describe_missing_devices(
    profile: InputProfile, devices: Collection[PluggedDevice]
) -> str | None:
    """Return a message that names the missing devices of a profile, or None."""
    assigned = assign_mappings(profile, devices).values()
    missing_keys = [
        mapping.key
        for mapping in profile.devices
        if not any(mapping is other for other in assigned)
    ]
    if not missing_keys:
        return None
    plugged_names = join_messages(map(str, devices), ", ") or marked("engine", "nothing")
    return message(
        "engine",
        "profile {name} needs {gone}, which is not connected; connected: {present}."
        " Connect it, or choose or create another profile",
    ).fill(name=repr(profile.name), gone=FieldList(tuple(missing_keys)), present=plugged_names)


def check_controls(mapping: DeviceMapping, device: PluggedDevice) -> None:
    """Refuse a mapping that uses controls that a device does not have.

    Raises
    ------
    InputProfileError
        If a control is missing. The message names this control, the device and its controls.
    """
    for axis in mapping.axes:
        if axis.control not in device.axes:
            raise InputProfileError(
                _describe_unknown_control(axis.control, "axis", device.axes, device)
            )
    for action in mapping.actions:
        if action.at is not None and action.control not in device.axes:
            raise InputProfileError(
                _describe_unknown_control(action.control, "axis", device.axes, device)
            )
        if action.at is None and action.control not in device.buttons:
            problem = _describe_unknown_control(action.control, "button", device.buttons, device)
            if action.control in device.axes:
                problem = join_messages((problem, message("engine", "an axis needs at = …")), "; ")
            raise InputProfileError(problem)


def _describe_owner(profile: InputProfile, mapping: AxisMapping) -> str:
    key = next(
        device.key for device in profile.devices if any(mapping is axis for axis in device.axes)
    )
    return message("engine", "{control} of {key} (drives {drives})").fill(
        control=repr(mapping.control), key=key, drives=mapping.drives
    )


def _find_driven_axes(
    profile: InputProfile, mapping: AxisMapping, robot_axes: Collection[str]
) -> tuple[str, ...]:
    if mapping.drives in DEGREES_OF_FREEDOM:
        return DEGREES_OF_FREEDOM[mapping.drives]
    if mapping.drives not in robot_axes:
        valid_names = [
            *DEGREES_OF_FREEDOM,
            *(axis for axis in robot_axes if axis not in DEGREES_OF_FREEDOM),
        ]
        raise InputProfileError(
            "profile {name}: {control} drives {drives}, which the robot does not have; known: "
            "{names}",
            name=repr(profile.name),
            control=repr(mapping.control),
            drives=repr(mapping.drives),
            names=", ".join(valid_names),
        )
    return (mapping.drives,)


def _check_single_use(profile: InputProfile, device: DeviceMapping) -> None:
    # An axis has two sides, −1 and 1, each of which may have a function. A button has the side 0.
    # An axis and a button may have the same name.
    side_functions: list[tuple[tuple[str, int], str]] = [
        ((axis.control, side), message("engine", "drives {drives}").fill(drives=axis.drives))
        for axis in device.axes
        for side in (-1, 1)
    ]
    side_functions += [
        ((action.control, _find_side(action)), action.action.value) for action in device.actions
    ]
    functions: dict[tuple[str, int], str] = {}
    for side, function in side_functions:
        if side in functions:
            raise InputProfileError(
                "profile {name}: control {control} of {key} would have two functions, "
                "{found} and {use}; remove one",
                name=repr(profile.name),
                control=repr(side[0]),
                key=device.key,
                found=functions[side],
                use=function,
            )
        functions[side] = function


def _find_side(action: ActionMapping) -> int:
    return 0 if action.at is None else (-1 if action.at < 0 else 1)


def _describe_unknown_control(
    control: str, kind: str, existing_controls: tuple[str, ...], device: PluggedDevice
) -> str:
    return message(
        "engine",
        "{device} has no {kind} {control}; it has {known}. Choose one of these, or a profile for "
        "this device",
    ).fill(
        device=str(device),
        kind=kind,
        control=repr(control),
        known=", ".join(existing_controls) or marked("engine", "none"),
    )
