"""A robot's axes in a GRBL controller's machine coordinates, which are in mm or degrees.

GRBL's coordinates go from minus the travel (``$130`` and following) to 0, regardless of the end at
which the switch is. With a forced origin (GRBL's option Z, bit 3 of ``$22`` in grblHAL) they are 0
at the switch. In FluidNC the configuration states the position of the switch. The low end of an
axis' range is the low end of its travel.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import floor, pi, sqrt
from typing import Self

from rotemina.drivers.contract import ReadingBounds
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_fixed
from rotemina.sim.robot import Robot

# From m to mm, and from rad to degrees.
SCALE_BY_UNIT = {"m": 1000.0, "rad": 180.0 / pi}
# Reports have three decimals.
_REPORT_STEP = 1e-3
# Numbers of the settings of the first axis. The settings of the other axes follow.
FIRST_STEPS_SETTING, FIRST_RATE_SETTING, FIRST_ACCELERATION_SETTING, FIRST_TRAVEL_SETTING = (
    100,
    110,
    120,
    130,
)
S_PER_MINUTE = 60.0
# One step allows for the rounding of a report, and one for the rounding of a target.
_TOLERANCE_STEPS = 2.0


@dataclass(frozen=True, slots=True)
class StageAxis:
    """One axis of a controller.

    Attributes
    ----------
    name : str
        Name in the robot file.
    letter : str
    number : int
        Index in reports and settings.
    scale : float
        Controller units (mm, degrees) per robot unit (m, rad).
    low, high : float
        Ends of the range, m or rad.
    travel, resolution : float
        Travel of the controller's axis, and the smallest step that it reports, m or rad.
    speed, acceleration : float
        Maximum values, m/s and m/s² or rad/s and rad/s².
    origin : float
        Low end of the range in the controller's coordinates, mm or degrees.
    """

    name: str
    letter: str
    number: int
    scale: float
    low: float
    high: float
    travel: float
    resolution: float
    speed: float
    acceleration: float
    origin: float

    @classmethod
    def of(
        cls, robot: Robot, name: str, letter: str, number: int, settings: ControllerSettings
    ) -> Self:
        """Create an axis from the robot file and the controller's settings.

        Raises
        ------
        InputError
            If a setting is missing.
        """
        axis = robot.axes[name]
        scale = SCALE_BY_UNIT[robot.unit(name) or "m"]

        def read_setting(first_setting: int) -> float:
            setting = settings.find_number(first_setting + number)
            if setting is None or setting <= 0.0:
                raise InputError(
                    "axis {name}: the controller has no setting ${first}; it needs one for "
                    "each of the {count} axes",
                    name=name,
                    first=first_setting + number,
                    count=len(robot.axes),
                )
            return setting

        travel = read_setting(FIRST_TRAVEL_SETTING)
        speed = read_setting(FIRST_RATE_SETTING) / S_PER_MINUTE / scale
        return cls(
            name,
            letter,
            number,
            scale,
            *axis.range,
            travel / scale,
            max(_REPORT_STEP, 1.0 / read_setting(FIRST_STEPS_SETTING)) / scale,
            min(speed, axis.max_speed or speed),
            read_setting(FIRST_ACCELERATION_SETTING) / scale,
            settings.find_declared_low_end(letter, number, travel),
        )

    @property
    def tolerance(self) -> float:
        """Maximum difference between a reported position and the true step count, m or rad."""
        return _TOLERANCE_STEPS * self.resolution

    @property
    def reading_bounds(self) -> ReadingBounds:
        """Bounds of plausible readings of this axis."""
        return ReadingBounds(self.low, self.high, self.speed, self.tolerance)

    @property
    def permitted_targets(self) -> tuple[float, float]:
        """Ends of the range in the controller's coordinates."""
        return self.to_controller(self.low), self.to_controller(self.high)

    def with_homed_origin(self, homed_at: float, settings: ControllerSettings) -> Self:
        """Return a copy whose origin agrees with the controller's position after homing.

        Raises
        ------
        InputError
            If the position is outside the controller's travel or the range of the robot file.
        """
        travel = self.travel * self.scale
        origin = settings.find_low_end_after_homing(self.letter, self.number, travel, homed_at)
        relocated = self if origin is None else replace(self, origin=origin)
        position = relocated.from_controller(homed_at)
        if (
            origin is not None
            and self.low - self.tolerance <= position <= self.high + self.tolerance
        ):
            return relocated
        unit = "mm" if self.scale == SCALE_BY_UNIT["m"] else "deg"
        raise InputError(
            "axis {name}: after homing the controller counts {count} {unit}, which is not "
            "within its range: the robot file has {low} to {high} {unit}, the controller "
            "travels {travel} {unit} (${setting}). Correct ${setting} and the homing settings "
            "($22, $23, $27), or the robot file",
            name=self.name,
            count=format_fixed(homed_at, 3),
            unit=unit,
            low=format_fixed(self.low * self.scale, 3),
            high=format_fixed(self.high * self.scale, 3),
            travel=format_fixed(travel, 3),
            setting=FIRST_TRAVEL_SETTING + self.number,
        )

    def to_controller(self, value: float) -> float:
        """Convert a position, m or rad, to the controller's coordinates.

        The position is clipped to the range, and the result is rounded.
        """
        clipped = min(max(value, self.low), self.high)
        return round(self.origin + (clipped - self.low) * self.scale, 3)

    def from_controller(self, number: float) -> float:
        """Convert a position in a report to m or rad."""
        return self.low + (number - self.origin) / self.scale


def compute_feed(distances: Mapping[StageAxis, float], seconds: float) -> float:
    """Return the feed rate F, per minute, that takes a given time for a path, rounded down.

    ``distances`` contains the distance of each axis, mm or degrees.
    """
    length = sqrt(sum(distance * distance for distance in distances.values()))
    return max(floor(60e3 * length / seconds) / 1e3, _REPORT_STEP)
