"""The serial chain of a hybrid robot: its joints and their limits.

Three tables x, y, z carry a pivot. The pin tilts about it by thx and thy and slides along its own
axis by zn. The roles of the axes follow from their names. A robot that lacks one of these axes has
no such chain.
"""

from dataclasses import dataclass
from math import pi
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.errors import ChainError, OutOfLimitsError
from rotemina.sim.messages import AxisName, format_rounded, message
from rotemina.sim.robot import (
    VOLTAGE_SLACK_RATIO,
    PiezoAxis,
    Robot,
)
from rotemina.sim.robot_files import CONVENTIONAL_UNITS
from rotemina.sim.trajectory import RANGE_SLACK_RATIO, get_voltage_bounds
from rotemina.sim.units import format_exact

JOINTS = ("x", "y", "z", "thx", "thy", "zn")
TABLES = slice(0, 3)
NANO = slice(3, 6)


@dataclass(frozen=True, slots=True, eq=False)
class KinematicChain:
    """The joints of one robot. Make an instance by :meth:`of`.

    Joint positions are arrays (..., 6) in the order x, y, z (m), thx, thy (rad), zn (m). They are
    true positions q, without the offset of a sensor.

    Attributes
    ----------
    robot : Robot
    pin_length : float
        Distance from the pivot to the tip with zn at 0, m.
    lower, upper : (6,)
        Limits of the joints: the range of each axis, reduced to what its amplifier voltage reaches.
    columns : tuple of int, length 6
        Indices of the joints among the robot's axes.
    """

    robot: Robot
    pin_length: float
    lower: FloatArray
    upper: FloatArray
    columns: tuple[int, ...]

    @classmethod
    def of(cls, robot: Robot) -> Self:
        """Find the joints of ``robot``.

        Raises
        ------
        ChainError
            If an axis or the pin length is missing, an axis has the wrong unit, the pin is shorter
            than the end of zn's range, or a tilt range reaches 90 degrees.
        """
        _check_roles(robot)
        bounds = np.array([_find_reachable_range(robot, name) for name in JOINTS])
        pin_length = robot.pin_length
        assert pin_length is not None
        if pin_length <= bounds[5, 1]:
            raise ChainError(
                "robot {name}: pin_length {pin_length} must be greater than the end "
                "of zn's range, {end}",
                name=repr(robot.name),
                pin_length=format_exact(pin_length, "m"),
                end=format_exact(bounds[5, 1], "m"),
            )
        for name, (low, high) in zip(JOINTS[3:5], bounds[3:5], strict=True):
            if max(-low, high) >= pi / 2:
                raise ChainError(
                    "robot {name}: axis {axis} may tilt from {low} rad to {high} rad; "
                    "the kinematic chain is valid for tilts below {most} rad",
                    name=repr(robot.name),
                    axis=AxisName(name),
                    low=format_rounded(low, 6),
                    high=format_rounded(high, 6),
                    most=format_rounded(pi / 2, 6),
                )
        columns = tuple(list(robot.axes).index(name) for name in JOINTS)
        return cls(
            robot, pin_length, make_read_only(bounds[:, 0]), make_read_only(bounds[:, 1]), columns
        )

    @property
    def centre(self) -> FloatArray:
        """The middle (6,) of every joint's range."""
        return np.asarray(0.5 * (self.lower + self.upper))

    @property
    def slack(self) -> FloatArray:
        """Distance (6,) by which rounding may take a joint beyond its limits."""
        return np.asarray(RANGE_SLACK_RATIO * (self.upper - self.lower))

    def select_joints(self, positions: FloatArray) -> FloatArray:
        """Return the joints (..., 6) from positions (..., axes) in the robot's order."""
        return np.asarray(positions)[..., list(self.columns)]

    def select_positions(self, joints: FloatArray, others: FloatArray) -> FloatArray:
        """Return positions (..., axes) with these joints (..., 6); other axes from ``others``."""
        shape = np.broadcast_shapes(joints.shape[:-1], others.shape[:-1])
        positions = np.array(np.broadcast_to(others, (*shape, others.shape[-1])))
        positions[..., list(self.columns)] = joints
        return positions

    def is_inside(self, joints: FloatArray) -> np.ndarray:
        """Return whether all joints (..., 6) are within their limits: bool (...)."""
        is_above = joints >= self.lower - self.slack
        return np.asarray((is_above & (joints <= self.upper + self.slack)).all(axis=-1))

    def check(self, joints: FloatArray) -> FloatArray:
        """Return the joints (..., 6) unchanged if all are within their limits.

        Every solution of the inverse kinematics passes through this check.

        Raises
        ------
        OutOfLimitsError
            If a joint is outside. The message names the joint that is farthest out relative to its
            range, its value and its bounds.
        """
        if not self.is_inside(joints).all():
            raise OutOfLimitsError(self._describe_violation(joints))
        return joints

    def _describe_violation(self, joints: FloatArray) -> str:
        excess = np.maximum(self.lower - joints, joints - self.upper) / (self.upper - self.lower)
        worst = np.unravel_index(int(np.argmax(np.nan_to_num(excess, nan=np.inf))), excess.shape)
        joint = int(worst[-1])
        name, unit = JOINTS[joint], CONVENTIONAL_UNITS[JOINTS[joint]]
        low, high = float(self.lower[joint]), float(self.upper[joint])
        scale = max(abs(low), abs(high))
        value_text, low_text, high_text = (
            format_exact(number, unit, size=scale) for number in (float(joints[worst]), low, high)
        )
        text = message(
            "engine",
            "axis {axis}: position {value} is outside its bounds, {low} to {high}; choose a "
            "tip position or a tilt inside the workspace",
        )
        if worst[:-1]:
            text = message(
                "engine",
                "axis {axis}: position {value} at row {row} is outside its bounds, {low} to "
                "{high}; choose a tip position or a tilt inside the workspace",
            )
        row = ", ".join(str(int(i)) for i in worst[:-1])
        return text.fill(
            axis=AxisName(name), value=value_text, row=row, low=low_text, high=high_text
        )


def _check_roles(robot: Robot) -> None:
    missing = [name for name in JOINTS if name not in robot.axes]
    if missing:
        raise ChainError(
            "robot {name} has no axis {missing}; the hybrid chain needs axes named "
            "{joints}, and this robot has {axes}",
            name=repr(robot.name),
            missing=", ".join(missing),
            joints=" ".join(JOINTS),
            axes=" ".join(robot.axes),
        )
    for name in JOINTS:
        if robot.unit(name) not in (None, CONVENTIONAL_UNITS[name]):
            raise ChainError(
                "robot {name}: axis {axis} moves in {unit}; the hybrid chain needs {needed}",
                name=repr(robot.name),
                axis=AxisName(name),
                unit=robot.unit(name) or "?",
                needed=CONVENTIONAL_UNITS[name],
            )
    if robot.pin_length is None:
        raise ChainError(
            "robot {name}: pin_length missing; the hybrid chain needs the length "
            "from the pivot to the tip, [robot] pin_length in m",
            name=repr(robot.name),
        )


def _find_reachable_range(robot: Robot, name: str) -> tuple[float, float]:
    """Return the range of an axis, reduced to what its voltage reaches."""
    axis = robot.axes[name]
    voltage, (low, high) = get_voltage_bounds(axis), axis.range
    if voltage is None or not isinstance(axis, PiezoAxis):
        return low, high
    slack = VOLTAGE_SLACK_RATIO * max(abs(bound) for bound in voltage)
    voltage_ends = sorted((axis.gain * (voltage[0] - slack), axis.gain * (voltage[1] + slack)))
    return max(low, voltage_ends[0]), min(high, voltage_ends[1])
