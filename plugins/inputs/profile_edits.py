"""Changes of a profile, one control at a time; profiles are immutable.

Whether what comes of it can be used is for whoever uses it: two owners are refused there.
"""

from collections.abc import Callable
from dataclasses import replace

from rotemina.app.motion.teleoperation.axis_calibration import Calibration
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.moved_control import Detected, Kind
from rotemina.app.motion.teleoperation.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    OperatorRole,
    Profile,
    ProfileError,
    SilencePolicy,
)
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice, assigned
from rotemina.plugins.inputs import tr

AT = 0.5  # from where on a detected axis counts as pressed, of its deflection
LEAST_AT = 0.1
NEW = "New"  # the name of a profile that has none yet


class Edited:
    """A profile as one device sees it.

    Parameters
    ----------
    profile : Profile or None
    device : PluggedDevice
        The one whose controls are mapped.
    plugged : sequence of PluggedDevice
        All that are there; which mapping is the device's depends on them.
    """

    def __init__(
        self, profile: Profile | None, device: PluggedDevice, plugged: tuple[PluggedDevice, ...]
    ) -> None:
        self._profile = profile
        self._device = device
        found = assigned(profile, plugged) if profile is not None else {}
        #: What the device is to do now; None: the profile has nothing for it.
        self.mapping: DeviceMapping | None = found.get(device.identity.key)

    def axis(self, target: str) -> AxisMapping | None:
        """Return what drives a target, of this device."""
        axes = self.mapping.axes if self.mapping is not None else ()
        return next((each for each in axes if each.drives == target), None)

    def actions(self, action: Action) -> tuple[ActionMapping, ...]:
        """Return what does an action, of this device."""
        actions = self.mapping.actions if self.mapping is not None else ()
        return tuple(each for each in actions if each.action is action)

    def with_axis(self, target: str, control: str, *, inverted: bool = False) -> Profile:
        """Return the profile with a target driven by an axis of this device."""
        made = AxisMapping(control=control, drives=target, inverted=inverted)

        def change(mapping: DeviceMapping) -> DeviceMapping:
            axes = tuple(each for each in mapping.axes if each.drives != target)
            return replace(mapping, axes=(*axes, made))

        return self._with(change)

    def without_axis(self, target: str) -> Profile:
        """Return the profile with a target driven by nothing of this device."""
        return self._with(
            lambda mapping: replace(
                mapping, axes=tuple(each for each in mapping.axes if each.drives != target)
            )
        )

    def with_action(self, action: Action, control: str, at: float | None = None) -> Profile:
        """Return the profile with an action done by one control of this device alone."""
        made = ActionMapping(control=control, action=action, at=at)

        def change(mapping: DeviceMapping) -> DeviceMapping:
            others = tuple(each for each in mapping.actions if each.action is not action)
            return replace(mapping, actions=(*others, made))

        return self._with(change)

    def with_threshold(self, action: Action, at: float) -> Profile:
        """Return the profile with the axes that do an action counting from another deflection.

        Raises
        ------
        ProfileError
            If that is too near to their rest, or beyond their ends.
        """
        if not LEAST_AT <= abs(at) <= 1.0:
            raise ProfileError(
                tr(
                    "{action}: the threshold of {percent:g} % of the deflection must be "
                    "{least:g} to 100 % in either direction"
                ).format(action=action, percent=100 * at, least=100 * LEAST_AT)
            )

        def moved(each: ActionMapping) -> ActionMapping:
            mine = each.action is action and each.at is not None
            return replace(each, at=at) if mine else each

        return self._with(
            lambda mapping: replace(mapping, actions=tuple(map(moved, mapping.actions)))
        )

    def without_action(self, action: Action) -> Profile:
        """Return the profile with an action done by nothing of this device."""
        return self._with(
            lambda mapping: replace(
                mapping,
                actions=tuple(each for each in mapping.actions if each.action is not action),
            )
        )

    def with_silence(self, policy: SilencePolicy) -> Profile:
        """Return the profile with another rule for the silence of this device."""
        return self._with(lambda mapping: replace(mapping, when_silent=policy))

    def with_seat(self, seat: OperatorRole | None) -> Profile:
        """Return the profile with this device at a seat; None: it does nothing.

        Raises
        ------
        ProfileError
            If nothing would be left.
        """
        if seat is not None:
            return self._with(lambda mapping: replace(mapping, seat=seat))
        assert self._profile is not None
        kept = tuple(each for each in self._profile.devices if each is not self.mapping)
        if not kept:
            raise ProfileError(
                tr(
                    "profile {profile!r} would have no device; map another device first, or "
                    "choose another profile"
                ).format(profile=self._profile.name)
            )
        return replace(self._profile, devices=kept)

    def _with(self, change: Callable[[DeviceMapping], DeviceMapping]) -> Profile:
        if self.mapping is None:
            return self._added(change)
        assert self._profile is not None
        devices = tuple(
            change(each) if each is self.mapping else each for each in self._profile.devices
        )
        return replace(self._profile, devices=devices)

    def _added(self, change: Callable[[DeviceMapping], DeviceMapping]) -> Profile:
        made = change(DeviceMapping(key=self._device.identity.key))
        if self._profile is None:
            return Profile(name=NEW, devices=(made,))
        return replace(self._profile, devices=(*self._profile.devices, made))


def exchanged(profile: Profile) -> Profile:
    """Return the profile with trainer and trainee exchanged."""
    other = {OperatorRole.TRAINER: OperatorRole.TRAINEE, OperatorRole.TRAINEE: OperatorRole.TRAINER}
    return replace(
        profile, devices=tuple(replace(each, seat=other[each.seat]) for each in profile.devices)
    )


def turned(detected: Detected, calibration: Calibration) -> bool:
    """Return whether an axis that was moved forwards must be turned round to count forwards."""
    forwards = detected.direction > 0
    return forwards is calibration.axis(detected.control).inverted


def threshold(detected: Detected, calibration: Calibration) -> float | None:
    """Return from where on a detected control counts as pressed; None for a button."""
    if detected.kind is Kind.BUTTON:
        return None
    return -AT if turned(detected, calibration) else AT
