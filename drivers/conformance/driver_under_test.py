"""An open driver on the bench, with operations that all checks share."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotemina.drivers.abilities import AxisHomer, LinkReporter
from rotemina.drivers.conformance.findings import (
    CheckNotApplicable,
    RequirementNotMet,
    require_at_most,
    require_that,
)
from rotemina.drivers.contract import DeviceSamples, DeviceState, Driver
from rotemina.sim.arrays import FloatArray
from rotemina.sim.trajectory import SetpointLimits

# Step by which a virtual clock advances. It is short compared with every motion in the checks.
_VIRTUAL_STEP_S = 0.05
# Twice the time that the slowest shipped robot needs to cross its range at half speed.
MAX_MOTION_S = 60.0
# Duration of a motion that a check interrupts. It spans about thirty reads of a slow driver.
STROKE_S = 0.3
# A stroke is at most this fraction of the span, so that the axis stays clear of the range ends.
_MAX_STROKE_SPAN_RATIO = 0.1


@dataclass(frozen=True, slots=True)
class AxisUnderTest:
    """Limits of one axis under test. Positions are in m or rad, speeds per s, accelerations per s².

    The range is the device's range, limited to the positions that the amplifier's voltage can
    reach. If the robot file declares no limit, the simulator's limit is used: an axis crosses its
    range in 1 s, and reaches this speed after 0.1 s.
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
        """Tolerance of a command: half a step, but at least the rounding error of conversions."""
        return max(0.5 * self.resolution * (1.0 + 1e-6), 1e-9 * self.span)

    @property
    def full_range_time_s(self) -> float:
        """Time to cross the whole range at full speed, s."""
        return self.span / self.speed

    def compute_braking_distance(self, speed: float) -> float:
        """Return the distance that the axis needs to halt from a speed, m or rad."""
        return speed**2 / (2.0 * self.acceleration)

    def compute_stroke(self, command: float) -> float:
        """Return a signed distance, m or rad, towards the farther end of the range.

        It takes ``STROKE_S`` at full speed, and is at most a tenth of the span.
        """
        length = min(_MAX_STROKE_SPAN_RATIO * self.span, STROKE_S * self.speed)
        return length if command < 0.5 * (self.low + self.high) else -length

    def find_far_end(self, command: float) -> float:
        """Return the end of the range that is farther from the command."""
        return self.high if command < 0.5 * (self.low + self.high) else self.low

    def find_near_end(self, command: float) -> float:
        """Return the end of the range that is nearer to the command."""
        return self.low if command < 0.5 * (self.low + self.high) else self.high


class DriverUnderTest:
    """An open driver that is read as often as it requires while time passes."""

    def __init__(self, driver: Driver, advance: Callable[[float], None]) -> None:
        self.driver = driver
        self.advance = advance
        self.step_s = _VIRTUAL_STEP_S if driver.virtual_time else driver.service_period_s
        limits = SetpointLimits.of(driver.robot)
        self.axes = tuple(
            AxisUnderTest(
                index,
                description.name,
                description.unit,
                max(description.low, float(limits.low[index])),
                min(description.high, float(limits.high[index])),
                description.resolution,
                description.max_speed or float(limits.speed[index]),
                description.max_acceleration or float(limits.acceleration[index]),
            )
            for index, description in enumerate(driver.descriptions)
        )

    @property
    def slowest_axis(self) -> AxisUnderTest:
        """The axis with the longest crossing time, so that a check can interrupt its moves."""
        return max(self.axes, key=lambda axis: axis.full_range_time_s)

    @property
    def fastest_axis(self) -> AxisUnderTest:
        """The axis that crosses its range in the shortest time."""
        return min(self.axes, key=lambda axis: axis.full_range_time_s)

    @property
    def max_sample_age_s(self) -> float:
        """Maximum age of the latest sample, s. It is 0 on a virtual clock.

        On a real line the age includes the round trip: a stop has to reach the device, and its
        effect has to be reported.
        """
        if self.driver.virtual_time:
            return 0.0
        round_trip_s = 0.0
        if isinstance(self.driver, LinkReporter):
            round_trip_s = self.driver.link_quality().round_trip_s or 0.0
        return 2.0 * self.driver.service_period_s + round_trip_s

    @property
    def state(self) -> DeviceState:
        """The state of the device."""
        return self.driver.status().state

    def run(self, seconds: float) -> DeviceSamples:
        """Let time pass and read as often as the driver requires; return the samples."""
        parts = [self.driver.read()]
        for _ in range(max(1, round(seconds / self.step_s))):
            self.advance(self.step_s)
            parts.append(self.driver.read())
        return DeviceSamples.join(parts, len(self.driver.axes))

    def run_while(
        self, condition: Callable[[DeviceSamples], bool], limit_s: float = MAX_MOTION_S
    ) -> DeviceSamples:
        """Let time pass while a condition on the newest samples holds; return all samples.

        Raises
        ------
        RequirementNotMet
            If the condition still holds after ``limit_s``.
        """
        parts = [self.driver.read()]
        for _ in range(round(limit_s / self.step_s)):
            if not condition(parts[-1]):
                return DeviceSamples.join(parts, len(self.driver.axes))
            self.advance(self.step_s)
            parts.append(self.driver.read())
        raise RequirementNotMet(
            f"after {limit_s:g} s it is still {self.state}; expected: the end of this state"
        )

    def run_until_idle(self, limit_s: float = MAX_MOTION_S) -> DeviceSamples:
        """Let time pass until the device is idle, and a little longer; return the samples."""
        busy = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)
        moving = self.run_while(lambda _: self.state in busy, limit_s)
        # A device may report that it is idle before it sends the sample with its final position.
        samples = DeviceSamples.join([moving, self.run(0.05)], len(self.driver.axes))
        status = self.driver.status()
        require_that(
            status.state is DeviceState.IDLE,
            f"it is {status.state}{f' ({status.fault})' if status.fault else ''}",
            "idle",
        )
        return samples

    def stop(self) -> None:
        """Stop, and read at once. Separate checks cover the time at which a stop takes effect."""
        self.driver.stop()
        self.driver.read()

    def read_command(self) -> FloatArray:
        """Wait for a sample and return its commanded positions (axes,), m or rad."""
        samples = self.run_while(lambda latest: len(latest) == 0, 5.0)
        return np.array(samples.command[-1])

    def make_ready(self) -> None:
        """Clear a fault, wait until the device is at rest, and home all axes without a position.

        Raises
        ------
        CheckNotApplicable
            If the position is unknown and the device cannot home.
        """
        driver = self.driver
        self.run(0.05)
        if self.state is DeviceState.FAULT:
            driver.clear_fault()
        self.run_until_idle()
        status = driver.status()
        if status.position_known:
            return
        if not isinstance(driver, AxisHomer):
            raise CheckNotApplicable(
                "the position is unknown and it cannot home, so nothing may move"
            )
        driver.home(status.unhomed or driver.homing_axes)
        self.run_until_idle()
        require_that(
            driver.status().position_known, "the position is unknown after homing", "known"
        )

    def move_by(self, axis: AxisUnderTest, distance: float) -> float:
        """Start a move of one axis by a distance, m or rad; return its target."""
        target = float(np.clip(self.read_command()[axis.index] + distance, axis.low, axis.high))
        self.driver.move_to({axis.name: target})
        return target

    def move_to_far_end(self, axis: AxisUnderTest) -> float:
        """Start a move of one axis to the farther end of its range; return the target."""
        target = axis.find_far_end(float(self.read_command()[axis.index]))
        self.driver.move_to({axis.name: target})
        return target

    def require_hold(self, seconds: float = 0.3) -> None:
        """Require that no commanded position changes for a time."""
        commands = self.run(seconds).command
        if not len(commands):
            raise RequirementNotMet(f"no samples in {seconds:g} s; expected: some")
        for axis in self.axes:
            travel = float(np.ptp(commands[:, axis.index]))
            require_at_most(
                f"axis {axis.name} was to hold, but moved by", travel, axis.half_step, axis.unit
            )

    def require_in_range(self, samples: DeviceSamples) -> None:
        """Require that no commanded position is outside the range of its axis."""
        for axis in self.axes:
            positions = samples.command[:, axis.index]
            for end, sign in ((axis.low, -1.0), (axis.high, 1.0)):
                excess = float((sign * (positions - end)).max(initial=-np.inf))
                require_at_most(
                    f"axis {axis.name} was commanded beyond its range, by",
                    excess,
                    axis.half_step,
                    axis.unit,
                )


def find_sample_interval(samples: DeviceSamples) -> float:
    """Return the median time between samples, s; 0 for fewer than two samples."""
    if len(samples) < 2:
        return 0.0
    return float(np.median(np.diff(samples.device_time_s)))
