"""Choice of the profile in use. It can be changed and saved, and is remembered."""

import re
from dataclasses import dataclass, replace
from pathlib import Path

from rotemina.app.errors import InputProfileError
from rotemina.app.language import describe_error
from rotemina.app.motion.inputs import InputDevices, InputProfile, ListedProfile, check_profile
from rotemina.app.settings import UserSettings
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.words import format_device_name

PROFILE_KEY = "inputs.profile"
# Stands for the profile that is made automatically for the connected devices.
AUTOMATIC_PROFILE = ""
_MAX_NAME_LENGTH = 60


@dataclass(frozen=True, slots=True)
class ProfileOption:
    """Entry in the list of profiles.

    Attributes
    ----------
    name : str
        The name of the file, or ``AUTOMATIC_PROFILE``.
    text : str
        The text in the list.
    problem : str or None
        Why the profile cannot be chosen.
    """

    name: str
    text: str
    problem: str | None = None


class ProfileChoice:
    """Choice of the profile of the input devices.

    Parameters
    ----------
    devices : InputDevices
    settings : UserSettings
        Stores the choice for the next start.
    robot_axes : tuple of str
    """

    def __init__(
        self, devices: InputDevices, settings: UserSettings, robot_axes: tuple[str, ...]
    ) -> None:
        self._devices = devices
        self._settings = settings
        self._robot_axes = robot_axes
        self._listed_profiles: dict[str, ListedProfile] = {}
        # The file name of the chosen profile, or `AUTOMATIC_PROFILE`.
        self.chosen = AUTOMATIC_PROFILE
        # Whether the profile in use has unsaved changes.
        self.is_changed = False
        self.read_options()

    def use_last_profile(self) -> str | None:
        """Use the profile that was chosen last. Return why this is impossible, or None."""
        name = self._settings.get(PROFILE_KEY, AUTOMATIC_PROFILE)
        if name == AUTOMATIC_PROFILE:
            return None
        try:
            self._use_profile(name)
        except InputProfileError as error:
            return tr("Input devices: {error}. An automatic profile is used instead.").format(
                error=error
            )
        return None

    def read_options(self) -> tuple[ProfileOption, ...]:
        """Read the folder of profiles again, and return the options."""
        self._listed_profiles = {listed.path.stem: listed for listed in self._devices.profiles}
        return self.options

    @property
    def options(self) -> tuple[ProfileOption, ...]:
        """The profiles that were in the folder when it was last read."""
        saved = [self._make_option(name, listed) for name, listed in self._listed_profiles.items()]
        return (ProfileOption(AUTOMATIC_PROFILE, tr("Automatic")), *saved)

    def choose_profile(self, name: str) -> None:
        """Use a saved profile or the automatic one, and remember the choice.

        Raises
        ------
        InputProfileError
            If the profile cannot be used. The previous one then stays in use.
        """
        self._use_profile(name)
        self._settings.set(PROFILE_KEY, name)

    def use_changed_profile(self, profile: InputProfile) -> None:
        """Use a changed profile.

        Raises
        ------
        InputProfileError
            If the profile cannot be used. The previous one then stays in use.
        """
        self._devices.use_profile(profile)
        self.is_changed = True

    def discard(self) -> None:
        """Discard the changes of the chosen profile.

        If its file is missing or can no longer be used, the automatic profile is used.

        Raises
        ------
        InputProfileError
            If the chosen profile is missing or can no longer be used.
        """
        try:
            self._use_profile(self.chosen)
        except InputProfileError:
            self.choose_profile(AUTOMATIC_PROFILE)
            raise

    def has_profile(self, name: str) -> bool:
        """Return whether there is a profile of this name, ignoring case."""
        self.read_options()
        return name.casefold() in {other.casefold() for other in self._listed_profiles}

    def save(self, name: str) -> Path:
        """Save the profile in use under a name, choose it, and return its file.

        Raises
        ------
        InputProfileError
            If no profile is in use, or the name is invalid.
        FileWriteError
            If the file cannot be written.
        """
        profile = self._devices.profile
        if profile is None:
            raise InputProfileError(tr("there is no profile to save: map a control first"))
        renamed_profile = _with_name(profile, name)
        path = self._devices.save_profile(renamed_profile)
        self.read_options()
        self._devices.use_profile(renamed_profile)
        self.chosen, self.is_changed = path.stem, False
        self._settings.set(PROFILE_KEY, self.chosen)
        return path

    def suggest_name(self) -> str:
        """Return a name under which the profile in use can be saved."""
        if self.chosen != AUTOMATIC_PROFILE:
            return self.chosen
        for view in self._devices.view.devices:
            if view.is_driving:
                return make_valid_name(format_device_name(view.device.identity))
        return tr("Profile")

    def _use_profile(self, name: str) -> None:
        if name == AUTOMATIC_PROFILE:
            self._devices.use_profile(None)
        else:
            self.read_options()
            listed = self._listed_profiles.get(name)
            if listed is None:
                raise InputProfileError(
                    tr("there is no profile {name!r} any more").format(name=name)
                )
            if listed.profile is None:
                raise InputProfileError(
                    listed.problem or tr("{file}: cannot be read").format(file=listed.path)
                )
            self._devices.use_profile(listed.profile)
        self.chosen, self.is_changed = name, False

    def _make_option(self, name: str, listed: ListedProfile) -> ProfileOption:
        if listed.profile is None:
            return ProfileOption(
                name, tr("{name} – cannot be used").format(name=name), listed.problem
            )
        try:
            check_profile(listed.profile, self._robot_axes)
        except InputProfileError as error:
            return ProfileOption(
                name, tr("{name} – not for this robot").format(name=name), describe_error(error)
            )
        return ProfileOption(name, name)


def make_valid_name(name: str) -> str:
    """Return a valid profile name that is similar to this name."""
    valid_name = re.sub(r"[^\w ().,+-]+", " ", name)
    valid_name = re.sub(r"\s+", " ", valid_name)[:_MAX_NAME_LENGTH].strip(" ().,+-")
    return valid_name or tr("Profile")


def _with_name(profile: InputProfile, name: str) -> InputProfile:
    try:
        return replace(profile, name=name)
    except ValueError as error:
        # The message of pydantic has several lines, so another message replaces it.
        raise InputProfileError(
            tr(
                "{name!r} cannot be the name of a profile: it must begin with a letter or "
                "digit and have at most 60 letters, digits, blanks and ( ) . , + - _"
            ).format(name=name)
        ) from error
