"""Input profiles: the function of each control of the input devices, one TOML file each."""

import re
from dataclasses import dataclass as plain_dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs.intent import OperatorAction
from rotemina.app.settings import (
    FORBID_EXTRA_KEYS,
    NonEmptyText,
    StrictBool,
    TomlFormat,
)

# The name is also a file name, so it must be valid on every file system.
_NAME_PATTERN = re.compile(r"\w([\w ().,+-]{0,58}[\w)+])?")


class OperatorRole(StrEnum):
    """Role of the operator who uses a device. Only one role drives at a time."""

    TRAINER = "trainer"
    TRAINEE = "trainee"


class SilencePolicy(StrEnum):
    """Policy for motion while a device that reports only changes is silent."""

    # The motion stops after one second of silence.
    STOP = "stop"
    # The motion continues for any time.
    CONTINUE = "continue"


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class AxisMapping:
    """Mapping of an axis of a device to a coordinate or an axis of the robot.

    Attributes
    ----------
    control : str
        Name of the axis on the device.
    drives : str
        A degree of freedom of the stick (``x``, ``y``, ``z``), or an axis of the robot.
    inverted : bool
        Whether the calibrated direction is reversed.
    """

    control: NonEmptyText
    drives: NonEmptyText
    inverted: StrictBool = False


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class ActionMapping:
    """Mapping of a button, or of an axis beyond a threshold, to an action.

    Attributes
    ----------
    control : str
        Name of the button or axis on the device.
    action : OperatorAction
    at : float or None
        For an axis, the deflection at which it counts as pressed: −1 to −0.1, or 0.1 to 1.
    hysteresis : float
        Distance from ``at`` towards the rest at which the axis counts as released.
    """

    control: NonEmptyText
    action: OperatorAction
    at: Annotated[float, Field(strict=True, ge=-1, le=1)] | None = None
    hysteresis: Annotated[float, Field(strict=True, ge=0, le=0.5)] = 0.1

    def __post_init__(self) -> None:
        if self.at is not None and abs(self.at) < 0.1:
            raise ValueError(f"at = {self.at:g}: must be at least 0.1, or at most -0.1")


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class DeviceMapping:
    """Mapping of the controls of one device.

    Attributes
    ----------
    key : str
        Key of the device. ``*`` stands for any characters, ``?`` for one character.
    seat : OperatorRole
    when_silent : SilencePolicy
        Policy for a device that reports only changes. The silence of a device that reports
        continuously is always a failure.
    axes : tuple of AxisMapping
    actions : tuple of ActionMapping
    """

    key: NonEmptyText
    seat: OperatorRole = OperatorRole.TRAINER
    when_silent: SilencePolicy = SilencePolicy.STOP
    axes: tuple[AxisMapping, ...] = ()
    actions: tuple[ActionMapping, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class InputProfile:
    """Named set of mappings for one or several devices."""

    name: NonEmptyText
    devices: Annotated[tuple[DeviceMapping, ...], Field(min_length=1)]

    def __post_init__(self) -> None:
        if not _NAME_PATTERN.fullmatch(self.name):
            raise ValueError(
                f"name = {self.name!r}: it must begin with a letter or digit and have at most 60 "
                "letters, digits, blanks and ( ) . , + - _"
            )


@plain_dataclass(frozen=True, slots=True)
class ListedProfile:
    """File in the folder of profiles, with its profile, or why it is invalid."""

    path: Path
    profile: InputProfile | None
    problem: str | None = None


_FILE_FORMAT = TomlFormat(
    InputProfile,
    {"devices": DeviceMapping, "axes": AxisMapping, "actions": ActionMapping},
    InputProfileError,
)


def load_profile(path: Path) -> InputProfile:
    """Read a profile from a file.

    Raises
    ------
    InputProfileError
        If the file is invalid. The message names file, key, value and bound.
    """
    return _FILE_FORMAT.load(path)


def save_profile(folder: Path, profile: InputProfile) -> Path:
    """Write a profile to a file of the same name, replacing an older one; return the path.

    Raises
    ------
    FileWriteError
        If the file cannot be written.
    """
    path = folder / f"{profile.name}.toml"
    _FILE_FORMAT.save(path, profile)
    return path


def list_profiles(folder: Path) -> tuple[ListedProfile, ...]:
    """Return the profiles of a folder, sorted by file name. Invalid ones have a problem."""
    profiles = []
    # The names of files that are still being written begin with a dot.
    for path in sorted(folder.glob("[!.]*.toml")):
        try:
            profiles.append(ListedProfile(path, load_profile(path)))
        except InputProfileError as error:
            profiles.append(ListedProfile(path, None, str(error)))
    return tuple(profiles)
