"""Set-points of single moves, tick by tick, at the highest permitted speed.

At each tick the speed of the command changes by at most ``a·dt``. The command has the highest speed
from which the axis can still stop at its target. Let D be the distance in units of ``a·dt²``, and u
the speed in units of ``a·dt``. Braking by one unit per tick covers ``f(u) = (n + 1) u − n (n +
1)/2`` for u between n and n + 1. With the solution u of ``f(u) = D``, the axis stops exactly at the
target, after a whole number of ticks.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray
from rotemina.sim.trajectory import SetpointLimits


class SetpointGenerator:
    """Generates the commands of all axes, tick by tick, to their targets.

    A new target may be set during a move; the speed does not jump. If an axis cannot stop before
    its new target, it passes the target and returns. An axis never leaves its range.
    """

    def __init__(self, limits: SetpointLimits, tick_s: float, position: FloatArray) -> None:
        self._limits = limits
        self._tick_s = tick_s
        self._position = np.array(position, dtype=np.float64)
        self._velocity = np.zeros_like(self._position)
        self._target = self._position.copy()
        self._max_speed = limits.speed.copy()
        self._is_stopping = np.zeros(len(self._position), dtype=np.bool_)

    @property
    def position(self) -> FloatArray:
        """Latest command (axes,), m or rad."""
        return self._position.copy()

    @property
    def moving(self) -> bool:
        """Whether any axis is still moving or stopping."""
        return bool((self._velocity != 0).any() or (self._position != self._target).any())

    @property
    def velocity(self) -> FloatArray:
        """Speed of the latest command (axes,), m/s or rad/s."""
        return self._velocity.copy()

    def retarget(self, targets: dict[int, float], max_speed: float | None = None) -> None:
        """Move axes, by number, to new targets within the range, no faster than ``max_speed``."""
        for index, target in targets.items():
            speed_limit = float(self._limits.speed[index])
            # Because of rounding, a target may lie outside the range, and would never be reached.
            low, high = self._limits.low[index], self._limits.high[index]
            self._target[index] = min(max(target, float(low)), float(high))
            self._max_speed[index] = (
                speed_limit if max_speed is None else min(max_speed, speed_limit)
            )
            self._is_stopping[index] = False

    def drive(self, index: int, velocity: float) -> None:
        """Move an axis at a speed until the next command, or until the end of its range."""
        if velocity == 0.0:
            self.stop(index)
        else:
            range_ends = self._limits.high if velocity > 0.0 else self._limits.low
            self.retarget({index: float(range_ends[index])}, abs(velocity))

    def set_tick(self, tick_s: float) -> None:
        """Change the interval of the ticks. All axes must be at rest."""
        self._tick_s = tick_s

    def set_bounds(self, index: int, low: float, high: float) -> None:
        """Set the bounds of the axis with this number, which must lie between them."""
        self._limits.low[index], self._limits.high[index] = low, high

    def begin_search(self, axes: tuple[int, ...], speed_fraction: float) -> None:
        """Move axes, by number, to their low ends at a fraction of their maximum speed."""
        for index in axes:
            low, speed = self._limits.low[index], self._limits.speed[index]
            self.retarget({index: float(low)}, speed_fraction * float(speed))

    def take_over(self, position: FloatArray, velocity: FloatArray) -> None:
        """Start from a command (axes,) and its speed (axes,), and brake to a halt."""
        self._position[:] = np.clip(position, self._limits.low, self._limits.high)
        self._velocity[:] = np.clip(velocity, -self._limits.speed, self._limits.speed)
        self.stop()

    def stop(self, index: int | None = None) -> None:
        """Brake one axis, or all axes, with the maximum acceleration, and hold."""
        for axis in range(len(self._position)) if index is None else (index,):
            self._is_stopping[axis] = self._velocity[axis] != 0.0
            if not self._is_stopping[axis]:
                self._target[axis] = self._position[axis]

    def generate(self, ticks: int, *, until_rest: bool = False) -> FloatArray:
        """Return the commands (ticks, axes) of the next ticks.

        With ``until_rest`` the last command is the first one at which all axes are at rest.
        """
        commands = np.empty((ticks, len(self._position)))
        count = _fill_commands(
            self._position,
            self._velocity,
            self._target,
            self._is_stopping,
            self._limits.low,
            self._limits.high,
            self._max_speed,
            self._limits.acceleration,
            self._tick_s,
            until_rest,
            commands,
        )
        return commands[: int(count)]


@numba.njit(cache=True, nogil=True)
def _compute_braking_speed(distance: float, quantum: float, tick_s: float) -> float:
    """Return the highest speed in the next tick from which the axis can stop at a distance.

    ``quantum`` is the change of speed in one tick.
    """
    units = abs(distance) / (quantum * tick_s)
    n = np.floor((np.sqrt(1.0 + 8.0 * units) - 1.0) / 2.0)
    return float(np.sign(distance) * (units + n * (n + 1.0) / 2.0) / (n + 1.0) * quantum)


@numba.njit(cache=True, nogil=True)
def _fill_commands(
    position: FloatArray,
    velocity: FloatArray,
    target: FloatArray,
    is_stopping: NDArray[np.bool_],
    low: FloatArray,
    high: FloatArray,
    max_speed: FloatArray,
    acceleration: FloatArray,
    tick_s: float,
    until_rest: bool,
    commands: FloatArray,
) -> int:
    """Fill ``commands`` (n, axes), advance the state arrays (axes,), and return the tick count."""
    axes = position.shape[0]
    for k in range(commands.shape[0]):
        is_moving = False
        for i in range(axes):
            quantum = acceleration[i] * tick_s
            new_speed = 0.0
            if not is_stopping[i]:
                new_speed = _compute_braking_speed(target[i] - position[i], quantum, tick_s)
                new_speed = min(max(new_speed, -max_speed[i]), max_speed[i])
            # Rounding of the braking speed must not leave the axis slightly beyond its target.
            slack = 1e-9 * quantum
            can_reach_speed = abs(new_speed - velocity[i]) <= quantum + slack
            if not can_reach_speed:
                new_speed = velocity[i] + np.sign(new_speed - velocity[i]) * quantum
            velocity[i] = new_speed
            distance = abs(target[i] - position[i])
            if (
                not is_stopping[i]
                and can_reach_speed
                and distance <= abs(new_speed) * tick_s * (1.0 + 1e-9)
            ):
                position[i] = target[i]
            else:
                position[i] += new_speed * tick_s
            if position[i] < low[i] or position[i] > high[i]:
                position[i] = min(max(position[i], low[i]), high[i])
                velocity[i] = 0.0
            if is_stopping[i] and velocity[i] == 0.0:
                is_stopping[i] = False
                target[i] = position[i]
            commands[k, i] = position[i]
            is_moving = is_moving or velocity[i] != 0.0 or position[i] != target[i]
        if until_rest and not is_moving:
            return k + 1
    return len(commands)
