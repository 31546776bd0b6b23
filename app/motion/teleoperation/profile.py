"""Profiles: the function of each control of each input device, one strict TOML file each."""

import re
from dataclasses import dataclass as plain_dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.toml_file import STRICT, Format, Switch, Text
from rotemina.sim.errors import InputError

# It is the name of its file too, on every file system.
_NAME = re.compile(r"\w([\w ().,+-]{0,58}[\w)+])?")


class ProfileError(InputError):
    """A profile that cannot be read, kept or used."""


class OperatorRole(StrEnum):
    """Who sits at a device; of two seats only one drives."""

    TRAINER = "trainer"
    TRAINEE = "trainee"


class SilencePolicy(StrEnum):
    """What a device moves while it is silent, if it reports only changes."""

    STOP = "stop"  # nothing, after a second
    CONTINUE = "continue"  # the same as before, for as long as it is silent


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class AxisMapping:
    """An axis of a device that moves something.

    Attributes
    ----------
    control : str
        What the device calls the axis.
    drives : str
        A degree of freedom of the stick (``x``, ``y``, ``z``), or an axis of the robot.
    inverted : bool
        Whether it goes the other way than its calibration says.
    """

    control: Text
    drives: Text
    inverted: Switch = False


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class ActionMapping:
    """A button, or an axis beyond a threshold, that does something.

    Attributes
    ----------
    control : str
        What the device calls the button or the axis.
    action : Action
    at : float or None
        For an axis: the deflection, −1 to 1 without about 0, from which it counts as pressed.
    hysteresis : float
        How far nearer to the rest the axis must come back to count as released.
    """

    control: Text
    action: Action
    at: Annotated[float, Field(strict=True, ge=-1, le=1)] | None = None
    hysteresis: Annotated[float, Field(strict=True, ge=0, le=0.5)] = 0.1

    def __post_init__(self) -> None:
        if self.at is not None and abs(self.at) < 0.1:
            raise ValueError(f"at = {self.at:g}: must be at least 0.1, or at most -0.1")


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class DeviceMapping:
    """What the controls of one device do.

    Attributes
    ----------
    key : str
        The device's key; ``*`` stands for any letters, ``?`` for one.
    seat : OperatorRole
    when_silent : SilencePolicy
        Of a device that keeps reporting while nothing changes silence is a failure in any case.
    axes : tuple of AxisMapping
    actions : tuple of ActionMapping
    """

    key: Text
    seat: OperatorRole = OperatorRole.TRAINER
    when_silent: SilencePolicy = SilencePolicy.STOP
    axes: tuple[AxisMapping, ...] = ()
    actions: tuple[ActionMapping, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Profile:
    """Mappings of one or several devices, under a name."""

    name: Text
    devices: Annotated[tuple[DeviceMapping, ...], Field(min_length=1)]

    def __post_init__(self) -> None:
        if not _NAME.fullmatch(self.name):
            raise ValueError(
                f"name = {self.name!r}: it must begin with a letter or digit and have at most 60 "
                "letters, digits, blanks and ( ) . , + - _"
            )


@plain_dataclass(frozen=True, slots=True)
class ListedProfile:
    """A file in the folder of profiles: its profile, or its problem."""

    path: Path
    profile: Profile | None
    problem: str | None = None


_FORMAT = Format(
    Profile,
    {"devices": DeviceMapping, "axes": AxisMapping, "actions": ActionMapping},
    ProfileError,
)


def load_profile(path: Path) -> Profile:
    """Return the profile of a file.

    Raises
    ------
    ProfileError
        With file, key, value and bound.
    """
    return _FORMAT.load(path)


def save_profile(folder: Path, profile: Profile) -> Path:
    """Write a profile under its name, in place of one of the same name; return the file.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    path = folder / f"{profile.name}.toml"
    _FORMAT.save(path, profile)
    return path


def listed_profiles(folder: Path) -> tuple[ListedProfile, ...]:
    """Return the profiles of a folder by file name; a bad one says what is wrong with it."""
    found = []
    for path in sorted(folder.glob("[!.]*.toml")):  # what is just being written begins with a dot
        try:
            found.append(ListedProfile(path, load_profile(path)))
        except ProfileError as error:
            found.append(ListedProfile(path, None, str(error)))
    return tuple(found)
