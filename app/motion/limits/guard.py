"""Limits that every motion request must respect: ranges, speeds, and the bounds of the tip."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.app.motion.limits.position_envelope import (
    PositionEnvelope,
    describe_tip_excess,
    is_return_move,
)
from rotemina.app.motion.limits.ranges import (
    NO_NARROWED_RANGES,
    Range,
    Ranges,
    check_within,
    compute_stoppable_speed,
    intersect_ranges,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.kinematics import (
    MAX_SLOW_ZONE_SPEED_M_PER_S,
    SLOW_ZONE_HEIGHT_M,
    KeepOutZone,
    TipExcess,
)
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import CheckedTrajectory, check_target, commands_of
from rotemina.sim.units import format_exact

# A longer motion than this cannot be the thrust of a piezo axis into a cell.
MAX_THRUST_M = 1e-4
# Speed at which the tip moves back into its bounds.
RETURN_SPEED_M_PER_S = MAX_SLOW_ZONE_SPEED_M_PER_S
# Longest time from the end of a lease until the axis begins to brake.
_MAX_REACTION_S = 0.05
# Velocities near the tip's bounds are halved until they are safe, at most seven times.
_SPEED_SCALES = tuple(0.5**halvings for halvings in range(8))
# Axes that move the tip up and down.
_VERTICAL_AXES = ("z", "zn")


@dataclass(frozen=True, slots=True)
class PathSegment:
    """One part of a move: targets, m or rad, and the speed limits of axes that have one."""

    targets: Mapping[str, float]
    speeds: Mapping[str, float]

    def with_speed_limits(self, speeds: Mapping[str, float]) -> "PathSegment":
        """Return the segment with these additional speed limits."""
        limits = {axis: limit for axis, limit in speeds.items() if axis in self.targets}
        reduced_limits = {
            axis: min(limit, self.speeds.get(axis, limit)) for axis, limit in limits.items()
        }
        return PathSegment(self.targets, {**self.speeds, **reduced_limits})


class TipPath(NamedTuple):
    """The path of the tip along a trajectory.

    Attributes
    ----------
    start_position : (3,)
        Position when the path was computed, m.
    rows : (n, 3)
        Position at each row, m.
    zone : KeepOutZone
        Bounds of the tip.
    """

    start_position: FloatArray
    rows: FloatArray
    zone: KeepOutZone


class Guard:
    """Checks motion requests against the limits of one robot.

    Parameters
    ----------
    robot : Robot
        Its ``[keep_out]`` table bounds the tip until another floor is taught.

    Raises
    ------
    ChainError
        If the robot file sets bounds for a tip, but the robot has no tip.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._axes = tuple(robot.axes)
        #: The bounds of the tip; None if the robot has no tip.
        self.zone = KeepOutZone.of(robot)
        #: The ranges of narrowed axes, replaced as a whole.
        self.narrowed_ranges = NO_NARROWED_RANGES

    def teach_floor(self, floor: float | None) -> None:
        """Set the tip's floor at a height, m, or remove it.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip, or its tip cannot reach this height.
        """
        if self.zone is None:
            raise OutOfLimitsError(
                "robot {name} has no tip for a floor to limit", name=repr(self._robot.name)
            )
        self.zone = self.zone.with_floor(floor)

    def compute_envelope(
        self, deviation: FloatArray | None, *commands: Mapping[str, float]
    ) -> PositionEnvelope:
        """Return bounds of the positions of all axes, from all commands that may act.

        An axis that no command names may be anywhere in its range. ``deviation`` (axes,) is the
        deviation of the readings from the commands, see :attr:`PositionEnvelope.deviation`; None
        means that they agree.
        """
        low, high = np.array([axis.range for axis in self._robot.axes.values()]).T
        for column, axis in enumerate(self._axes):
            values = [float(command[axis]) for command in commands if axis in command]
            if values:
                low[column], high[column] = min(values), max(values)
        return PositionEnvelope(
            low, high, np.zeros(len(self._axes)) if deviation is None else deviation
        )

    def plan_move(
        self, envelope: PositionEnvelope, targets: Mapping[str, float], *, confirmed: bool = False
    ) -> tuple[PathSegment, ...]:
        """Return the segments of a move: direct, or slower close above the floor.

        If the tip is out of its bounds, by command or by reading, it moves only if the operator has
        ``confirmed`` the move. Then it moves slowly, and only with axes that bring it nearer.

        Raises
        ------
        OutOfLimitsError
            If a target is beyond its range, or the tip might leave its bounds on the way.
        """
        for axis, position in targets.items():
            check_target(self._robot, axis, position)
        check_within(self._robot, self.narrowed_ranges, targets.items())
        zone = self.zone
        if zone is None or not zone.is_bounded:
            return (PathSegment(targets, {}),)
        if (excess := self._find_excess(zone, envelope)) is not None:
            return (self._plan_return(zone, envelope, targets, excess, confirmed=confirmed),)
        end_positions = {self._axes.index(axis): target for axis, target in targets.items()}
        lowest_tip = self._find_lowest_tip(zone, envelope.with_positions(end_positions))
        slow_zone_top = zone.low + SLOW_ZONE_HEIGHT_M
        # Only axes that lower the tip have to slow down.
        lowering_targets = {
            axis: target
            for axis, target in targets.items()
            if axis in _VERTICAL_AXES and target < envelope.high[self._axes.index(axis)]
        }
        if lowest_tip >= slow_zone_top or not lowering_targets:
            return (PathSegment(targets, {}),)
        return self._split_at_slow_zone(envelope, targets, lowering_targets, lowest_tip - zone.low)

    def _find_lowest_tip(self, zone: KeepOutZone, swept: PositionEnvelope) -> float:
        """Return the lowest height of the tip in an envelope, m.

        Raises
        ------
        OutOfLimitsError
            If the tip could leave its bounds.
        """
        return min(float(zone.check_sweep(*bounds).low[2]) for bounds in swept.iterate_bounds())

    def _find_excess(self, zone: KeepOutZone, envelope: PositionEnvelope) -> TipExcess | None:
        excesses = [
            zone.measure_excess(zone.find_swept_box(*bounds))
            for bounds in envelope.iterate_bounds()
        ]
        worst = TipExcess(*np.max(excesses, axis=0).tolist())
        return worst if worst.is_outside else None

    def _refuse_if_tip_outside(self, zone: KeepOutZone, envelope: PositionEnvelope) -> None:
        if (excess := self._find_excess(zone, envelope)) is not None:
            raise OutOfLimitsError(describe_tip_excess(excess))

    def _plan_return(
        self,
        zone: KeepOutZone,
        envelope: PositionEnvelope,
        targets: Mapping[str, float],
        excess: TipExcess,
        *,
        confirmed: bool,
    ) -> PathSegment:
        """Return the path that brings a tip back into its bounds; refuse any other move."""
        if not confirmed:
            raise OutOfLimitsError(describe_tip_excess(excess))
        end_positions = {self._axes.index(axis): target for axis, target in targets.items()}
        for column, target in end_positions.items():
            if not is_return_move(zone, envelope, column, target, excess):
                raise OutOfLimitsError(
                    "{out}; axis {axes} does not bring it back in this direction",
                    out=describe_tip_excess(excess),
                    axes=self._axes[column],
                )
        # Widen the bounds to the current position of the tip, so that only moves farther out are
        # refused.
        for swept_bounds, current_bounds in zip(
            envelope.with_positions(end_positions).iterate_bounds(),
            envelope.iterate_bounds(),
            strict=True,
        ):
            zone.widen_to(zone.find_swept_box(*current_bounds)).check_sweep(*swept_bounds)
        # Several axes may move at once: together they must not exceed the return speed.
        tip_speed = RETURN_SPEED_M_PER_S / len(targets)
        lever_arms = {
            axis: zone.chain.pin_length for axis in targets if self._robot.unit(axis) == "rad"
        }
        return PathSegment(
            targets, {axis: tip_speed / lever_arms.get(axis, 1.0) for axis in targets}
        )

    def _split_at_slow_zone(
        self,
        envelope: PositionEnvelope,
        targets: Mapping[str, float],
        lowering_targets: Mapping[str, float],
        height: float,
    ) -> tuple[PathSegment, ...]:
        """Return a fast segment down to the slow zone, and a slow one from there on.

        ``height`` is the lowest height of the tip above its floor during the move, m.
        """
        slow_speeds = dict.fromkeys(
            lowering_targets, MAX_SLOW_ZONE_SPEED_M_PER_S / len(lowering_targets)
        )
        # Only z can be stopped where the tip enters the slow zone; other axes move slowly all the
        # way.
        zone_entry = targets.get("z", np.inf) + SLOW_ZONE_HEIGHT_M - height
        if "z" not in lowering_targets or zone_entry >= envelope.low[self._axes.index("z")]:
            return (PathSegment(targets, slow_speeds),)
        return (
            PathSegment({**targets, "z": zone_entry}, {}),
            PathSegment({"z": targets["z"]}, slow_speeds),
        )

    def check_profile(
        self,
        envelope: PositionEnvelope,
        axis: str,
        ends: tuple[float, float],
        speed: float,
        *,
        thrust: bool,
    ) -> None:
        """Refuse a profile of one axis that would endanger the tip.

        ``ends`` are the lowest and highest position of the profile, m or rad.

        A ``thrust`` may be faster than the slow zone permits, but at most :data:`MAX_THRUST_M`
        long. No profile may take the tip out of its bounds.

        Raises
        ------
        OutOfLimitsError
            If a limit would be exceeded. The message names it.
        """
        for end in ends:
            check_target(self._robot, axis, end)
        check_within(self._robot, self.narrowed_ranges, ((axis, end) for end in ends))
        zone = self.zone
        if zone is None or not zone.is_bounded:
            return
        self._refuse_if_tip_outside(zone, envelope)
        column = self._axes.index(axis)
        lowest_tip = self._find_lowest_tip(
            zone, envelope.with_positions({column: ends[0]}).with_positions({column: ends[1]})
        )
        if (
            axis not in _VERTICAL_AXES
            or lowest_tip >= zone.low + SLOW_ZONE_HEIGHT_M
            or speed <= MAX_SLOW_ZONE_SPEED_M_PER_S
        ):
            return
        if not thrust:
            raise OutOfLimitsError(
                "tip: the profile moves at {speed} within {height} of the floor, where "
                "{most} is the limit; only an armed penetration may be faster",
                speed=format_exact(speed, "m/s"),
                height=format_exact(SLOW_ZONE_HEIGHT_M, "m"),
                most=format_exact(MAX_SLOW_ZONE_SPEED_M_PER_S, "m/s"),
            )
        if ends[1] - ends[0] > MAX_THRUST_M * (1.0 + 1e-9):
            raise OutOfLimitsError(
                "tip: a thrust of {way} within {height} of the floor exceeds the limit of {most}",
                way=format_exact(ends[1] - ends[0], "m"),
                height=format_exact(SLOW_ZONE_HEIGHT_M, "m"),
                most=format_exact(MAX_THRUST_M, "m"),
            )

    def limit_velocities(
        self,
        envelope: PositionEnvelope,
        velocities: Mapping[str, float],
        lease_s: float,
        ranges: Ranges = NO_NARROWED_RANGES,
    ) -> dict[str, float]:
        """Return the velocities, reduced by one common factor near the tip's bounds.

        No device stops by itself at the ends of narrowed ranges, or of the additional ``ranges``, m
        or rad. An axis therefore slows down as it approaches such an end.

        Raises
        ------
        OutOfLimitsError
            If the tip could leave its bounds within the lease even at the lowest speed.
        """
        end_ranges = intersect_ranges(self.narrowed_ranges, ranges)
        velocities = {
            axis: self._limit_speed_before_end(envelope, axis, speed, lease_s, end_ranges.get(axis))
            for axis, speed in velocities.items()
        }
        zone = self.zone
        if zone is None or not zone.is_bounded:
            return velocities
        self._refuse_if_tip_outside(zone, envelope)
        refusal: OutOfLimitsError | None = None
        for scale in _SPEED_SCALES:
            scaled_velocities = {axis: scale * speed for axis, speed in velocities.items()}
            end_positions = {
                self._axes.index(axis): self._find_lease_end(envelope, axis, speed, lease_s)
                for axis, speed in scaled_velocities.items()
            }
            try:
                lowest_tip = self._find_lowest_tip(zone, envelope.with_positions(end_positions))
            except OutOfLimitsError as error:
                refusal = error
                continue
            # Close above the floor only the downward speed is limited.
            downward_speed = -sum(
                min(scaled_velocities.get(axis, 0.0), 0.0) for axis in _VERTICAL_AXES
            )
            if (
                lowest_tip >= zone.low + SLOW_ZONE_HEIGHT_M
                or downward_speed <= MAX_SLOW_ZONE_SPEED_M_PER_S
            ):
                return scaled_velocities
        if refusal is None:
            raise OutOfLimitsError("tip: too fast this close to its floor; move more slowly")
        raise refusal

    def compute_travels(self, velocities: Mapping[str, float], lease_s: float) -> dict[str, float]:
        """Return how far each axis still moves, m or rad, if the lease is not renewed.

        This includes braking and the delay before it. With a lease of 0 only these two remain.
        """
        return {
            axis: self._compute_travel(axis, speed, lease_s) for axis, speed in velocities.items()
        }

    def _find_lease_end(
        self, envelope: PositionEnvelope, axis: str, speed: float, lease_s: float
    ) -> float:
        column = self._axes.index(axis)
        # The axis may be anywhere in its envelope, so start from the end that leads farthest.
        start = envelope.high[column] if speed > 0.0 else envelope.low[column]
        end = start + self._compute_travel(axis, speed, lease_s)
        return float(np.clip(end, *self._robot.axes[axis].range))

    def _limit_speed_before_end(
        self,
        envelope: PositionEnvelope,
        axis: str,
        speed: float,
        lease_s: float,
        ends: Range | None,
    ) -> float:
        """Return the speed, reduced so that the axis can stop before an end of its range.

        The lease and the braking distance are included.
        """
        if ends is None:
            return speed
        column = self._axes.index(axis)
        distance = (
            ends[1] - envelope.high[column] if speed > 0.0 else envelope.low[column] - ends[0]
        )
        deceleration = self._robot.axes[axis].max_acceleration
        max_speed = compute_stoppable_speed(
            float(distance), lease_s + _MAX_REACTION_S, deceleration
        )
        return float(np.copysign(min(abs(speed), max_speed), speed))

    def _compute_travel(self, axis: str, speed: float, lease_s: float) -> float:
        max_acceleration = self._robot.axes[axis].max_acceleration
        braking_distance = speed**2 / (2.0 * max_acceleration) if max_acceleration else 0.0
        return float(
            np.copysign(abs(speed) * (lease_s + _MAX_REACTION_S) + braking_distance, speed)
        )

    def check_trajectory(self, envelope: PositionEnvelope, trajectory: CheckedTrajectory) -> None:
        """Refuse a trajectory if it, or the move to its start, takes the tip out of its bounds.

        Raises
        ------
        OutOfLimitsError
            If the tip would leave its bounds. The message names the time and the bound.
        """
        zone = self.zone
        if zone is None or not zone.is_bounded:
            return
        self._refuse_if_tip_outside(zone, envelope)
        commands = trajectory.commands
        positions = self._find_positions(envelope, commands)
        columns = map(self._axes.index, commands.axes)
        start_positions = {column: float(positions[0, column]) for column in columns}
        self._find_lowest_tip(zone, envelope.with_positions(start_positions))
        zone.check_path(positions, commands.time_s)
        if envelope.deviation.any():
            zone.check_path(positions + envelope.deviation, commands.time_s)

    def compute_tip_path(self, envelope: PositionEnvelope, commands: Record) -> TipPath | None:
        """Return the path of the tip along a trajectory, or None if the robot has no tip."""
        if self.zone is None:
            return None
        current_position = 0.5 * (envelope.low + envelope.high)
        tip_positions = self.zone.tip_at(
            np.vstack((current_position, self._find_positions(envelope, commands)))
        )
        return TipPath(tip_positions[0], tip_positions[1:], self.zone)

    def _find_positions(self, envelope: PositionEnvelope, commands: Record) -> FloatArray:
        """Return the positions (n, axes) at each row. Axes without commands do not move."""
        positions = np.tile(0.5 * (envelope.low + envelope.high), (len(commands.time_s), 1))
        for axis, signal in commands_of(self._robot, commands).items():
            positions[:, self._axes.index(axis)] = signal
        return positions
