"""Set-points of single moves, tick by tick at the greatest permitted speed.

At each tick the speed of the command changes by at most ``a·dt``, and is the greatest from which
the axis can still stop on its target. With D the distance in units of ``a·dt²`` and u the speed
in units of ``a·dt``, braking by one unit a tick covers ``f(u) = (n + 1) u − n (n + 1)/2`` for u
between n and n + 1; solving ``f(u) = D`` for u lands on the target exactly, after a whole number
of ticks.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray
from rotemina.sim.trajectory.setpoint_limits import SetpointLimits


class SetpointGenerator:
    """Commands of all axes, tick by tick, on their way to targets.

    A new target may be given in mid-move: the speed has no jump. An axis passes a target only where
    that lies nearer than it can stop, and then comes back; it never leaves the range.
    """

    def __init__(self, limits: SetpointLimits, tick_s: float, position: FloatArray) -> None:
        self._limits = limits
        self._tick_s = tick_s
        self._position = np.array(position, dtype=np.float64)
        self._velocity = np.zeros_like(self._position)
        self._target = self._position.copy()
        self._speed = limits.speed.copy()
        self._stopping = np.zeros(len(self._position), dtype=np.bool_)

    @property
    def position(self) -> FloatArray:
        """The last command (axes,), m or rad."""
        return self._position.copy()

    @property
    def moving(self) -> bool:
        """Whether any axis is still moving or stopping."""
        return bool((self._velocity != 0).any() or (self._position != self._target).any())

    @property
    def velocity(self) -> FloatArray:
        """The speed of the last command (axes,), m/s or rad/s."""
        return self._velocity.copy()

    def retarget(self, targets: dict[int, float], most_speed: float | None = None) -> None:
        """Send axes, by their number, to new targets inside the range, no faster than this."""
        for index, target in targets.items():
            greatest = float(self._limits.speed[index])
            # Targets may be beyond by the rounding of units, where no axis would ever arrive.
            low, high = self._limits.low[index], self._limits.high[index]
            self._target[index] = min(max(target, float(low)), float(high))
            self._speed[index] = greatest if most_speed is None else min(most_speed, greatest)
            self._stopping[index] = False

    def drive(self, index: int, velocity: float) -> None:
        """Move an axis at a speed until commanded otherwise, or up to an end of its range."""
        if velocity == 0.0:
            self.stop(index)
        else:
            end = self._limits.high if velocity > 0.0 else self._limits.low
            self.retarget({index: float(end[index])}, abs(velocity))

    def retime(self, tick_s: float) -> None:
        """Continue at other ticks; all axes rest."""
        self._tick_s = tick_s

    def bound(self, index: int, low: float, high: float) -> None:
        """Keep an axis, by its number, between these from now on; it lies there."""
        self._limits.low[index], self._limits.high[index] = low, high

    def search(self, axes: tuple[int, ...], share: float) -> None:
        """Send axes, by their number, to their low ends at this share of their greatest speed."""
        for index in axes:
            low, speed = self._limits.low[index], self._limits.speed[index]
            self.retarget({index: float(low)}, share * float(speed))

    def take_over(self, position: FloatArray, velocity: FloatArray) -> None:
        """Continue from a command (axes,) and its speed (axes,), and come to a halt."""
        self._position[:] = np.clip(position, self._limits.low, self._limits.high)
        self._velocity[:] = np.clip(velocity, -self._limits.speed, self._limits.speed)
        self.stop()

    def stop(self, index: int | None = None) -> None:
        """Reduce the speed of one axis, or of all, to zero as fast as it may, and hold there."""
        for each in range(len(self._position)) if index is None else (index,):
            self._stopping[each] = self._velocity[each] != 0.0
            if not self._stopping[each]:
                self._target[each] = self._position[each]

    def generate(self, ticks: int, *, until_rest: bool = False) -> FloatArray:
        """Return the commands (ticks, axes) of the next ticks.

        With ``until_rest`` they end with the tick after which nothing moves any more.
        """
        commands = np.empty((ticks, len(self._position)))
        count = _fill(
            self._position,
            self._velocity,
            self._target,
            self._stopping,
            self._limits.low,
            self._limits.high,
            self._speed,
            self._limits.acceleration,
            self._tick_s,
            until_rest,
            commands,
        )
        return commands[: int(count)]


@numba.njit(cache=True, nogil=True)
def _braking_speed(distance: float, quantum: float, tick_s: float) -> float:
    """Return the greatest speed of the next tick from which one can stop after ``distance``."""
    units = abs(distance) / (quantum * tick_s)
    n = np.floor((np.sqrt(1.0 + 8.0 * units) - 1.0) / 2.0)
    return float(np.sign(distance) * (units + n * (n + 1.0) / 2.0) / (n + 1.0) * quantum)


@numba.njit(cache=True, nogil=True)
def _fill(
    position: FloatArray,
    velocity: FloatArray,
    target: FloatArray,
    stopping: NDArray[np.bool_],
    low: FloatArray,
    high: FloatArray,
    speed: FloatArray,
    acceleration: FloatArray,
    tick_s: float,
    until_rest: bool,
    commands: FloatArray,
) -> int:
    """Fill ``commands`` (n, axes) and move on the generator's arrays (axes,); return how many."""
    axes = position.shape[0]
    for k in range(commands.shape[0]):
        moving = False
        for i in range(axes):
            quantum = acceleration[i] * tick_s
            wanted = 0.0
            if not stopping[i]:
                wanted = _braking_speed(target[i] - position[i], quantum, tick_s)
                wanted = min(max(wanted, -speed[i]), speed[i])
            # Rounding of the braking speed must not leave the axis an atom beyond its target.
            slack = 1e-9 * quantum
            reached = abs(wanted - velocity[i]) <= quantum + slack
            if not reached:
                wanted = velocity[i] + np.sign(wanted - velocity[i]) * quantum
            velocity[i] = wanted
            left = abs(target[i] - position[i])
            if not stopping[i] and reached and left <= abs(wanted) * tick_s * (1.0 + 1e-9):
                position[i] = target[i]
            else:
                position[i] += wanted * tick_s
            if position[i] < low[i] or position[i] > high[i]:
                position[i] = min(max(position[i], low[i]), high[i])
                velocity[i] = 0.0
            if stopping[i] and velocity[i] == 0.0:
                stopping[i] = False
                target[i] = position[i]
            commands[k, i] = position[i]
            moving = moving or velocity[i] != 0.0 or position[i] != target[i]
        if until_rest and not moving:
            return k + 1
    return len(commands)
