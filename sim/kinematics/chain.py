"""The serial chain of a hybrid robot: which axes are its joints, and how far each may go.

Three tables x, y, z carry a pivot; the pin tilts about it by thx, thy and slides along itself by
zn. The roles of axes follow from their names. A robot that lacks one has no such chain.
"""

from dataclasses import dataclass
from math import pi
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.robot.file import CONVENTIONAL_UNITS
from rotemina.sim.robot.model import VOLTAGE_SLACK, PiezoAxis, Robot
from rotemina.sim.trajectory.axis_limits import RANGE_SLACK, OutOfLimitsError, voltage_bounds

JOINTS = ("x", "y", "z", "thx", "thy", "zn")
TABLES = slice(0, 3)
NANO = slice(3, 6)


class ChainError(InputError):
    """A robot whose axes do not form the hybrid chain."""


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """The joints of one robot; make one by :meth:`of`.

    Joint positions are arrays (..., 6) in the order x, y, z (m), thx, thy (rad), zn (m): true
    positions q, without the offset of a sensor's reading.

    Attributes
    ----------
    robot : Robot
    pin_length : float
        From the pivot to the tip with zn at 0, m.
    lower, upper : (6,)
        Where each joint may go: its range, less what its amplifier's voltage cannot reach.
    columns : tuple of int, length 6
        Where the joints stand among the robot's axes.
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
            If an axis or the pin's length is missing, an axis moves in the wrong quantity, the
            pin is shorter than zn reaches, or a tilt range reaches 90 degrees.
        """
        _check_roles(robot)
        bounds = np.array([_bounds(robot, name) for name in JOINTS])
        pin_length = robot.pin_length
        assert pin_length is not None
        if pin_length <= bounds[5, 1]:
            raise ChainError(
                message(
                    "engine",
                    "robot {name}: pin_length {pin_length} must be greater than the end "
                    "of zn's range, {end}",
                ).fill(
                    name=repr(robot.name),
                    pin_length=exact(pin_length, "m"),
                    end=exact(bounds[5, 1], "m"),
                )
            )
        for name, (low, high) in zip(JOINTS[3:5], bounds[3:5], strict=True):
            if max(-low, high) >= pi / 2:
                raise ChainError(
                    message(
                        "engine",
                        "robot {name}: axis {axis} may tilt from {low} rad to {high} rad; "
                        "the kinematic chain is valid for tilts below {most} rad",
                    ).fill(
                        name=repr(robot.name),
                        axis=AxisName(name),
                        low=rounded(low, 6),
                        high=rounded(high, 6),
                        most=rounded(pi / 2, 6),
                    )
                )
        columns = tuple(list(robot.axes).index(name) for name in JOINTS)
        return cls(robot, pin_length, read_only(bounds[:, 0]), read_only(bounds[:, 1]), columns)

    @property
    def centre(self) -> FloatArray:
        """The middle (6,) of every joint's way."""
        return np.asarray(0.5 * (self.lower + self.upper))

    @property
    def slack(self) -> FloatArray:
        """What a joint (6,) may be beyond its ends by rounding, as for any other target."""
        return np.asarray(RANGE_SLACK * (self.upper - self.lower))

    def joints_of(self, positions: FloatArray) -> FloatArray:
        """Pick the joints (..., 6) out of positions (..., axes) in the robot's order."""
        return np.asarray(positions)[..., list(self.columns)]

    def positions_of(self, joints: FloatArray, others: FloatArray) -> FloatArray:
        """Put joints (..., 6) into positions (..., axes); ``others`` holds the other axes."""
        shape = np.broadcast_shapes(joints.shape[:-1], others.shape[:-1])
        positions = np.array(np.broadcast_to(others, (*shape, others.shape[-1])))
        positions[..., list(self.columns)] = joints
        return positions

    def inside(self, joints: FloatArray) -> np.ndarray:
        """Return whether every joint of (..., 6) is where it may be: bool (...)."""
        above = joints >= self.lower - self.slack
        return np.asarray((above & (joints <= self.upper + self.slack)).all(axis=-1))

    def check(self, joints: FloatArray) -> FloatArray:
        """Return joints (..., 6) that may be commanded; every solution passes through here.

        Raises
        ------
        OutOfLimitsError
            Naming the joint that is farthest out for its range, its value and its bounds.
        """
        if not self.inside(joints).all():
            raise OutOfLimitsError(self._complaint(joints))
        return joints

    def _complaint(self, joints: FloatArray) -> str:
        excess = np.maximum(self.lower - joints, joints - self.upper) / (self.upper - self.lower)
        worst = np.unravel_index(int(np.argmax(np.nan_to_num(excess, nan=np.inf))), excess.shape)
        joint = int(worst[-1])
        name, unit = JOINTS[joint], CONVENTIONAL_UNITS[JOINTS[joint]]
        low, high = float(self.lower[joint]), float(self.upper[joint])
        scale = max(abs(low), abs(high))
        value, first, last = (
            exact(number, unit, size=scale) for number in (float(joints[worst]), low, high)
        )
        said = message(
            "engine",
            "axis {axis}: position {value} is outside its bounds, {low} to {high}; choose a "
            "tip position or a tilt inside the workspace",
        )
        if worst[:-1]:
            said = message(
                "engine",
                "axis {axis}: position {value} at row {row} is outside its bounds, {low} to "
                "{high}; choose a tip position or a tilt inside the workspace",
            )
        row = ", ".join(str(int(i)) for i in worst[:-1])
        return said.fill(axis=AxisName(name), value=value, row=row, low=first, high=last)


def _check_roles(robot: Robot) -> None:
    missing = [name for name in JOINTS if name not in robot.axes]
    if missing:
        raise ChainError(
            message(
                "engine",
                "robot {name} has no axis {missing}; the hybrid chain needs axes named "
                "{joints}, and this robot has {axes}",
            ).fill(
                name=repr(robot.name),
                missing=", ".join(missing),
                joints=" ".join(JOINTS),
                axes=" ".join(robot.axes),
            )
        )
    for name in JOINTS:
        if robot.unit(name) not in (None, CONVENTIONAL_UNITS[name]):
            raise ChainError(
                message(
                    "engine",
                    "robot {name}: axis {axis} moves in {unit}; the hybrid chain needs {needed}",
                ).fill(
                    name=repr(robot.name),
                    axis=AxisName(name),
                    unit=robot.unit(name) or "?",
                    needed=CONVENTIONAL_UNITS[name],
                )
            )
    if robot.pin_length is None:
        raise ChainError(
            message(
                "engine",
                "robot {name}: pin_length missing; the hybrid chain needs the length "
                "from the pivot to the tip, [robot] pin_length in m",
            ).fill(name=repr(robot.name))
        )


def _bounds(robot: Robot, name: str) -> tuple[float, float]:
    """Return the range of an axis, cut to what its voltage reaches."""
    axis = robot.axes[name]
    voltage, (low, high) = voltage_bounds(axis), axis.range
    if voltage is None or not isinstance(axis, PiezoAxis):
        return low, high
    slack = VOLTAGE_SLACK * max(abs(bound) for bound in voltage)
    ends = sorted((axis.gain * (voltage[0] - slack), axis.gain * (voltage[1] + slack)))
    return max(low, ends[0]), min(high, ends[1])
