"""The profile in use: remembered between starts, changed, saved."""

import re
from dataclasses import dataclass, replace
from pathlib import Path

from rotemina.app.motion.teleoperation.input_devices import InputDevices
from rotemina.app.motion.teleoperation.profile import ListedProfile, Profile, ProfileError
from rotemina.app.motion.teleoperation.profile_check import check_profile
from rotemina.app.settings import Settings
from rotemina.app.shell.engine_words import error_text
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.words import device_name

SETTING = "inputs.profile"
AUTOMATIC = ""  # the setting, where the profile is made for what is plugged in
_LETTERS = 60


@dataclass(frozen=True, slots=True)
class Offer:
    """A profile that can be chosen, or why it cannot.

    Attributes
    ----------
    name : str
        Of its file; empty: automatic.
    text : str
        As a list shows it.
    problem : str or None
    """

    name: str
    text: str
    problem: str | None = None


class ProfileChoice:
    """The choice of the input devices' profile.

    Parameters
    ----------
    devices : InputDevices
    settings : Settings
        Remembers the choice.
    robot_axes : tuple of str
    """

    def __init__(
        self, devices: InputDevices, settings: Settings, robot_axes: tuple[str, ...]
    ) -> None:
        self._devices = devices
        self._settings = settings
        self._robot_axes = robot_axes
        self._listed: dict[str, ListedProfile] = {}
        #: What was chosen: the name of a file, or automatic.
        self.chosen = AUTOMATIC
        #: Whether what is used was changed since, and no file has it.
        self.changed = False
        self.look()

    def begin(self) -> str | None:
        """Use the profile of the last start; return its problem, if any."""
        name = self._settings.get(SETTING, AUTOMATIC)
        if name == AUTOMATIC:
            return None
        try:
            self._use(name)
        except ProfileError as error:
            return tr("Input devices: {error}. An automatic profile is used instead.").format(
                error=error
            )
        return None

    def look(self) -> tuple[Offer, ...]:
        """Return what can be chosen, after a look into the folder."""
        self._listed = {listed.path.stem: listed for listed in self._devices.profiles}
        return self.offers

    @property
    def offers(self) -> tuple[Offer, ...]:
        """What can be chosen, as of the latest look."""
        kept = [self._offer(name, listed) for name, listed in self._listed.items()]
        return (Offer(AUTOMATIC, tr("Automatic")), *kept)

    def choose(self, name: str) -> None:
        """Use a kept profile, or an automatic one, and remember that.

        Raises
        ------
        ProfileError
            If it cannot be used; the one before stays.
        """
        self._use(name)
        self._settings.set(SETTING, name)

    def edit(self, profile: Profile) -> None:
        """Use a changed profile.

        Raises
        ------
        ProfileError
            If it cannot be used; the one before stays.
        """
        self._devices.use(profile)
        self.changed = True

    def discard(self) -> None:
        """Go back to what was chosen, as it was; to an automatic one if that has gone.

        Raises
        ------
        ProfileError
            If it has gone, or cannot be used any more.
        """
        try:
            self._use(self.chosen)
        except ProfileError:
            self.choose(AUTOMATIC)
            raise

    def exists(self, name: str) -> bool:
        """Whether a file has this name, on any file system."""
        self.look()
        return name.casefold() in {other.casefold() for other in self._listed}

    def save(self, name: str) -> Path:
        """Keep what is used under a name, choose it, and return its file.

        Raises
        ------
        ProfileError
            If there is no profile, or no file can have this name.
        FileWriteError
            If it cannot be written.
        """
        profile = self._devices.profile
        if profile is None:
            raise ProfileError(tr("there is no profile to save: map a control first"))
        named = _named(profile, name)
        path = self._devices.keep(named)
        self.look()
        self._devices.use(named)
        self.chosen, self.changed = path.stem, False
        self._settings.set(SETTING, self.chosen)
        return path

    def suggestion(self) -> str:
        """Return a name to keep what is used under."""
        if self.chosen != AUTOMATIC:
            return self.chosen
        for one in self._devices.view.devices:
            if one.drives:
                return plain_name(device_name(one.device.identity))
        return tr("Profile")

    def _use(self, name: str) -> None:
        if name == AUTOMATIC:
            self._devices.use(None)
        else:
            self.look()
            listed = self._listed.get(name)
            if listed is None:
                raise ProfileError(tr("there is no profile {name!r} any more").format(name=name))
            if listed.profile is None:
                raise ProfileError(
                    listed.problem or tr("{file}: cannot be read").format(file=listed.path)
                )
            self._devices.use(listed.profile)
        self.chosen, self.changed = name, False

    def _offer(self, name: str, listed: ListedProfile) -> Offer:
        if listed.profile is None:
            return Offer(name, tr("{name} – cannot be used").format(name=name), listed.problem)
        try:
            check_profile(listed.profile, self._robot_axes)
        except ProfileError as error:
            return Offer(
                name, tr("{name} – not for this robot").format(name=name), error_text(error)
            )
        return Offer(name, name)


def plain_name(name: str) -> str:
    """Return a name that a profile may have, as near to this one as can be."""
    plain = re.sub(r"[^\w ().,+-]+", " ", name)
    plain = re.sub(r"\s+", " ", plain)[:_LETTERS].strip(" ().,+-")
    return plain or tr("Profile")


def _named(profile: Profile, name: str) -> Profile:
    try:
        return replace(profile, name=name)
    except ValueError as error:  # pydantic's, which tells several lines
        raise ProfileError(
            tr(
                "{name!r} cannot be the name of a profile: it must begin with a letter or "
                "digit and have at most 60 letters, digits, blanks and ( ) . , + - _"
            ).format(name=name)
        ) from error
