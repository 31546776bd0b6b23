"""An open driver on the bench, with operations common to all checks."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotemina.drivers.abilities import Homer, Linked
from rotemina.drivers.conformance.findings import Inapplicable, Unmet, at_most, demand
from rotemina.drivers.driver import Driver
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.trajectory.setpoint_limits import SetpointLimits

# A clock set by hand is moved on in steps of this, short beside every motion that is judged.
_STEP_S = 0.05
# Longer than any shipped robot takes for its whole range at half speed, twice over.
LONGEST_S = 60.0
# So long a motion lasts that must be caught in its middle: some thirty reads of a slow driver.
CATCH_S = 0.3
# Of its span: what an axis is moved by, so that it stays clear of the ends of its range.
_SHARE = 0.1


@dataclass(frozen=True, slots=True)
class Motion:
    """What one axis may do, m or rad, per s, per s².

    The range is what the device says, as far as the amplifier's voltage reaches. What the robot
    file leaves open is taken as the simulator takes it: an axis crosses its range in 1 s, and is as
    fast as that after 0.1 s.
    """

    index: int
    name: str
    unit: str
    low: float
    high: float
    resolution: float
    speed: float
    acceleration: float

    @property
    def span(self) -> float:
        """Length of the range."""
        return self.high - self.low

    @property
    def half_step(self) -> float:
        """How exactly a command can be told: half a step, at least the rounding of conversions."""
        return max(0.5 * self.resolution * (1.0 + 1e-6), 1e-9 * self.span)

    @property
    def crossing_s(self) -> float:
        """How long the whole range takes."""
        return self.span / self.speed

    def braking(self, speed: float) -> float:
        """Return the way in which it halts from a speed."""
        return speed**2 / (2.0 * self.acceleration)

    def stroke(self, command: float) -> float:
        """Return a way, signed, that lasts ``CATCH_S`` or a tenth of the span, into the range."""
        length = min(_SHARE * self.span, CATCH_S * self.speed)
        return length if command < 0.5 * (self.low + self.high) else -length

    def far_end(self, command: float) -> float:
        """Return the end of the range that is farther away."""
        return self.high if command < 0.5 * (self.low + self.high) else self.low

    def near_end(self, command: float) -> float:
        """Return the end of the range that is nearer."""
        return self.low if command < 0.5 * (self.low + self.high) else self.high


class Subject:
    """An open driver, read as often as it wants to be while its time passes."""

    def __init__(self, driver: Driver, advance: Callable[[float], None]) -> None:
        self.driver = driver
        self.advance = advance
        self.step_s = _STEP_S if driver.virtual_time else driver.service_period_s
        limits = SetpointLimits.of(driver.robot)
        self.axes = tuple(
            Motion(
                index,
                one.name,
                one.unit,
                max(one.low, float(limits.low[index])),
                min(one.high, float(limits.high[index])),
                one.resolution,
                one.max_speed or float(limits.speed[index]),
                one.max_acceleration or float(limits.acceleration[index]),
            )
            for index, one in enumerate(driver.descriptions)
        )

    @property
    def slow(self) -> Motion:
        """The axis that takes longest for its range: it can be caught in mid-move."""
        return max(self.axes, key=lambda axis: axis.crossing_s)

    @property
    def quick(self) -> Motion:
        """The axis that is soonest at an end of its range."""
        return min(self.axes, key=lambda axis: axis.crossing_s)

    @property
    def late_s(self) -> float:
        """How old the latest sample may be, s: nothing, or what a real line and its reading take.

        A stop takes as long to the device as its answer takes back: that is the round trip.
        """
        if self.driver.virtual_time:
            return 0.0
        round_trip_s = 0.0
        if isinstance(self.driver, Linked):
            round_trip_s = self.driver.link_quality().round_trip_s or 0.0
        return 2.0 * self.driver.service_period_s + round_trip_s

    @property
    def state(self) -> DeviceState:
        """What the device is doing."""
        return self.driver.status().state

    def run(self, seconds: float) -> Samples:
        """Let time pass, reading as often as the driver wants; return what was sampled."""
        parts = [self.driver.read()]
        for _ in range(max(1, round(seconds / self.step_s))):
            self.advance(self.step_s)
            parts.append(self.driver.read())
        return Samples.joined(parts, len(self.driver.axes))

    def run_while(self, goes_on: Callable[[Samples], bool], limit_s: float = LONGEST_S) -> Samples:
        """Let time pass for as long as the latest samples say so; return what was sampled."""
        parts = [self.driver.read()]
        for _ in range(round(limit_s / self.step_s)):
            if not goes_on(parts[-1]):
                return Samples.joined(parts, len(self.driver.axes))
            self.advance(self.step_s)
            parts.append(self.driver.read())
        raise Unmet(f"after {limit_s:g} s it is still {self.state}; expected: an end of that")

    def rest(self, limit_s: float = LONGEST_S) -> Samples:
        """Let time pass until the device is idle, and a little more; return what was sampled."""
        busy = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)
        moving = self.run_while(lambda _: self.state in busy, limit_s)
        # A device may say that it rests before the sample that shows where.
        samples = Samples.joined([moving, self.run(0.05)], len(self.driver.axes))
        status = self.driver.status()
        demand(
            status.state is DeviceState.IDLE,
            f"it is {status.state}{f' ({status.fault})' if status.fault else ''}",
            "idle",
        )
        return samples

    def stop(self) -> None:
        """Stop, and read at once: when a stop acts is the matter of a check of its own."""
        self.driver.stop()
        self.driver.read()

    def command(self) -> FloatArray:
        """Return the latest command (axes,), m or rad; some time passes."""
        samples = self.run_while(lambda latest: len(latest) == 0, 5.0)
        return np.array(samples.command[-1])

    def make_ready(self) -> None:
        """Wait until the device rests, clear a fault, and home what has to be.

        Raises
        ------
        Inapplicable
            If the position is unknown and the device cannot home.
        """
        driver = self.driver
        self.run(0.05)
        if self.state is DeviceState.FAULT:
            driver.clear_fault()
        self.rest()
        status = driver.status()
        if status.position_known:
            return
        if not isinstance(driver, Homer):
            raise Inapplicable("the position is unknown and it cannot home, so nothing may move")
        driver.home(status.unhomed or driver.homing_axes)
        self.rest()
        demand(driver.status().position_known, "the position is unknown after homing", "known")

    def send(self, axis: Motion, way: float) -> float:
        """Send one axis by a way, m or rad; return its target."""
        target = float(np.clip(self.command()[axis.index] + way, axis.low, axis.high))
        self.driver.move_to({axis.name: target})
        return target

    def cross(self, axis: Motion) -> float:
        """Send one axis towards the end of its range that is farther away; return that."""
        target = axis.far_end(float(self.command()[axis.index]))
        self.driver.move_to({axis.name: target})
        return target

    def holds(self, seconds: float = 0.3) -> None:
        """Demand that no command changes for so long."""
        commands = self.run(seconds).command
        if not len(commands):
            raise Unmet(f"no samples in {seconds:g} s; expected: some")
        for axis in self.axes:
            moved = float(np.ptp(commands[:, axis.index]))
            at_most(f"axis {axis.name} was to hold, and moved", moved, axis.half_step, axis.unit)

    def inside(self, samples: Samples) -> None:
        """Demand that no command leaves the range of its axis."""
        for axis in self.axes:
            column = samples.command[:, axis.index]
            for end, sign in ((axis.low, -1.0), (axis.high, 1.0)):
                beyond = float((sign * (column - end)).max(initial=-np.inf))
                at_most(
                    f"axis {axis.name} was commanded beyond its range, by",
                    beyond,
                    axis.half_step,
                    axis.unit,
                )


def interval_of(samples: Samples) -> float:
    """Return the usual time between samples, s; 0 where there are fewer than two."""
    if len(samples) < 2:
        return 0.0
    return float(np.median(np.diff(samples.device_time_s)))
