"""Limits of every request: ranges, speeds, and the keep-out of the tip."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.app.motion.position_envelope import PositionEnvelope
from rotemina.app.motion.ranges import (
    WHOLE,
    Range,
    Ranges,
    check_within,
    speed_before,
    within,
)
from rotemina.app.motion.tip_return import nearer, out_text
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.keep_out import SLOW_HEIGHT, SLOW_SPEED, Excess, KeepOutZone
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError, check_target
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory
from rotemina.sim.trajectory.trajectory_excesses import commands_of

MOST_THRUST = 1e-4  # m: beyond a piezo's way it is no thrust into a cell
RETURN_SPEED = SLOW_SPEED  # m/s of the tip on its way back into its bounds
_REACTION_S = 0.05  # between a lease's end and the axis' first braking, at most
_SCALES = tuple(0.5**halvings for halvings in range(8))
_LIFTING = ("z", "zn")  # axes that move the tip up and down


@dataclass(frozen=True, slots=True)
class PathSegment:
    """One part of a move: targets, m or rad, and the axes' greatest speeds on it, where bounded."""

    targets: Mapping[str, float]
    speeds: Mapping[str, float]

    def no_faster(self, speeds: Mapping[str, float]) -> "PathSegment":
        """Return the segment with its axes bounded by these speeds too."""
        bounds = {axis: most for axis, most in speeds.items() if axis in self.targets}
        slower = {axis: min(most, self.speeds.get(axis, most)) for axis, most in bounds.items()}
        return PathSegment(self.targets, {**self.speeds, **slower})


class TipPath(NamedTuple):
    """A trajectory as the tip goes: from ``now`` (3,) by ``rows`` (n, 3), m, within ``zone``."""

    now: FloatArray
    rows: FloatArray
    zone: KeepOutZone


class Guard:
    """The limits of one robot, on every path.

    Parameters
    ----------
    robot : Robot
        Its ``[keep_out]`` bounds the tip until another floor is taught.

    Raises
    ------
    ChainError
        If the file bounds the tip of a robot that has none.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._axes = tuple(robot.axes)
        self._offset = np.array([axis.offset for axis in robot.axes.values()])
        #: The tip's bounds; None where there is no tip.
        self.zone = KeepOutZone.of(robot)
        #: To what ranges of axes were narrowed; replaced as a whole.
        self.narrowed = WHOLE

    def teach_floor(self, floor: float | None) -> None:
        """Set the tip's floor at a height, m, or remove it.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip, or the height is none that it can have.
        """
        if self.zone is None:
            raise OutOfLimitsError(
                message("engine", "robot {name} has no tip for a floor to limit").fill(
                    name=repr(self._robot.name)
                )
            )
        self.zone = self.zone.taught(floor)

    def envelope(
        self, deviation: FloatArray | None, *commands: Mapping[str, float]
    ) -> PositionEnvelope:
        """Return bounds of all commands that may act, for all axes.

        An axis without information may be anywhere in its range. ``deviation`` (axes,) is that of
        the readings, as :attr:`PositionEnvelope.deviation`; None: readings agree with commands.
        """
        low, high = np.array([axis.range for axis in self._robot.axes.values()]).T
        for column, axis in enumerate(self._axes):
            known = [float(each[axis]) for each in commands if axis in each]
            if known:
                low[column], high[column] = min(known), max(known)
        return PositionEnvelope(
            low, high, np.zeros(len(self._axes)) if deviation is None else deviation
        )

    def move(
        self, envelope: PositionEnvelope, targets: Mapping[str, float], *, confirmed: bool = False
    ) -> tuple[PathSegment, ...]:
        """Return the segments of a move: direct, or slower close above the floor.

        A tip that is out of its bounds, as commanded or as read, moves only if that is
        ``confirmed``, only by axes that each bring it nearer, and slowly.

        Raises
        ------
        OutOfLimitsError
            If a target is beyond its range, or the tip might leave its bounds on the way.
        """
        for axis, position in targets.items():
            check_target(self._robot, axis, position)
        check_within(self._robot, self.narrowed, targets.items())
        zone = self.zone
        if zone is None or not zone.bounded:
            return (PathSegment(targets, {}),)
        if (out := self._out(zone, envelope)) is not None:
            return (self._back_in(zone, envelope, targets, out, confirmed=confirmed),)
        end = {self._axes.index(axis): at for axis, at in targets.items()}
        lowest = self._lowest(zone, envelope.widened(end))
        top = zone.low + SLOW_HEIGHT
        lowering = {
            axis: at
            for axis, at in targets.items()
            if axis in _LIFTING and at < envelope.high[self._axes.index(axis)]
        }
        if lowest >= top or not lowering:
            return (PathSegment(targets, {}),)
        return self._in_two(envelope, targets, lowering, lowest - zone.low)

    def _lowest(self, zone: KeepOutZone, swept: PositionEnvelope) -> float:
        """Return the least height of the tip on a way; refuse one out of the bounds."""
        return min(float(zone.check_sweep(*bounds).low[2]) for bounds in swept.seen())

    def _out(self, zone: KeepOutZone, envelope: PositionEnvelope) -> Excess | None:
        """Return by how much the tip is out of its bounds, where it is."""
        each = [zone.excess(zone.swept(*bounds)) for bounds in envelope.seen()]
        worst = Excess(*np.max(each, axis=0).tolist())
        return worst if worst.any else None

    def _refuse_if_out(self, zone: KeepOutZone, envelope: PositionEnvelope) -> None:
        if (out := self._out(zone, envelope)) is not None:
            raise OutOfLimitsError(out_text(out))

    def _back_in(
        self,
        zone: KeepOutZone,
        envelope: PositionEnvelope,
        targets: Mapping[str, float],
        out: Excess,
        *,
        confirmed: bool,
    ) -> PathSegment:
        """Return the way of a tip that is out of its bounds; refuse what leads anywhere else."""
        if not confirmed:
            raise OutOfLimitsError(out_text(out))
        end = {self._axes.index(axis): at for axis, at in targets.items()}
        for column, at in end.items():
            if not nearer(zone, envelope, column, at, out):
                raise OutOfLimitsError(
                    message(
                        "engine", "{out}; axis {axes} does not bring it nearer in this direction"
                    ).fill(out=out_text(out), axes=self._axes[column])
                )
        for bounds, present in zip(envelope.widened(end).seen(), envelope.seen(), strict=True):
            zone.beyond(zone.swept(*present)).check_sweep(*bounds)
        slowly = RETURN_SPEED / len(targets)
        arms = {axis: zone.chain.pin_length for axis in targets if self._robot.unit(axis) == "rad"}
        return PathSegment(targets, {axis: slowly / arms.get(axis, 1.0) for axis in targets})

    def _in_two(
        self,
        envelope: PositionEnvelope,
        targets: Mapping[str, float],
        lowering: Mapping[str, float],
        height: float,
    ) -> tuple[PathSegment, ...]:
        """Go at full speed as far as the slow zone, and slowly from there on.

        ``height`` is the tip's least above its floor on the way, m.
        """
        slowly = dict.fromkeys(lowering, SLOW_SPEED / len(lowering))
        raised = targets.get("z", np.inf) + SLOW_HEIGHT - height
        if "z" not in lowering or raised >= envelope.low[self._axes.index("z")]:
            return (PathSegment(targets, slowly),)
        return (PathSegment({**targets, "z": raised}, {}), PathSegment({"z": targets["z"]}, slowly))

    def profile(
        self,
        envelope: PositionEnvelope,
        axis: str,
        ends: tuple[float, float],
        speed: float,
        *,
        thrust: bool,
    ) -> None:
        """Refuse a profile of one axis, between ``ends``, m or rad, that the tip must not execute.

        A ``thrust`` may be faster than the slow zone permits, but at most :data:`MOST_THRUST` long;
        no profile may take the tip out of its bounds.

        Raises
        ------
        OutOfLimitsError
            With what is left, or the speed and the bound.
        """
        for end in ends:
            check_target(self._robot, axis, end)
        check_within(self._robot, self.narrowed, ((axis, end) for end in ends))
        zone = self.zone
        if zone is None or not zone.bounded:
            return
        self._refuse_if_out(zone, envelope)
        column = self._axes.index(axis)
        lowest = self._lowest(zone, envelope.widened({column: ends[0]}).widened({column: ends[1]}))
        if axis not in _LIFTING or lowest >= zone.low + SLOW_HEIGHT or speed <= SLOW_SPEED:
            return
        if not thrust:
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: the profile moves at {speed} within {height} of the floor, where "
                    "{most} is the limit; only an armed penetration may be faster",
                ).fill(
                    speed=exact(speed, "m/s"),
                    height=exact(SLOW_HEIGHT, "m"),
                    most=exact(SLOW_SPEED, "m/s"),
                )
            )
        if ends[1] - ends[0] > MOST_THRUST * (1.0 + 1e-9):
            raise OutOfLimitsError(
                message(
                    "engine",
                    "tip: a thrust of {way} within {height} of the floor exceeds the limit "
                    "of {most}",
                ).fill(
                    way=exact(ends[1] - ends[0], "m"),
                    height=exact(SLOW_HEIGHT, "m"),
                    most=exact(MOST_THRUST, "m"),
                )
            )

    def velocity(
        self,
        envelope: PositionEnvelope,
        velocities: Mapping[str, float],
        lease_s: float,
        ranges: Ranges = WHOLE,
    ) -> dict[str, float]:
        """Return the velocities, all reduced by one factor near the tip's bounds.

        No device stops on its own at narrowed ends, or at those of ``ranges``, m or rad: an axis
        slows down as it approaches one.

        Raises
        ------
        OutOfLimitsError
            If even the slowest could leave the bounds within the lease.
        """
        bounds = within(self.narrowed, ranges)
        velocities = {
            axis: self._before(envelope, axis, speed, lease_s, bounds.get(axis))
            for axis, speed in velocities.items()
        }
        zone = self.zone
        if zone is None or not zone.bounded:
            return velocities
        self._refuse_if_out(zone, envelope)
        refusal: OutOfLimitsError | None = None
        for scale in _SCALES:
            slower = {axis: scale * speed for axis, speed in velocities.items()}
            ends = {
                self._axes.index(axis): self._end(envelope, axis, speed, lease_s)
                for axis, speed in slower.items()
            }
            try:
                lowest = self._lowest(zone, envelope.widened(ends))
            except OutOfLimitsError as error:
                refusal = error
                continue
            down = -sum(min(slower.get(axis, 0.0), 0.0) for axis in _LIFTING)
            if lowest >= zone.low + SLOW_HEIGHT or down <= SLOW_SPEED:
                return slower
        if refusal is None:
            raise OutOfLimitsError(
                message("engine", "tip: too fast this close to its floor; move more slowly")
            )
        raise refusal

    def ways(self, velocities: Mapping[str, float], lease_s: float) -> dict[str, float]:
        """Return how far each axis still moves, m or rad, if nobody renews the lease.

        This includes braking and the delay before it; a lease of 0 leaves only those.
        """
        return {axis: self._way(axis, speed, lease_s) for axis, speed in velocities.items()}

    def _end(self, envelope: PositionEnvelope, axis: str, speed: float, lease_s: float) -> float:
        column = self._axes.index(axis)
        begin = envelope.high[column] if speed > 0.0 else envelope.low[column]
        end = begin + self._way(axis, speed, lease_s)
        return float(np.clip(end, *self._robot.axes[axis].range))

    def _before(
        self,
        envelope: PositionEnvelope,
        axis: str,
        speed: float,
        lease_s: float,
        ends: Range | None,
    ) -> float:
        """Return a speed from which an axis rests before an end, lease and braking counted."""
        if ends is None:
            return speed
        column = self._axes.index(axis)
        left = ends[1] - envelope.high[column] if speed > 0.0 else envelope.low[column] - ends[0]
        braking = self._robot.axes[axis].max_acceleration
        most = speed_before(float(left), lease_s + _REACTION_S, braking)
        return float(np.copysign(min(abs(speed), most), speed))

    def _way(self, axis: str, speed: float, lease_s: float) -> float:
        most = self._robot.axes[axis].max_acceleration
        braking = speed**2 / (2.0 * most) if most else 0.0
        return float(np.copysign(abs(speed) * (lease_s + _REACTION_S) + braking, speed))

    def play(self, envelope: PositionEnvelope, trajectory: CheckedTrajectory) -> None:
        """Refuse a trajectory if it, or the move to its start, takes the tip out of its bounds.

        Raises
        ------
        OutOfLimitsError
            With the time and what was left.
        """
        zone = self.zone
        if zone is None or not zone.bounded:
            return
        self._refuse_if_out(zone, envelope)
        commands = trajectory.commands
        positions = self._positions(envelope, commands)
        columns = map(self._axes.index, commands.axes)
        first = {column: float(positions[0, column]) for column in columns}
        self._lowest(zone, envelope.widened(first))
        zone.check_path(positions, commands.time_s)
        if envelope.deviation.any():
            zone.check_path(positions + envelope.deviation, commands.time_s)

    def tip_path(self, envelope: PositionEnvelope, commands: Record) -> TipPath | None:
        """Return where the tip would go by commands; None where there is no tip."""
        if self.zone is None:
            return None
        now = 0.5 * (envelope.low + envelope.high)
        tips = self.zone.tip(np.vstack((now, self._positions(envelope, commands))))
        return TipPath(tips[0], tips[1:], self.zone)

    def _positions(self, envelope: PositionEnvelope, commands: Record) -> FloatArray:
        """Return the axes (n, axes) at each row; axes without commands stay."""
        positions = np.tile(0.5 * (envelope.low + envelope.high), (len(commands.time_s), 1))
        for axis, signal in commands_of(self._robot, commands).items():
            positions[:, self._axes.index(axis)] = signal
        return positions
