"""What a hand holds on the pad: keys and the pointer, made into deflections. Free of Qt."""

from enum import StrEnum

from rotemina.app.motion.teleoperation.axis_calibration import uncalibrated
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.drivers.inputs.pad import Pad

AXES = ("x", "y", "z")
#: Deflections of keys and pointer at their end, as a choice offers them.
SHARES = (0.1, 0.25, 0.5, 0.75, 1.0)


class Key(StrEnum):
    """The keys of the pad, by what they do."""

    LEFT = "left"
    RIGHT = "right"
    NEAR = "near"
    AWAY = "away"
    LOWER = "lower"
    RAISE = "raise"
    CLUTCH = "clutch"


_MOVES = {
    Key.LEFT: ("x", -1.0),
    Key.RIGHT: ("x", 1.0),
    Key.NEAR: ("y", -1.0),
    Key.AWAY: ("y", 1.0),
    Key.LOWER: ("z", -1.0),
    Key.RAISE: ("z", 1.0),
}


class VirtualStick:
    """Keys and pointer on a pad; two keys against each other are none.

    Parameters
    ----------
    pad : Pad
        With the axes x, y, z and the buttons fine, coarse and clutch.

    Attributes
    ----------
    most : float
        The deflection at an end, 0 to 1.
    """

    def __init__(self, pad: Pad) -> None:
        self.most = 1.0
        self._pad = pad
        self._keys: set[Key] = set()
        self._dragged: dict[str, float] = {}
        self._scaled = {Action.FINE: False, Action.COARSE: False}
        self._told: dict[str, float | bool] = {}

    @property
    def busy(self) -> bool:
        """Whether anything is held."""
        return bool(self._keys or self._dragged or any(self._scaled.values()))

    @property
    def dragging(self) -> bool:
        """Whether the pointer holds something."""
        return bool(self._dragged)

    @property
    def deflections(self) -> dict[str, float]:
        """What is requested of each axis, −1 to 1."""
        found = dict.fromkeys(AXES, 0.0)
        for key in self._keys & _MOVES.keys():
            axis, way = _MOVES[key]
            found[axis] += way
        found.update(self._dragged)
        return {axis: self.most * way for axis, way in found.items()}

    def press(self, key: Key) -> None:
        """Hold a key."""
        self._keys.add(key)
        self._tell()

    def release(self, key: Key) -> None:
        """Release a key."""
        self._keys.discard(key)
        self._tell()

    def drag(self, **ways: float) -> None:
        """Have the pointer at a place, −1 to 1 of each axis named; beyond counts as the end."""
        self._dragged = {axis: min(max(way, -1.0), 1.0) for axis, way in ways.items()}
        self._tell()

    def drop(self) -> None:
        """Let go with the pointer."""
        self._dragged = {}
        self._tell()

    def modify(self, *, fine: bool, coarse: bool) -> None:
        """Hold fine or coarse; a change of that ends what moves, as it would leap in speed."""
        scaled = {Action.FINE: fine, Action.COARSE: coarse}
        if scaled != self._scaled:
            self._scaled = scaled
            self._keys, self._dragged = set(), {}
            self._tell()

    def take_over(self, held: bool) -> None:
        """Hold the button by which the pad asks to drive, or release it."""
        self._pad.hold(Action.TAKE_OVER, held)

    def renew(self) -> None:
        """Say that what is held still is; what the pad has release meanwhile stays so."""
        if not self._pad.renew():
            self.release_all()

    def release_all(self) -> None:
        """Release everything."""
        self._keys, self._dragged = set(), {}
        self._scaled = dict.fromkeys(self._scaled, False)
        self._told = {}
        self._pad.release_all()

    def _tell(self) -> None:
        for axis, way in self.deflections.items():
            if self._told.get(axis, 0.0) != way:
                self._told[axis] = way
                self._pad.deflect(axis, uncalibrated(way))
        held = {**self._scaled, Action.CLUTCH: Key.CLUTCH in self._keys}
        for button, is_held in held.items():
            if self._told.get(button, False) != is_held:
                self._told[button] = is_held
                self._pad.hold(button, is_held)
