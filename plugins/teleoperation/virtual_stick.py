"""Deflections from the keys and the pointer of the pad. This module does not use Qt."""

from enum import StrEnum

from rotemina.app.motion.inputs import OperatorAction, to_uncalibrated_raw
from rotemina.drivers.inputs import InputPad

PAD_AXES = ("x", "y", "z")
#: Choices for the deflection of the keys and of the pointer at the end of its travel.
MAX_DEFLECTION_CHOICES = (0.1, 0.25, 0.5, 0.75, 1.0)


class PadKey(StrEnum):
    """Key of the pad, named by its function."""

    LEFT = "left"
    RIGHT = "right"
    NEAR = "near"
    AWAY = "away"
    LOWER = "lower"
    RAISE = "raise"
    CLUTCH = "clutch"


_KEY_DEFLECTIONS = {
    PadKey.LEFT: ("x", -1.0),
    PadKey.RIGHT: ("x", 1.0),
    PadKey.NEAR: ("y", -1.0),
    PadKey.AWAY: ("y", 1.0),
    PadKey.LOWER: ("z", -1.0),
    PadKey.RAISE: ("z", 1.0),
}


class VirtualStick:
    """Virtual stick that keys and pointer deflect. Two opposite keys cancel each other.

    Parameters
    ----------
    pad : InputPad
        Pad with the axes x, y, z and the buttons fine, coarse and clutch.

    Attributes
    ----------
    max_deflection : float
        Deflection for a key and for the pointer at the end of its travel, 0 to 1.
    """

    def __init__(self, pad: InputPad) -> None:
        self.max_deflection = 1.0
        self._pad = pad
        self._held_keys: set[PadKey] = set()
        self._pointer_deflections: dict[str, float] = {}
        self._held_scaling_buttons = {OperatorAction.FINE: False, OperatorAction.COARSE: False}
        self._sent_values: dict[str, float | bool] = {}

    @property
    def busy(self) -> bool:
        """Whether any key or the pointer is held."""
        return bool(
            self._held_keys or self._pointer_deflections or any(self._held_scaling_buttons.values())
        )

    @property
    def dragging(self) -> bool:
        """Whether the pointer is dragging."""
        return bool(self._pointer_deflections)

    @property
    def deflections(self) -> dict[str, float]:
        """The requested deflection of each axis, −1 to 1."""
        sums = dict.fromkeys(PAD_AXES, 0.0)
        for key in self._held_keys & _KEY_DEFLECTIONS.keys():
            axis, deflection = _KEY_DEFLECTIONS[key]
            sums[axis] += deflection
        sums.update(self._pointer_deflections)
        return {axis: self.max_deflection * deflection for axis, deflection in sums.items()}

    def press(self, key: PadKey) -> None:
        """Hold a key."""
        self._held_keys.add(key)
        self._update_pad()

    def release(self, key: PadKey) -> None:
        """Release a key."""
        self._held_keys.discard(key)
        self._update_pad()

    def drag(self, **deflections: float) -> None:
        """Set the deflection of the named axes by the pointer, limited to −1 to 1."""
        self._pointer_deflections = {
            axis: min(max(deflection, -1.0), 1.0) for axis, deflection in deflections.items()
        }
        self._update_pad()

    def release_pointer(self) -> None:
        """Release the pointer."""
        self._pointer_deflections = {}
        self._update_pad()

    def set_scaling(self, *, fine: bool, coarse: bool) -> None:
        """Set fine and coarse. A change releases keys and pointer, to avoid a jump in speed."""
        held_scaling_buttons = {OperatorAction.FINE: fine, OperatorAction.COARSE: coarse}
        if held_scaling_buttons != self._held_scaling_buttons:
            self._held_scaling_buttons = held_scaling_buttons
            self._held_keys, self._pointer_deflections = set(), {}
            self._update_pad()

    def take_over(self, held: bool) -> None:
        """Hold or release the button with which the pad takes control."""
        self._pad.hold(OperatorAction.TAKE_OVER, held)

    def renew(self) -> None:
        """Renew the lease of the pad. If it has expired, release everything."""
        if not self._pad.renew():
            self.release_all()

    def release_all(self) -> None:
        """Release everything."""
        self._held_keys, self._pointer_deflections = set(), {}
        self._held_scaling_buttons = dict.fromkeys(self._held_scaling_buttons, False)
        self._sent_values = {}
        self._pad.release_all()

    def _update_pad(self) -> None:
        for axis, deflection in self.deflections.items():
            if self._sent_values.get(axis, 0.0) != deflection:
                self._sent_values[axis] = deflection
                self._pad.deflect(axis, to_uncalibrated_raw(deflection))
        held_buttons = {
            **self._held_scaling_buttons,
            OperatorAction.CLUTCH: PadKey.CLUTCH in self._held_keys,
        }
        for button, is_held in held_buttons.items():
            if self._sent_values.get(button, False) != is_held:
                self._sent_values[button] = is_held
                self._pad.hold(button, is_held)
