"""Changes to a profile, one control at a time.

A profile is immutable, so each change returns a new profile. The new profile is not checked here,
but only when it is used. It is then refused if, for example, two devices move the same axis.
"""

from collections.abc import Callable
from dataclasses import replace

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs import (
    ActionMapping,
    AxisMapping,
    ControlKind,
    DeviceMapping,
    InputCalibration,
    InputProfile,
    MovedControl,
    OperatorAction,
    OperatorRole,
    PluggedDevice,
    SilencePolicy,
    assign_mappings,
)
from rotemina.plugins.inputs import tr

# By default, an axis counts as pressed beyond this fraction of its deflection.
DEFAULT_THRESHOLD = 0.5
MIN_THRESHOLD = 0.1
NEW_PROFILE_NAME = "New"


class ProfileEditor:
    """Editor of the part of a profile that belongs to one device.

    Parameters
    ----------
    profile : InputProfile or None
    device : PluggedDevice
        The device whose controls are mapped.
    plugged : sequence of PluggedDevice
        All connected devices. They determine which mapping of the profile the device gets.
    """

    def __init__(
        self,
        profile: InputProfile | None,
        device: PluggedDevice,
        plugged: tuple[PluggedDevice, ...],
    ) -> None:
        self._profile = profile
        self._device = device
        mappings = assign_mappings(profile, plugged) if profile is not None else {}
        # The mapping of the device, or None if the profile does not contain the device.
        self.mapping: DeviceMapping | None = mappings.get(device.identity.key)

    def find_axis_mapping(self, target: str) -> AxisMapping | None:
        """Return the mapping of an axis of this device to a target, or None."""
        axes = self.mapping.axes if self.mapping is not None else ()
        return next((mapping for mapping in axes if mapping.drives == target), None)

    def find_action_mappings(self, action: OperatorAction) -> tuple[ActionMapping, ...]:
        """Return the mappings of controls of this device to an action."""
        actions = self.mapping.actions if self.mapping is not None else ()
        return tuple(mapping for mapping in actions if mapping.action is action)

    def with_axis(self, target: str, control: str, *, inverted: bool = False) -> InputProfile:
        """Return the profile in which an axis of this device moves a target."""
        new_mapping = AxisMapping(control=control, drives=target, inverted=inverted)

        def change(mapping: DeviceMapping) -> DeviceMapping:
            axes = tuple(other for other in mapping.axes if other.drives != target)
            return replace(mapping, axes=(*axes, new_mapping))

        return self._change_mapping(change)

    def without_axis(self, target: str) -> InputProfile:
        """Return the profile in which no axis of this device moves a target."""
        return self._change_mapping(
            lambda mapping: replace(
                mapping, axes=tuple(other for other in mapping.axes if other.drives != target)
            )
        )

    def with_action(
        self, action: OperatorAction, control: str, at: float | None = None
    ) -> InputProfile:
        """Return the profile in which only this control of this device triggers an action."""
        new_mapping = ActionMapping(control=control, action=action, at=at)

        def change(mapping: DeviceMapping) -> DeviceMapping:
            others = tuple(other for other in mapping.actions if other.action is not action)
            return replace(mapping, actions=(*others, new_mapping))

        return self._change_mapping(change)

    def with_threshold(self, action: OperatorAction, at: float) -> InputProfile:
        """Return the profile with another threshold for the axes mapped to an action.

        Parameters
        ----------
        action : OperatorAction
        at : float
            The fraction of the deflection, −1 to 1, beyond which an axis counts as pressed.

        Raises
        ------
        InputProfileError
            If the threshold is too close to the rest position or beyond the ends.
        """
        if not MIN_THRESHOLD <= abs(at) <= 1.0:
            raise InputProfileError(
                tr(
                    "{action}: the threshold of {percent:g} % of the deflection must be "
                    "{least:g} to 100 % in either direction"
                ).format(action=action, percent=100 * at, least=100 * MIN_THRESHOLD)
            )

        def change_threshold(action_mapping: ActionMapping) -> ActionMapping:
            has_threshold = action_mapping.action is action and action_mapping.at is not None
            return replace(action_mapping, at=at) if has_threshold else action_mapping

        return self._change_mapping(
            lambda mapping: replace(mapping, actions=tuple(map(change_threshold, mapping.actions)))
        )

    def without_action(self, action: OperatorAction) -> InputProfile:
        """Return the profile in which no control of this device triggers an action."""
        return self._change_mapping(
            lambda mapping: replace(
                mapping,
                actions=tuple(other for other in mapping.actions if other.action is not action),
            )
        )

    def with_silence(self, policy: SilencePolicy) -> InputProfile:
        """Return the profile with another policy for silence of this device."""
        return self._change_mapping(lambda mapping: replace(mapping, when_silent=policy))

    def with_seat(self, seat: OperatorRole | None) -> InputProfile:
        """Return the profile with this device at a seat, or without the device if it is None.

        Raises
        ------
        InputProfileError
            If no device would be left in the profile.
        """
        if seat is not None:
            return self._change_mapping(lambda mapping: replace(mapping, seat=seat))
        assert self._profile is not None
        others = tuple(mapping for mapping in self._profile.devices if mapping is not self.mapping)
        if not others:
            raise InputProfileError(
                tr(
                    "profile {profile!r} would have no device; map another device first, or "
                    "choose another profile"
                ).format(profile=self._profile.name)
            )
        return replace(self._profile, devices=others)

    def _change_mapping(self, change: Callable[[DeviceMapping], DeviceMapping]) -> InputProfile:
        """Return the profile with a changed mapping of this device, which is added if missing."""
        if self.mapping is None:
            return self._add_mapping(change)
        assert self._profile is not None
        devices = tuple(
            change(mapping) if mapping is self.mapping else mapping
            for mapping in self._profile.devices
        )
        return replace(self._profile, devices=devices)

    def _add_mapping(self, change: Callable[[DeviceMapping], DeviceMapping]) -> InputProfile:
        new_mapping = change(DeviceMapping(key=self._device.identity.key))
        if self._profile is None:
            return InputProfile(name=NEW_PROFILE_NAME, devices=(new_mapping,))
        return replace(self._profile, devices=(*self._profile.devices, new_mapping))


def exchange_seats(profile: InputProfile) -> InputProfile:
    """Return the profile with the seats of trainer and trainee exchanged."""
    other_seat = {
        OperatorRole.TRAINER: OperatorRole.TRAINEE,
        OperatorRole.TRAINEE: OperatorRole.TRAINER,
    }
    return replace(
        profile,
        devices=tuple(
            replace(mapping, seat=other_seat[mapping.seat]) for mapping in profile.devices
        ),
    )


def is_inversion_needed(detected: MovedControl, calibration: InputCalibration) -> bool:
    """Return whether an axis must be inverted to be positive in the direction of its motion."""
    has_increased = detected.direction > 0
    return has_increased is calibration.find_axis(detected.control).inverted


def compute_threshold(detected: MovedControl, calibration: InputCalibration) -> float | None:
    """Return the threshold beyond which a moved axis counts as pressed, or None for a button."""
    if detected.kind is ControlKind.BUTTON:
        return None
    return -DEFAULT_THRESHOLD if is_inversion_needed(detected, calibration) else DEFAULT_THRESHOLD
