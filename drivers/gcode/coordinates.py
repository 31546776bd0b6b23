"""A robot's axes in a GRBL controller's coordinates: letters, mm or degrees, below zero.

Machine coordinates of GRBL end at 0 and begin at minus the travel (``$130`` and on), whichever end
the switch is at; the low end of an axis' range lies there.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import floor, pi, sqrt
from typing import Self

from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed
from rotemina.sim.robot.model import Robot, StepperAxis

_UNITS = {"m": 1000.0, "rad": 180.0 / pi}  # to mm, to degrees
_DIGIT = 1e-3  # a report has three decimals
_FIRST_STEPS, _FIRST_RATE, _FIRST_ACCELERATION, _FIRST_TRAVEL = 100, 110, 120, 130
_SLACK = 1e-6  # settings have three decimals; this is their rounding, as a share


@dataclass(frozen=True, slots=True)
class StageAxis:
    """One axis of a controller.

    Attributes
    ----------
    name : str
        The robot's.
    letter : str
    number : int
        Its place in reports and settings.
    scale : float
        Units of the controller (mm, degrees) in one of the robot (m, rad).
    low, high : float
        Ends of the range, m or rad.
    travel, resolution : float
        What the controller travels, and its smallest step that is told, m or rad.
    speed, acceleration : float
        The greatest, m/s and m/s² or rad/s and rad/s².
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

    @classmethod
    def of(
        cls, robot: Robot, name: str, letter: str, number: int, settings: Mapping[int, float]
    ) -> Self:
        """Return an axis as the settings of its controller say.

        Raises
        ------
        InputError
            If a setting is missing, or lets the axis do more, or go less far, than its robot file.
        """
        axis = robot.axes[name]
        scale = _UNITS[robot.unit(name) or "m"]

        def value(first: int) -> float:
            if settings.get(first + number, 0.0) <= 0.0:
                raise InputError(
                    message(
                        "engine",
                        "axis {name}: the controller has no setting ${first}; it needs one for "
                        "each of the {count} axes",
                    ).fill(name=name, first=first + number, count=len(robot.axes))
                )
            return settings[first + number]

        speed, acceleration = value(_FIRST_RATE) / 60.0 / scale, value(_FIRST_ACCELERATION) / scale
        travel = value(_FIRST_TRAVEL) / scale
        unit = "mm" if scale == _UNITS["m"] else "deg"
        for first, bound, least, wanted in (
            (_FIRST_TRAVEL, travel, True, axis.span),
            (_FIRST_ACCELERATION, acceleration, False, axis.max_acceleration),
        ):
            if wanted is None:
                continue
            over = wanted - bound if least else bound - wanted
            if over > _SLACK * wanted:
                raise InputError(
                    message(
                        "engine",
                        "axis {name}: the controller's ${first} = {settings} does not agree with "
                        "the robot file; send it ${first}={wanted} ({unit}), or correct the file",
                    ).fill(
                        name=name,
                        first=first + number,
                        settings=settings[first + number],
                        wanted=fixed(wanted * scale, 3),
                        unit=unit,
                    )
                )
        return cls(
            name, letter, number, scale, *axis.range, travel,
            max(_DIGIT, 1.0 / value(_FIRST_STEPS)) / scale,
            min(speed, axis.max_speed or speed), acceleration,
        )  # fmt: skip

    def rounded(self, value: float) -> float:
        """Return a position, m or rad, in the controller's coordinates, in its own digits."""
        bounded = min(max(value, self.low), self.high)
        return round((bounded - self.low - self.travel) * self.scale, 3)

    def value(self, number: float) -> float:
        """Return a position of a report in m or rad."""
        return self.low + self.travel + number / self.scale


def check_stage(robot: Robot, letters: str) -> None:
    """Refuse a robot that no controller of so many letters moves.

    Raises
    ------
    InputError
        With the axis, and what to do.
    """
    if len(robot.axes) > len(letters):
        raise InputError(
            message(
                "engine", "robot {name} has {count} axes; the letters {letters} name {letter_count}"
            ).fill(
                name=repr(robot.name),
                count=len(robot.axes),
                letters=repr(letters),
                letter_count=len(letters),
            )
        )
    for name, axis in robot.axes.items():
        if not isinstance(axis, StepperAxis):
            raise InputError(
                message(
                    "engine",
                    "robot {robot}: axis {axis} is moved by a {kind}, but a G-code "
                    "controller moves stepping motors; choose a robot file with such axes "
                    "only, such as xyz",
                ).fill(robot=repr(robot.name), axis=name, kind=axis.kind)
            )


def feed_of(way: Mapping[StageAxis, float], seconds: float) -> float:
    """Return F for a distance, mm or degrees of each axis, in a time: per minute, rounded down."""
    length = sqrt(sum(part * part for part in way.values()))
    return max(floor(60e3 * length / seconds) / 1e3, _DIGIT)
