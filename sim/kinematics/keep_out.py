"""Where the tip may be: above a floor, within a radius, clear of the objective.

Ranges of axes do not save a 40 mm pin above a dish. What is allowed is an upright cylinder about
the middle of the workspace, so every straight way between two allowed tips is allowed too. What
axes sweep, each on its own schedule, is bounded as a workspace is.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.kinematics.chain import Chain, ChainError
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.workspace import Box, Workspace
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

SLOW_HEIGHT = 0.5e-3  # m above the floor: below it the tip goes down no faster than that
SLOW_SPEED = 0.5e-3  # m/s
_SLACK = 1e-9  # m, that rounding may take


class Excess(NamedTuple):
    """By how much, m, a tip is beyond each bound; 0 or less where it is inside."""

    below: float
    above: float
    aside: float

    @property
    def any(self) -> bool:
        """Whether the tip is out."""
        return max(self) > _SLACK


@dataclass(frozen=True, slots=True, eq=False)
class KeepOutZone:
    """The tip's bounds on one robot; make one by :meth:`of`.

    Floor and objective are bounds of their own: teaching or removing the floor leaves the other.

    Attributes
    ----------
    chain : Chain
    floor : float
        Least height of the tip, m; -inf: none.
    objective : (low, high) of float
        Heights, m, between which the objective leaves room: it is above the tip where the robot
        file puts it above the floor (the middle, without a floor), else below it, as under an
        inverted microscope. Infinite where nothing bounds it.
    radius : float
        Greatest distance, m, from the upright axis through the middle of the workspace.
    """

    chain: Chain
    floor: float
    objective: tuple[float, float]
    radius: float

    @classmethod
    def of(cls, robot: Robot) -> Self | None:
        """Return the bounds that a robot file gives; None where the robot has no tip.

        Raises
        ------
        ChainError
            If the file bounds the tip of a robot that has none.
        """
        given = robot.keep_out
        bounded = (given.floor, given.radius, given.objective) != (None, None, None)
        try:
            chain = Chain.of(robot)
        except ChainError as error:
            if bounded:
                raise ChainError(
                    message("engine", "{error}; [keep_out] needs a tip to limit").fill(
                        error=str(error)
                    )
                ) from error
            return None
        objective = (-np.inf, np.inf)
        if given.objective is not None:
            middle = float(tip_position(chain, chain.centre)[2])
            above = given.objective > (middle if given.floor is None else given.floor)
            objective = (-np.inf, given.objective) if above else (given.objective, np.inf)
        floor = -np.inf if given.floor is None else given.floor
        radius = np.inf if given.radius is None else given.radius
        return cls(chain, float(floor), objective, float(radius))

    @property
    def low(self) -> float:
        """Least height, m, that floor and objective leave."""
        return max(self.floor, self.objective[0])

    @property
    def high(self) -> float:
        """Greatest height, m, that the objective leaves."""
        return self.objective[1]

    @property
    def bounded(self) -> bool:
        """Whether anything bounds the tip but its joints."""
        return bool(np.isfinite([self.low, self.high, self.radius]).any())

    def taught(self, floor: float | None) -> Self:
        """Return the bounds with another floor, m; None for none at all.

        Raises
        ------
        OutOfLimitsError
            If the floor is no height that the tip can reach, or leaves no room to the objective.
        """
        if floor is None:
            return replace(self, floor=-np.inf)
        reach = Workspace.of(self.chain).hull
        low, high = float(reach.low[2]), min(float(reach.high[2]), self.high)
        if not low - _SLACK <= floor <= high + _SLACK:
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: floor {floor} mm: must be between {low} and {high}, within the "
                    "reach of the tip; teach it where the tip touches",
                ).fill(floor=rounded(1e3 * floor, 6), low=exact(low, "m"), high=exact(high, "m"))
            )
        return replace(self, floor=float(floor))

    def tip(self, positions: FloatArray) -> FloatArray:
        """Return the tip (..., 3), m, of axes (..., axes) in the robot's order."""
        return tip_position(self.chain, self.chain.joints_of(positions))

    def swept(self, low: FloatArray, high: FloatArray) -> Box:
        """Return the box that the tip stays in while axes are anywhere between (axes,) bounds."""
        joints = (self.chain.joints_of(each) for each in (low, high))
        lower, upper = joints
        return Workspace.of(replace(self.chain, lower=lower, upper=upper)).hull

    def excess(self, box: Box) -> Excess:
        """Return how far a tip that is anywhere in a box may be beyond each bound."""
        return Excess(
            self.low - float(box.low[2]),
            float(box.high[2]) - self.high,
            self._farthest(box) - self.radius,
        )

    def check_sweep(self, low: FloatArray, high: FloatArray) -> Box:
        """Return :meth:`swept`; refuse if the path may leave the bounds.

        Raises
        ------
        OutOfLimitsError
            With what is left, by how much, and what to do.
        """
        box = self.swept(low, high)
        self._refuse(
            float(box.low[2]),
            float(box.high[2]),
            self._farthest(box),
            message("engine", "on the way"),
        )
        return box

    def beyond(self, present: Box) -> Self:
        """Return bounds widened to the present positions."""
        low, high = float(present.low[2]), float(present.high[2])
        return replace(
            self,
            floor=min(self.floor, low),
            objective=(min(self.objective[0], low), max(self.objective[1], high)),
            radius=max(self.radius, self._farthest(present)),
        )

    def check_path(self, positions: FloatArray, time_s: FloatArray) -> None:
        """Refuse a path (n, axes) that leaves the bounds, or dives through the slow zone.

        Raises
        ------
        OutOfLimitsError
            With the time of the first row that does.
        """
        if not self.bounded:
            return
        tip = self.tip(positions)
        wrong = self.outside(tip)
        if wrong.any():
            row = int(np.argmax(wrong))
            height, away = float(tip[row, 2]), float(self._away(tip[row]))
            when = message("engine", "at {time} s").fill(time=float(time_s[row] - time_s[0]))
            self._refuse(height, height, away, when)
        self._check_speed(tip[:, 2], time_s)

    def outside(self, tips: FloatArray) -> BoolArray:
        """Return which of the tips (n, 3), m, are outside the bounds."""
        return (
            (tips[:, 2] < self.low - _SLACK)
            | (tips[:, 2] > self.high + _SLACK)
            | (self._away(tips) > self.radius + _SLACK)
        )

    @property
    def middle(self) -> FloatArray:
        """The tip (3,), m, in the middle of the workspace, on the axis of the cylinder."""
        return tip_position(self.chain, self.chain.centre)

    def _away(self, tips: FloatArray) -> FloatArray:
        """Return how far tips (..., 3) are from that axis, m."""
        away = tips - self.middle
        return np.hypot(away[..., 0], away[..., 1])

    def _farthest(self, box: Box) -> float:
        ends = np.maximum(np.abs(box.low - self.middle), np.abs(box.high - self.middle))
        return float(np.hypot(*ends[:2]))

    def _check_speed(self, height: FloatArray, time_s: FloatArray) -> None:
        """Refuse to go down faster than allowed close above the floor.

        A row lasts until the next one, so a whole step counts over the time before it.
        """
        down = -np.diff(height) / np.diff(time_s)
        close = height[1:] - self.low < SLOW_HEIGHT
        too_fast = close & (down > SLOW_SPEED * (1.0 + 1e-6))
        if too_fast.any():
            row = int(np.argmax(too_fast))
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: descends at {speed} at {time} s, {height} high; within {near} of "
                    "its floor {floor} the limit is {most}: make the approach slower",
                ).fill(
                    speed=exact(float(down[row]), "m/s"),
                    time=rounded(time_s[row + 1] - time_s[0], 6),
                    height=exact(float(height[row + 1]), "m"),
                    near=exact(SLOW_HEIGHT, "m"),
                    floor=exact(self.low, "m"),
                    most=exact(SLOW_SPEED, "m/s"),
                )
            )

    def _refuse(self, lowest: float, highest: float, away: float, where: str) -> None:
        if lowest < self.floor - _SLACK:
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: {lowest} high {where}, but its floor is {floor}; move elsewhere "
                    "first, or teach the floor",
                ).fill(lowest=exact(lowest, "m"), where=where, floor=exact(self.floor, "m"))
            )
        if lowest < self.low - _SLACK:
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: {lowest} high {where}, but its floor is {low}, where the objective "
                    "is; stay above it",
                ).fill(lowest=exact(lowest, "m"), where=where, low=exact(self.low, "m"))
            )
        if highest > self.high + _SLACK:
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: {highest} high {where}, but the objective is at {high}; stay below it",
                ).fill(highest=exact(highest, "m"), where=where, high=exact(self.high, "m"))
            )
        if away > self.radius + _SLACK:
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: {away} from the middle {where}, but at most {radius} is permitted; "
                    "move one axis after the other, or less far",
                ).fill(away=exact(away, "m"), where=where, radius=exact(self.radius, "m"))
            )
