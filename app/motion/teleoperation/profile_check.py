"""Whether a profile fits the robot's axes, the connected devices and their controls."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from types import MappingProxyType

from rotemina.app.motion.teleoperation.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    OperatorRole,
    Profile,
    ProfileError,
)
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.sim.messages import Listed, joined, marked, message

#: The degrees of freedom of the stick, and the robot's axes that they can move in one stage or
#: the other: a pin along z is tilted along x by thy, along y by thx.
DEGREES_OF_FREEDOM: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"x": ("x", "thy"), "y": ("y", "thx"), "z": ("z", "zn")}
)


@dataclass(frozen=True, slots=True)
class PluggedDevice:
    """An input device that is open.

    Attributes
    ----------
    identity : InputIdentity
    axes, buttons : tuple of str
        What they are called, in the order of the readings.
    streams : bool
        Whether it continues talking while nothing changes, so that silence means a fault.
    """

    identity: InputIdentity
    axes: tuple[str, ...]
    buttons: tuple[str, ...]
    streams: bool = False

    def __str__(self) -> str:
        return f"{self.identity.name} ({self.identity.key})"


def check_profile(profile: Profile, robot_axes: Collection[str]) -> None:
    """Refuse a profile that no devices could make usable.

    Raises
    ------
    ProfileError
        If something is to be driven that the robot does not have, two controls of one seat would
        drive one axis, a control does two things, or nobody is the trainer.
    """
    for seat in OperatorRole:
        owners: dict[str, AxisMapping] = {}
        seated = (device for device in profile.devices if device.seat is seat)
        for mapping in (axis for device in seated for axis in device.axes):
            for axis in _driven(profile, mapping, robot_axes):
                other = owners.setdefault(axis, mapping)
                if other is not mapping:
                    raise ProfileError(
                        message(
                            "engine",
                            "profile {name}: robot axis {axis} would have two owners, {owner} and "
                            "{other_owner}; let one of them drive something else",
                        ).fill(
                            name=repr(profile.name),
                            axis=axis,
                            owner=_owner(profile, other),
                            other_owner=_owner(profile, mapping),
                        )
                    )
    for device in profile.devices:
        _check_single_use(profile, device)
    if not any(device.seat is OperatorRole.TRAINER for device in profile.devices):
        raise ProfileError(
            message(
                "engine",
                "profile {name}: every device has seat = 'trainee'; one must have 'trainer'",
            ).fill(name=repr(profile.name))
        )


def assigned(profile: Profile, devices: Iterable[PluggedDevice]) -> Mapping[str, DeviceMapping]:
    """Return what each plugged device is to do, by its key; one that is not in it does nothing.

    A full key goes before a pattern; of several devices that fit one pattern the first is taken.
    """
    free = [device.identity.key for device in devices]
    found: dict[str, DeviceMapping] = {}
    for mapping in sorted(profile.devices, key=lambda each: each.key not in free):
        for key in free:
            if key == mapping.key or fnmatchcase(key, mapping.key):
                found[key] = mapping
                free.remove(key)
                break
    return found


def missing(profile: Profile, devices: Collection[PluggedDevice]) -> str | None:
    """Return which devices of a profile are not plugged in, and what is; None if all are."""
    there = assigned(profile, devices).values()
    gone = [mapping.key for mapping in profile.devices if not any(mapping is m for m in there)]
    if not gone:
        return None
    present = joined(map(str, devices), ", ") or marked("engine", "nothing")
    return message(
        "engine",
        "profile {name} needs {gone}, which is not connected; connected: {present}."
        " Connect it, or choose or create another profile",
    ).fill(name=repr(profile.name), gone=Listed(tuple(gone)), present=present)


def check_controls(mapping: DeviceMapping, device: PluggedDevice) -> None:
    """Refuse a mapping of controls that a device does not have.

    Raises
    ------
    ProfileError
        With the control, the device, and what it has.
    """
    for axis in mapping.axes:
        if axis.control not in device.axes:
            raise ProfileError(_unknown(axis.control, "axis", device.axes, device))
    for action in mapping.actions:
        if action.at is not None and action.control not in device.axes:
            raise ProfileError(_unknown(action.control, "axis", device.axes, device))
        if action.at is None and action.control not in device.buttons:
            unknown = _unknown(action.control, "button", device.buttons, device)
            if action.control in device.axes:
                unknown = joined((unknown, message("engine", "an axis needs at = …")), "; ")
            raise ProfileError(unknown)


def _owner(profile: Profile, mapping: AxisMapping) -> str:
    key = next(d.key for d in profile.devices if any(mapping is axis for axis in d.axes))
    return message("engine", "{control} of {key} (drives {drives})").fill(
        control=repr(mapping.control), key=key, drives=mapping.drives
    )


def _driven(profile: Profile, mapping: AxisMapping, robot_axes: Collection[str]) -> tuple[str, ...]:
    if mapping.drives in DEGREES_OF_FREEDOM:
        return DEGREES_OF_FREEDOM[mapping.drives]
    if mapping.drives not in robot_axes:
        known = [*DEGREES_OF_FREEDOM, *(a for a in robot_axes if a not in DEGREES_OF_FREEDOM)]
        raise ProfileError(
            message(
                "engine",
                "profile {name}: {control} drives {drives}, which the robot does not have; known: "
                "{names}",
            ).fill(
                name=repr(profile.name),
                control=repr(mapping.control),
                drives=repr(mapping.drives),
                names=", ".join(known),
            )
        )
    return (mapping.drives,)


def _check_single_use(profile: Profile, device: DeviceMapping) -> None:
    # A control may be an axis with two sides, or a button (side 0) of the same name.
    uses: list[tuple[tuple[str, int], str]] = [
        ((axis.control, side), message("engine", "drives {drives}").fill(drives=axis.drives))
        for axis in device.axes
        for side in (-1, 1)
    ]
    uses += [((each.control, _side(each)), each.action.value) for each in device.actions]
    found: dict[tuple[str, int], str] = {}
    for control, use in uses:
        if control in found:
            raise ProfileError(
                message(
                    "engine",
                    "profile {name}: control {control} of {key} would have two functions, "
                    "{found} and {use}; remove one",
                ).fill(
                    name=repr(profile.name),
                    control=repr(control[0]),
                    key=device.key,
                    found=found[control],
                    use=use,
                )
            )
        found[control] = use


def _side(action: ActionMapping) -> int:
    return 0 if action.at is None else (-1 if action.at < 0 else 1)


def _unknown(control: str, kind: str, known: tuple[str, ...], device: PluggedDevice) -> str:
    return message(
        "engine",
        "{device} has no {kind} {control}; it has {known}. Choose one of these, or a profile for "
        "this device",
    ).fill(
        device=str(device),
        kind=kind,
        control=repr(control),
        known=", ".join(known) or marked("engine", "none"),
    )
