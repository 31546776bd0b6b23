"""The keep-out zone: the tip stays above a floor, within a radius, and clear of the objective.

The ranges of the axes do not protect a 40 mm pin above a dish. The permitted region is an upright
cylinder about the middle of the workspace. It is convex, so every straight line between two
permitted tip positions is permitted too. When axes move independently, the region that the tip
sweeps is bounded by a box in the same way as the workspace.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.errors import ChainError, OutOfLimitsError
from rotemina.sim.kinematics.chain import KinematicChain
from rotemina.sim.kinematics.forward import compute_tip_position
from rotemina.sim.kinematics.workspace import PositionBox, TipWorkspace
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact

# In the slow zone, up to this height above the floor, the tip may descend only at limited speed.
SLOW_ZONE_HEIGHT_M = 0.5e-3
MAX_SLOW_ZONE_SPEED_M_PER_S = 0.5e-3
# Distance beyond a bound that is attributed to rounding.
_ROUNDING_SLACK_M = 1e-9


class TipExcess(NamedTuple):
    """Distances, m, by which a tip is beyond each bound; 0 or less inside.

    ``below``: below the floor, or below an objective underneath. ``above``: above an objective
    overhead. ``aside``: outside the cylinder.
    """

    below: float
    above: float
    aside: float

    @property
    def is_outside(self) -> bool:
        """Whether the tip is beyond a bound."""
        return max(self) > _ROUNDING_SLACK_M


@dataclass(frozen=True, slots=True, eq=False)
class KeepOutZone:
    """Bounds of the tip of one robot. Make an instance by :meth:`of`.

    Floor and objective are independent bounds: teaching or removing the floor keeps the objective.

    Attributes
    ----------
    chain : KinematicChain
    floor : float
        Minimum height of the tip, m; -inf without a floor.
    objective : (low, high) of float
        Heights, m, between which the tip is clear of the objective. If the robot file places the
        objective above the floor (above the middle of the workspace if there is no floor), it
        bounds the tip from above; otherwise from below, as in an inverted microscope. Infinite on
        the free side.
    radius : float
        Maximum distance, m, from the upright axis through the middle of the workspace.
    """

    chain: KinematicChain
    floor: float
    objective: tuple[float, float]
    radius: float

    @classmethod
    def of(cls, robot: Robot) -> Self | None:
        """Return the bounds given in a robot file, or None if the robot has no tip.

        Raises
        ------
        ChainError
            If the file bounds the tip but the robot has none.
        """
        section = robot.keep_out
        has_bounds = (section.floor, section.radius, section.objective) != (None, None, None)
        try:
            chain = KinematicChain.of(robot)
        except ChainError as error:
            if has_bounds:
                raise ChainError(
                    "{error}; [keep_out] needs a tip to limit", error=str(error)
                ) from error
            return None
        objective = (-np.inf, np.inf)
        if section.objective is not None:
            middle = float(compute_tip_position(chain, chain.centre)[2])
            is_above = section.objective > (middle if section.floor is None else section.floor)
            objective = (-np.inf, section.objective) if is_above else (section.objective, np.inf)
        floor = -np.inf if section.floor is None else section.floor
        radius = np.inf if section.radius is None else section.radius
        return cls(chain, float(floor), objective, float(radius))

    @property
    def low(self) -> float:
        """Minimum height, m, from floor and objective together."""
        return max(self.floor, self.objective[0])

    @property
    def high(self) -> float:
        """Maximum height, m, from the objective."""
        return self.objective[1]

    @property
    def is_bounded(self) -> bool:
        """Whether floor, objective or radius bound the tip."""
        return bool(np.isfinite([self.low, self.high, self.radius]).any())

    def with_floor(self, floor: float | None) -> Self:
        """Return the bounds with another floor, m, or without a floor for None.

        Raises
        ------
        OutOfLimitsError
            If the tip cannot reach the floor, or the floor leaves no room below the objective.
        """
        if floor is None:
            return replace(self, floor=-np.inf)
        reachable_box = TipWorkspace.of(self.chain).hull
        low, high = float(reachable_box.low[2]), min(float(reachable_box.high[2]), self.high)
        if not low - _ROUNDING_SLACK_M <= floor <= high + _ROUNDING_SLACK_M:
            raise OutOfLimitsError(
                "tip: floor {floor} mm: must be between {low} and {high}, within the "
                "reach of the tip; teach it where the tip touches",
                floor=format_rounded(1e3 * floor, 6),
                low=format_exact(low, "m"),
                high=format_exact(high, "m"),
            )
        return replace(self, floor=float(floor))

    def tip_at(self, positions: FloatArray) -> FloatArray:
        """Return the tip (..., 3), m, at positions (..., axes) in the robot's order."""
        return compute_tip_position(self.chain, self.chain.select_joints(positions))

    def find_swept_box(self, low: FloatArray, high: FloatArray) -> PositionBox:
        """Return the box that contains the tip while axes are between two bounds (axes,)."""
        lower, upper = (self.chain.select_joints(bound) for bound in (low, high))
        return TipWorkspace.of(replace(self.chain, lower=lower, upper=upper)).hull

    def measure_excess(self, box: PositionBox) -> TipExcess:
        """Return the largest distances by which a tip inside a box may be beyond each bound."""
        return TipExcess(
            self.low - float(box.low[2]),
            float(box.high[2]) - self.high,
            self._max_axis_distance(box) - self.radius,
        )

    def check_sweep(self, low: FloatArray, high: FloatArray) -> PositionBox:
        """Return the box of :meth:`find_swept_box` after checking that it is within the bounds.

        Raises
        ------
        OutOfLimitsError
            If the tip may leave the bounds. The message says which one, by how much, and what to
            do.
        """
        box = self.find_swept_box(low, high)
        self._check_bounds(
            float(box.low[2]),
            float(box.high[2]),
            self._max_axis_distance(box),
            message("engine", "on the way"),
        )
        return box

    def widen_to(self, current: PositionBox) -> Self:
        """Return the bounds widened so that they contain the box of current positions."""
        low, high = float(current.low[2]), float(current.high[2])
        return replace(
            self,
            floor=min(self.floor, low),
            objective=(min(self.objective[0], low), max(self.objective[1], high)),
            radius=max(self.radius, self._max_axis_distance(current)),
        )

    def check_path(self, positions: FloatArray, time_s: FloatArray) -> None:
        """Check that a path (n, axes) stays within the bounds and descends slowly near the floor.

        Raises
        ------
        OutOfLimitsError
            If it does not. The message names the time of the first row.
        """
        if not self.is_bounded:
            return
        tip = self.tip_at(positions)
        is_outside = self.find_outside(tip)
        if is_outside.any():
            row = int(np.argmax(is_outside))
            height, distance = float(tip[row, 2]), float(self._axis_distance(tip[row]))
            time_text = message("engine", "at {time} s").fill(time=float(time_s[row] - time_s[0]))
            self._check_bounds(height, height, distance, time_text)
        self._check_speed(tip[:, 2], time_s)

    def find_outside(self, tips: FloatArray) -> BoolArray:
        """Return which of the tips (n, 3), m, are outside the bounds, (n,)."""
        return (
            (tips[:, 2] < self.low - _ROUNDING_SLACK_M)
            | (tips[:, 2] > self.high + _ROUNDING_SLACK_M)
            | (self._axis_distance(tips) > self.radius + _ROUNDING_SLACK_M)
        )

    @property
    def middle(self) -> FloatArray:
        """The tip (3,), m, in the middle of the workspace. The axis of the cylinder contains it."""
        return compute_tip_position(self.chain, self.chain.centre)

    def _axis_distance(self, tips: FloatArray) -> FloatArray:
        offset = tips - self.middle
        return np.hypot(offset[..., 0], offset[..., 1])

    def _max_axis_distance(self, box: PositionBox) -> float:
        farthest_corner = np.maximum(np.abs(box.low - self.middle), np.abs(box.high - self.middle))
        return float(np.hypot(*farthest_corner[:2]))

    def _check_speed(self, height: FloatArray, time_s: FloatArray) -> None:
        """Check that the tip descends no faster than permitted close above the floor.

        A row is held until the next one, so a step counts over the time before it.
        """
        descent_speed = -np.diff(height) / np.diff(time_s)
        is_close = height[1:] - self.low < SLOW_ZONE_HEIGHT_M
        is_too_fast = is_close & (descent_speed > MAX_SLOW_ZONE_SPEED_M_PER_S * (1.0 + 1e-6))
        if is_too_fast.any():
            row = int(np.argmax(is_too_fast))
            raise OutOfLimitsError(
                "tip: descends at {speed} at {time} s, {height} high; within {near} of "
                "its floor {floor} the limit is {most}: make the approach slower",
                speed=format_exact(float(descent_speed[row]), "m/s"),
                time=format_rounded(time_s[row + 1] - time_s[0], 6),
                height=format_exact(float(height[row + 1]), "m"),
                near=format_exact(SLOW_ZONE_HEIGHT_M, "m"),
                floor=format_exact(self.low, "m"),
                most=format_exact(MAX_SLOW_ZONE_SPEED_M_PER_S, "m/s"),
            )

    def _check_bounds(
        self, lowest: float, highest: float, distance: float, where_text: str
    ) -> None:
        if lowest < self.floor - _ROUNDING_SLACK_M:
            raise OutOfLimitsError(
                "tip: {lowest} high {where}, but its floor is {floor}; move elsewhere "
                "first, or teach the floor",
                lowest=format_exact(lowest, "m"),
                where=where_text,
                floor=format_exact(self.floor, "m"),
            )
        if lowest < self.low - _ROUNDING_SLACK_M:
            raise OutOfLimitsError(
                "tip: {lowest} high {where}, but its floor is {low}, where the objective "
                "is; stay above it",
                lowest=format_exact(lowest, "m"),
                where=where_text,
                low=format_exact(self.low, "m"),
            )
        if highest > self.high + _ROUNDING_SLACK_M:
            raise OutOfLimitsError(
                "tip: {highest} high {where}, but the objective is at {high}; stay below it",
                highest=format_exact(highest, "m"),
                where=where_text,
                high=format_exact(self.high, "m"),
            )
        if distance > self.radius + _ROUNDING_SLACK_M:
            raise OutOfLimitsError(
                "tip: {away} from the middle {where}, but at most {radius} is permitted; "
                "move one axis after the other, or less far",
                away=format_exact(distance, "m"),
                where=where_text,
                radius=format_exact(self.radius, "m"),
            )
