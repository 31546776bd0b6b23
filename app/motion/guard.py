"""What stands between every request and the machine: ranges, speeds, and the tip's keep-out."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.keep_out import SLOW_HEIGHT, SLOW_SPEED, KeepOutZone
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.checked import CheckedTrajectory
from rotemina.sim.trajectory.limits import OutOfLimitsError, check_target, commands_of
from rotemina.sim.trajectory.wording import readable

MOST_THRUST = 1e-4  # m: what is beyond a piezo is no thrust into a cell
_REACTION_S = 0.05  # between a lease's end and the axis' first braking, at most
_SCALES = tuple(0.5**halvings for halvings in range(8))
_LIFTING = ("z", "zn")  # axes that move the tip up and down


class Place(NamedTuple):
    """Where the axes may be just now: bounds (axes,) about command, reading and last target."""

    low: FloatArray
    high: FloatArray

    def widened(self, columns: Mapping[int, float]) -> "Place":
        """Return the bounds with more values of some axes in them."""
        low, high = self.low.copy(), self.high.copy()
        for column, value in columns.items():
            low[column], high[column] = min(low[column], value), max(high[column], value)
        return Place(low, high)


@dataclass(frozen=True, slots=True)
class Leg:
    """One part of a move: targets, m or rad, and the axes' greatest speeds on it, where bounded."""

    targets: Mapping[str, float]
    speeds: Mapping[str, float]

    def no_faster(self, speeds: Mapping[str, float]) -> "Leg":
        """Return the leg with its axes bounded by these speeds too."""
        bounds = {axis: most for axis, most in speeds.items() if axis in self.targets}
        slower = {axis: min(most, self.speeds.get(axis, most)) for axis, most in bounds.items()}
        return Leg(self.targets, {**self.speeds, **slower})


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
        self._zone = KeepOutZone.of(robot)

    @property
    def zone(self) -> KeepOutZone | None:
        """The tip's bounds; None where there is no tip."""
        return self._zone

    def teach_floor(self, floor: float | None) -> None:
        """Put the tip's floor at a height, m, or take it away.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip.
        """
        if self._zone is None:
            raise OutOfLimitsError(f"robot {self._robot.name!r} has no tip that a floor could hold")
        self._zone = self._zone.taught(floor)

    def place(self, measured: Mapping[str, float], *commands: Mapping[str, float]) -> Place:
        """Return bounds about the readings and all commands that may act; all axes are in them.

        An axis of which nothing is known might be anywhere in its range.
        """
        low, high = np.array([axis.range for axis in self._robot.axes.values()]).T
        for column, (axis, offset) in enumerate(zip(self._axes, self._offset, strict=True)):
            known = [float(each[axis]) for each in commands if axis in each]
            if axis in measured:
                known.append(float(measured[axis] - offset))
            if known:
                low[column], high[column] = min(known), max(known)
        return Place(low, high)

    def move(self, place: Place, targets: Mapping[str, float]) -> tuple[Leg, ...]:
        """Return how a move is to be made: at once, or slower close above the floor.

        Raises
        ------
        OutOfLimitsError
            If a target is beyond its range, or the tip might leave its bounds on the way.
        """
        for axis, position in targets.items():
            check_target(self._robot, axis, position)
        zone = self._zone
        if zone is None or not zone.bounded:
            return (Leg(targets, {}),)
        swept = place.widened({self._axes.index(axis): at for axis, at in targets.items()})
        lowest = float(zone.check_sweep(*swept, zone.swept(*place)).low[2])
        top = zone.low + SLOW_HEIGHT
        lowering = {
            axis: at
            for axis, at in targets.items()
            if axis in _LIFTING and at < place.high[self._axes.index(axis)]
        }
        if lowest >= top or not lowering:
            return (Leg(targets, {}),)
        return self._in_two(zone, place, targets, lowering)

    def _in_two(
        self,
        zone: KeepOutZone,
        place: Place,
        targets: Mapping[str, float],
        lowering: Mapping[str, float],
    ) -> tuple[Leg, ...]:
        """Go at full speed as far as the slow zone, and slowly from there on."""
        slowly = dict.fromkeys(lowering, SLOW_SPEED / len(lowering))
        column = self._axes.index("z")
        end = {self._axes.index(axis): at for axis, at in targets.items()}
        arrived = place.widened(end)
        height = float(zone.swept(*arrived).low[2]) - zone.low
        raised = targets.get("z", np.inf) + SLOW_HEIGHT - height
        if "z" not in lowering or raised >= place.low[column]:
            return (Leg(targets, slowly),)
        return (Leg({**targets, "z": raised}, {}), Leg({"z": targets["z"]}, slowly))

    def profile(
        self, place: Place, axis: str, ends: tuple[float, float], speed: float, *, thrust: bool
    ) -> None:
        """Refuse a profile of one axis, between ``ends``, m or rad, that the tip must not make.

        A ``thrust`` may be faster than the slow zone allows, but is :data:`MOST_THRUST` long at
        most; nothing lets the tip out of its bounds.

        Raises
        ------
        OutOfLimitsError
            With what is left, or the speed and the bound.
        """
        for end in ends:
            check_target(self._robot, axis, end)
        zone = self._zone
        if zone is None or not zone.bounded:
            return
        column = self._axes.index(axis)
        swept = place.widened({column: ends[0]}).widened({column: ends[1]})
        lowest = float(zone.check_sweep(*swept, zone.swept(*place)).low[2])
        if axis not in _LIFTING or lowest >= zone.low + SLOW_HEIGHT or speed <= SLOW_SPEED:
            return
        if not thrust:
            raise OutOfLimitsError(
                f"tip: a profile at {readable(speed, 'm')}/s within {readable(SLOW_HEIGHT, 'm')} "
                f"of its floor: {readable(SLOW_SPEED, 'm')}/s at most; only an armed penetration "
                "may be faster there"
            )
        if ends[1] - ends[0] > MOST_THRUST * (1.0 + 1e-9):
            raise OutOfLimitsError(
                f"tip: a thrust of {readable(ends[1] - ends[0], 'm')} within "
                f"{readable(SLOW_HEIGHT, 'm')} of its floor: {readable(MOST_THRUST, 'm')} at most"
            )

    def velocity(
        self, place: Place, velocities: Mapping[str, float], lease_s: float
    ) -> dict[str, float]:
        """Return the velocities, all slower by one factor where the tip's bounds are near.

        Raises
        ------
        OutOfLimitsError
            If even the slowest could leave the bounds within the lease.
        """
        zone = self._zone
        if zone is None or not zone.bounded:
            return dict(velocities)
        present = zone.swept(*place)
        refusal: OutOfLimitsError | None = None
        for scale in _SCALES:
            slower = {axis: scale * speed for axis, speed in velocities.items()}
            ends = {
                self._axes.index(axis): self._end(place, axis, speed, lease_s)
                for axis, speed in slower.items()
            }
            try:
                box = zone.check_sweep(*place.widened(ends), present)
            except OutOfLimitsError as error:
                refusal = error
                continue
            down = -sum(min(slower.get(axis, 0.0), 0.0) for axis in _LIFTING)
            if box.low[2] >= zone.low + SLOW_HEIGHT or down <= SLOW_SPEED:
                return slower
        if refusal is None:
            raise OutOfLimitsError("tip: too fast so close above its floor; go slower")
        raise refusal

    def ways(self, velocities: Mapping[str, float], lease_s: float) -> dict[str, float]:
        """Return how far each axis still goes, m or rad, if nobody renews the lease.

        Its braking counts, and what goes by before it is told to brake; a lease of 0 leaves those.
        """
        return {axis: self._way(axis, speed, lease_s) for axis, speed in velocities.items()}

    def _end(self, place: Place, axis: str, speed: float, lease_s: float) -> float:
        column = self._axes.index(axis)
        begin = place.high[column] if speed > 0.0 else place.low[column]
        end = begin + self._way(axis, speed, lease_s)
        return float(np.clip(end, *self._robot.axes[axis].range))

    def _way(self, axis: str, speed: float, lease_s: float) -> float:
        most = self._robot.axes[axis].max_acceleration
        braking = speed**2 / (2.0 * most) if most else 0.0
        return float(np.copysign(abs(speed) * (lease_s + _REACTION_S) + braking, speed))

    def play(self, place: Place, trajectory: CheckedTrajectory) -> None:
        """Refuse a trajectory on which, or on the way to which, the tip leaves its bounds.

        Raises
        ------
        OutOfLimitsError
            With the time and what was left.
        """
        zone = self._zone
        if zone is None or not zone.bounded:
            return
        commands = trajectory.commands
        signals = commands_of(self._robot, commands)
        first = {self._axes.index(axis): float(signal[0]) for axis, signal in signals.items()}
        zone.check_sweep(*place.widened(first), zone.swept(*place))
        middle = 0.5 * (place.low + place.high)
        positions = np.tile(middle, (len(commands.time_s), 1))
        for axis, signal in signals.items():
            positions[:, self._axes.index(axis)] = signal
        zone.check_path(positions, commands.time_s)
