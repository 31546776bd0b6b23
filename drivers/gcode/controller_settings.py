"""The settings that a controller lists, and the machine space that they describe."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from rotemina.drivers.gcode.error_texts import Firmware
from rotemina.drivers.gcode.grbl_reports import read_number

_HOMING, _DIRECTION, _PULL_OFF, _INCHES = 22, 23, 27, 13
# Of $22, where it is more than a switch (grblHAL).
_FORCED_ORIGIN_BIT = 8
# Letters of [OPT:…].
_FORCED_ORIGIN_LETTER, _SINGLE_HOMING_LETTER = "Z", "H"
# A report has three decimals; a controller that rests after homing may be a step off.
_TOLERANCE = 0.01


@dataclass(frozen=True, slots=True)
class ControllerSettings:
    """What a controller says of itself.

    Attributes
    ----------
    texts : mapping str -> str
        Its settings by name, a number or (FluidNC) a path; any text.
    options : str
        Letters of what it was built with, ``[OPT:…]``.
    firmware : Firmware
    is_virtual : bool
        Whether it says that it is a program.
    """

    texts: Mapping[str, str] = field(default_factory=dict)
    options: str = ""
    firmware: Firmware = Firmware.GRBL
    is_virtual: bool = False

    def number(self, name: int | str) -> float | None:
        """Return a setting as a number; None where it is missing or no number."""
        text = self.texts.get(str(name))
        return None if text is None else read_number(text)

    @property
    def can_home(self) -> bool:
        """Whether homing is enabled."""
        return bool(self.number(_HOMING))

    @property
    def homes_single_axes(self) -> bool:
        """Whether one axis can be homed alone."""
        return _SINGLE_HOMING_LETTER in self.options

    @property
    def reports_inches(self) -> bool:
        """Whether positions are in inches."""
        return bool(self.number(_INCHES))

    def declared_low_end(self, letter: str, number: int, travel: float) -> float:
        """Return where an axis' count begins by the settings alone, mm or degrees."""
        if (declared := self._configured_low_end(letter, travel)) is not None:
            return declared
        return 0.0 if self._forces_origin and self._homes_low(number) else -travel

    def low_end_after_homing(
        self, letter: str, number: int, travel: float, homed_at: float
    ) -> float | None:
        """Return where an axis' count begins, seen from where homing ended; None if unclear.

        Parameters
        ----------
        letter, number : str, int
            Of the axis.
        travel, homed_at : float
            mm or degrees.
        """
        if (declared := self._configured_low_end(letter, travel)) is not None:
            return declared if self._contains(declared, travel, homed_at) else None
        near = (self.number(_PULL_OFF) or 0.0) + _TOLERANCE
        spaces = [
            low
            for low in (-travel, 0.0)
            if self._contains(low, travel, homed_at)
            and min(homed_at - low, low + travel - homed_at) <= near
        ]
        if len(spaces) == 2:
            # It counts 0 at the switch: the range lies on the other side of it.
            return 0.0 if self._homes_low(number) else -travel
        return spaces[0] if spaces else None

    def _configured_low_end(self, letter: str, travel: float) -> float | None:
        """Return where FluidNC's configuration puts the low end; None for other firmware."""
        at = self.number(homing_path(letter, "mpos_mm"))
        direction = self.texts.get(homing_path(letter, "positive_direction"))
        if at is None or direction is None:
            return None
        return at - travel if direction.strip().lower() == "true" else at

    @property
    def _forces_origin(self) -> bool:
        homing = int(self.number(_HOMING) or 0)
        return _FORCED_ORIGIN_LETTER in self.options or bool(homing & _FORCED_ORIGIN_BIT)

    def _homes_low(self, number: int) -> bool:
        return bool(int(self.number(_DIRECTION) or 0) >> number & 1)

    @staticmethod
    def _contains(low: float, travel: float, at: float) -> bool:
        return low - _TOLERANCE <= at <= low + travel + _TOLERANCE


def homing_path(letter: str, name: str) -> str:
    """Return the path of a setting of an axis' homing in FluidNC."""
    return f"/axes/{letter.lower()}/homing/{name}"
