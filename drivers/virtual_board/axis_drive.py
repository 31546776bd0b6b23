"""Motion of one axis by a board, tick by tick: to a target, at a speed, or along a ramp."""

from copy import deepcopy

import numpy as np

from rotemina.drivers.simulator.setpoint_generator import SetpointGenerator
from rotemina.sim.arrays import FloatArray
from rotemina.sim.trajectory.setpoint_limits import SetpointLimits

_FAR = 1e9  # steps: farther than anything can go, where no limit is known


class AxisDrive:
    """The command of one axis, in steps; whole ones act, the rest is kept for smoothness.

    Parameters
    ----------
    tick_s : float
    position : float
        Where the command stands at first, steps.
    """

    def __init__(self, tick_s: float, position: float) -> None:
        self._tick_s = tick_s
        self._low, self._high = -_FAR, _FAR
        self._limits = SetpointLimits(*(np.array([one]) for one in (-_FAR, _FAR, 1.0, 1.0)))
        self._generator = SetpointGenerator(self._limits, tick_s, np.array([position]))
        self._position = float(position)
        self._ramp_end: float | None = None
        self._ramp_speed = 0.0
        self._rests = True  # asked for at every look: kept, not worked out

    @property
    def position(self) -> float:
        """The latest command, steps."""
        return self._position

    @property
    def velocity(self) -> float:
        """The speed of the latest command, steps/s."""
        if self._ramp_end is not None:
            return float(np.sign(self._ramp_end - self.position)) * self._ramp_speed
        return float(self._generator.velocity[0])

    @property
    def moving(self) -> bool:
        """Whether it is still moving or halting."""
        if not self._rests:
            self._rests = self._ramp_end is None and not self._generator.moving
        return not self._rests

    def bound(self, low: float, high: float, speed: float, acceleration: float) -> None:
        """Keep to these limits: steps, steps/s, steps/s²."""
        self._low, self._high = low, high
        self._limits.speed[0], self._limits.acceleration[0] = speed, acceleration
        self._include()

    def unbound(self) -> None:
        """Ignore the limits, because the position is unknown."""
        self._low, self._high = -_FAR, _FAR
        self._include()

    def move_to(self, target: float, most_speed: float) -> None:
        """Go to a target inside the limits."""
        self._end_ramp()
        self._include()
        self._generator.retarget({0: target}, most_speed)

    def drive(self, speed: float) -> None:
        """Move at a speed until commanded otherwise, or up to an end of the range."""
        self._end_ramp()
        self._include()
        self._generator.drive(0, speed)

    def ramp(self, target: float, speed: float) -> None:
        """Go to a target at a constant speed, as the slew limit of a converter has it."""
        self.hold()
        self._include(target)
        self._ramp_end, self._ramp_speed = target, speed

    def halt(self) -> None:
        """Come to rest within the acceleration."""
        self._end_ramp()
        self._generator.stop()

    def hold(self) -> None:
        """Stay where the command is, at once."""
        self.place(self.position)

    def place(self, position: float, speed: float = 0.0) -> None:
        """Command a position, and come to rest from a speed if any."""
        self._ramp_end = None
        self._include(position)
        self._generator.take_over(np.array([position]), np.array([speed]))
        self._position = float(self._generator.position[0])

    def shift(self, position: float) -> None:
        """Redefine the present position, and come to rest from the present speed."""
        self.place(position, self.velocity)

    def generate(self, ticks: int) -> FloatArray:
        """Return the commands (ticks,) of the next ticks, steps."""
        if self._ramp_end is not None:
            return self._generate_ramp(ticks, self._ramp_end)
        if not self.moving:
            return np.full(ticks, self.position)
        commands = self._generator.generate(ticks)[:, 0]
        self._position = float(commands[-1])
        return commands

    def preview(self, ticks: int) -> FloatArray:
        """Return the commands (ticks,) that `generate` will return, steps."""
        return deepcopy(self).generate(ticks) if self.moving else np.full(ticks, self.position)

    def _generate_ramp(self, ticks: int, end: float) -> FloatArray:
        begin, step = self.position, self._ramp_speed * self._tick_s
        passed = np.minimum(step * np.arange(1, ticks + 1), abs(end - begin))
        commands = np.asarray(begin + np.sign(end - begin) * passed)
        if passed[-1] >= abs(end - begin):
            commands[passed >= abs(end - begin)] = end
            self.place(end)
        else:
            self._generator.take_over(commands[-1:], np.zeros(1))
            self._position = float(commands[-1])
        return commands

    def _end_ramp(self) -> None:
        if self._ramp_end is not None:
            self.hold()

    def _include(self, position: float | None = None) -> None:
        """Let the range hold where it is: a limit that is written never makes a leap."""
        self._rests = False
        at = self.position if position is None else position
        self._limits.low[0] = min(self._low, at, self.position)
        self._limits.high[0] = max(self._high, at, self.position)
