"""Settings that a controller lists, and the machine coordinates that they imply."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from rotemina.drivers.gcode.error_texts import ControllerFirmware
from rotemina.drivers.gcode.grbl_reports import parse_number

_HOMING_SETTING, _DIRECTION_SETTING, _PULL_OFF_SETTING, _INCHES_SETTING = 22, 23, 27, 13
# In grblHAL, $22 is a bit field. This bit makes the origin the position of the switches.
_FORCED_ORIGIN_BIT = 8
# Build options, as letters in [OPT:…].
_FORCED_ORIGIN_LETTER, _SINGLE_HOMING_LETTER = "Z", "H"
# In mm or degrees. Reports have three decimals, and after homing an axis may rest a step away.
_POSITION_TOLERANCE = 0.01


@dataclass(frozen=True, slots=True)
class ControllerSettings:
    """Settings and build options that a controller reports.

    Attributes
    ----------
    texts : mapping str -> str
        Text of each setting, by name. A name is a number or, in FluidNC, a path.
    options : str
        Letters of the build options, ``[OPT:…]``.
    firmware : ControllerFirmware
    is_virtual : bool
        Whether the controller reports that it is an emulation.
    """

    texts: Mapping[str, str] = field(default_factory=dict)
    options: str = ""
    firmware: ControllerFirmware = ControllerFirmware.GRBL
    is_virtual: bool = False

    def find_number(self, name: int | str) -> float | None:
        """Return a setting as a number; None if it is missing or not a number."""
        text = self.texts.get(str(name))
        return None if text is None else parse_number(text)

    @property
    def can_home(self) -> bool:
        """Whether homing is enabled."""
        return bool(self.find_number(_HOMING_SETTING))

    @property
    def homes_single_axes(self) -> bool:
        """Whether a single axis can be homed."""
        return _SINGLE_HOMING_LETTER in self.options

    @property
    def reports_inches(self) -> bool:
        """Whether reported positions are in inches."""
        return bool(self.find_number(_INCHES_SETTING))

    def find_declared_low_end(self, letter: str, number: int, travel: float) -> float:
        """Return the low end of an axis' travel that the settings imply, mm or degrees."""
        if (configured := self._find_configured_low_end(letter, travel)) is not None:
            return configured
        return 0.0 if self._forces_origin and self._is_homed_at_low_end(number) else -travel

    def find_low_end_after_homing(
        self, letter: str, number: int, travel: float, homed_at: float
    ) -> float | None:
        """Return the low end of an axis' travel that agrees with the position after homing.

        Return None if no possible range contains the position.

        Parameters
        ----------
        letter, number : str, int
            Letter and number of the axis.
        travel, homed_at : float
            Travel, and position after homing, mm or degrees.
        """
        if (configured := self._find_configured_low_end(letter, travel)) is not None:
            return configured if self._is_in_travel(configured, travel, homed_at) else None
        # After homing an axis rests near an end of its travel, at the pull-off distance.
        max_distance = (self.find_number(_PULL_OFF_SETTING) or 0.0) + _POSITION_TOLERANCE
        low_ends = [
            low
            for low in (-travel, 0.0)
            if self._is_in_travel(low, travel, homed_at)
            and min(homed_at - low, low + travel - homed_at) <= max_distance
        ]
        if len(low_ends) == 2:
            # Both ranges fit, so the switch is near 0, and the travel extends away from the switch.
            return 0.0 if self._is_homed_at_low_end(number) else -travel
        return low_ends[0] if low_ends else None

    def _find_configured_low_end(self, letter: str, travel: float) -> float | None:
        """Return the low end in FluidNC's configuration; None for other firmware."""
        switch_position = self.find_number(make_homing_path(letter, "mpos_mm"))
        direction = self.texts.get(make_homing_path(letter, "positive_direction"))
        if switch_position is None or direction is None:
            return None
        is_at_high_end = direction.strip().lower() == "true"
        return switch_position - travel if is_at_high_end else switch_position

    @property
    def _forces_origin(self) -> bool:
        homing_bits = int(self.find_number(_HOMING_SETTING) or 0)
        return _FORCED_ORIGIN_LETTER in self.options or bool(homing_bits & _FORCED_ORIGIN_BIT)

    def _is_homed_at_low_end(self, number: int) -> bool:
        return bool(int(self.find_number(_DIRECTION_SETTING) or 0) >> number & 1)

    @staticmethod
    def _is_in_travel(low: float, travel: float, position: float) -> bool:
        return low - _POSITION_TOLERANCE <= position <= low + travel + _POSITION_TOLERANCE


def make_homing_path(letter: str, name: str) -> str:
    """Return the path of a homing setting of an axis in FluidNC."""
    return f"/axes/{letter.lower()}/homing/{name}"
