"""The driver of the simulator, which simulates a robot with its effects."""

import time
from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from types import MappingProxyType
from typing import ClassVar

import numpy as np

from rotemina.drivers.abilities import (
    VOLTAGE_SLEW_RANGES_PER_S,
    AxisHomer,
    AxisRegulator,
    CapturedSamples,
    CaptureRates,
    EffectCarrier,
    FastCapturer,
    HysteresisCompensator,
    MotionProfile,
    ProfileRunner,
    TrajectoryPlayer,
    TruePositions,
    VelocityMover,
    VoltageOutput,
)
from rotemina.drivers.contract import (
    Clock,
    DeviceSamples,
    DeviceState,
    DeviceStatus,
    DriverSettingError,
    LimitError,
    Permit,
    SettingValue,
    StateError,
)
from rotemina.drivers.simulator.device import SimulatedDevice
from rotemina.drivers.simulator.fast_captures import SimulatedCapture
from rotemina.drivers.simulator.front_panel import FrontPanel
from rotemina.drivers.simulator.homing import HomingState
from rotemina.drivers.simulator.profile_motion import ProfileMotion
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate import InverseExceedance, InverseModel
from rotemina.sim.errors import InputError, LostLoopError, PlantError
from rotemina.sim.feedback import AxisRegulation
from rotemina.sim.messages import format_rounded
from rotemina.sim.records import Record
from rotemina.sim.robot import (
    AxisEffect,
    ForceAxis,
    PiezoAxis,
    Robot,
    StepperAxis,
)
from rotemina.sim.trajectory import SetpointLimits, check_target

MAX_RATE_HZ = 20_000.0
# ``read`` simulates at least this much device time at once.
_MIN_READ_S = 0.016
# One call simulates at most this much device time. The next call simulates the rest.
MAX_READ_S = 5.0
MAX_CAPTURE_SAMPLES = 100_000


class Simulator(
    TrajectoryPlayer,
    VelocityMover,
    AxisHomer,
    VoltageOutput,
    FastCapturer,
    ProfileRunner,
    FrontPanel,
    TruePositions,
    EffectCarrier,
    HysteresisCompensator,
    AxisRegulator,
):
    """Simulated machine that behaves as its robot file says.

    Device time is the time of the clock since ``open``. Each call simulates the time since the last
    call, so the clock may be real or virtual. A request takes effect at the next tick after the
    current time of the clock. If the robot file has controllers, they control the axes. When the
    driver is closed and opened again, the machine is at its last set-point. The effects of the
    robot file apply until others are set.

    The settings are:

    - ``sample_rate_hz``: rate of samples and set-points
    - ``seed``: seed of noise and random effects
    - ``settle_s``: time of rest at the first row of a trajectory, s
    - ``start_fraction``: initial position of each axis, as a fraction of its range
    - ``start_homed``: whether the positions of the steppers are known initially
    """

    name = "simulator"
    virtual_time = True
    service_period_s = 0.001
    default_settings: ClassVar[Mapping[str, SettingValue]] = MappingProxyType(
        {
            "sample_rate_hz": 1000.0,
            "seed": 0,
            "settle_s": 0.5,
            "start_fraction": 0.5,
            "start_homed": True,
        }
    )

    def __init__(
        self,
        robot: Robot,
        settings: Mapping[str, object] | None = None,
        *,
        clock: Clock = time.monotonic,
    ) -> None:
        super().__init__(robot, settings, clock=clock)
        self._tick_s = 1.0 / self._read_number("sample_rate_hz", 1.0, MAX_RATE_HZ)
        self._settle_s = self._read_number("settle_s", 0.0, 60.0)
        self._seed = int(self._read_number("seed", 0, 2**63))
        for axis in robot.axes.values():
            if isinstance(axis, ForceAxis) and axis.controller is None:
                raise DriverSettingError(
                    "simulator: robot {name} has a force axis without a controller; add "
                    "one to the robot file",
                    name=repr(robot.name),
                )
        self._position = self._compute_start_position(self._read_number("start_fraction", 0.0, 1.0))
        self._set_true_positions(self._position)
        start_homed = self.settings["start_homed"]
        self._homing = HomingState(() if start_homed else map(self.axes.index, self.homing_axes))
        self._running_capture: SimulatedCapture | None = None
        self._profile: ProfileMotion | None = None
        self._opened_at_s = 0.0
        self._device: SimulatedDevice | None = None
        self._effects = robot.effects
        self._fault: str | None = None
        # Device times of requested stops. Any thread may append; only the driver's thread removes.
        self._stop_times_s: deque[float] = deque()
        # Device time at the end of each lease, by axis number.
        self._lease_ends_s: dict[int, float] = {}
        self._unread: list[DeviceSamples] = []

    @property
    def setpoint_period_s(self) -> float:
        """Interval between samples and between set-points, s."""
        return self._tick_s

    @property
    def stop_pending(self) -> bool:
        """Whether a stop was requested that is not simulated yet."""
        return bool(self._stop_times_s)

    @property
    def effects(self) -> tuple[AxisEffect, ...]:
        """The current effects, including those that are switched off."""
        return self._effects

    @property
    def homing_axes(self) -> tuple[str, ...]:
        """The stepper axes. A piezo needs no homing, because its sensor is absolute."""
        axes = self.robot.axes.items()
        return tuple(name for name, axis in axes if isinstance(axis, StepperAxis))

    @property
    def capture_rates(self) -> CaptureRates:
        """The capture rates. All axes can be captured at the sample rate."""
        rate_hz = 1.0 / self._tick_s
        return CaptureRates(rate_hz, rate_hz, len(self.axes), MAX_CAPTURE_SAMPLES)

    def _set_effects(self, effects: tuple[AxisEffect, ...], permit: Permit) -> None:
        self._simulate_until_now()
        plant, state = self._open_device.make_plant_with_effects(effects)
        with permit.passing():
            self._open_device.set_plant(plant, state)
            self._effects = effects

    @property
    def compensated_axes(self) -> Mapping[str, InverseExceedance]:
        """How far each compensated axis has exceeded the range of its inverse."""
        device = self._device
        exceedances = {} if device is None else device.exceedances
        return {self.axes[index]: exceedance for index, exceedance in exceedances.items()}

    @property
    def closed_loops(self) -> Mapping[str, AxisRegulation]:
        """Closed loops, by axis."""
        device = self._device
        regulations = {} if device is None else device.regulations
        return {self.axes[index]: regulation for index, regulation in regulations.items()}

    @property
    def limited_axes(self) -> tuple[str, ...]:
        """The axes whose loop output is limited now."""
        device = self._device
        return () if device is None else tuple(self.axes[index] for index in device.limited_axes)

    def _compensate(self, axis: str, model: InverseModel | None, permit: Permit) -> None:
        index = self._require_open_loop_piezo(axis, "an inverse")
        self._simulate_until_now()
        with _translate_model_errors():
            # This takes a while, and a stop must not wait for it, so it runs outside the gate.
            rest = self._open_device.find_rest(index, model)
            with permit.passing():
                self._open_device.compensate(index, model, rest)

    def _regulate(self, axis: str, regulation: AxisRegulation | None, permit: Permit) -> None:
        index = self._require_open_loop_piezo(axis, "a loop")
        self._simulate_until_now()
        # An uploaded profile was computed for the previous ticks.
        self._profile = None
        with permit.passing(), _translate_model_errors():
            self._open_device.regulate(index, regulation)

    def _require_open_loop_piezo(self, axis: str, purpose: str) -> int:
        """Return the number of an axis; refuse an axis that cannot have an inverse or a loop."""
        model = self.robot.axes[axis]
        if not isinstance(model, PiezoAxis) or model.controller is not None:
            raise LimitError(
                "{name}: axis {axis} is not a piezo in open loop, which {what} needs",
                name=self.name,
                axis=axis,
                what=purpose,
            )
        return self.axes.index(axis)

    def _read_number(self, name: str, min_value: float, max_value: float) -> float:
        value = self.settings[name]
        if isinstance(value, str) or not min_value <= value <= max_value:
            raise DriverSettingError(
                "simulator: setting {name} = {value} is not between {least} and {greatest}",
                name=name,
                value=repr(value),
                least=min_value,
                greatest=max_value,
            )
        return value

    def _compute_start_position(self, fraction: float) -> FloatArray:
        limits = SetpointLimits.of(self.robot)
        return np.asarray(limits.low + fraction * (limits.high - limits.low))

    def _open(self) -> None:
        self._opened_at_s = self.clock()
        self._stop_times_s.clear()
        self._lease_ends_s.clear()
        self._unread.clear()
        self._running_capture = None
        self._profile = None
        self._fault = None
        self._tool_on = False
        self._device = self._make_device(self._position, 0.0)

    def _make_device(self, position: FloatArray, time_s: float) -> SimulatedDevice:
        return SimulatedDevice(
            replace(self.robot, effects=self._effects),
            tick_s=self._tick_s,
            seed=self._seed,
            settle_s=self._settle_s,
            position=position,
            time_s=time_s,
            homing=self._homing,
        )

    def _close(self) -> None:
        self._simulate_until_now()
        self._homing.abort()
        self._position = self._open_device.actuator_command
        self._stop_times_s.clear()
        self._unread.clear()
        self._device = None

    def _status(self) -> DeviceStatus:
        device = self._open_device
        unhomed = tuple(self.axes[index] for index in self._homing.unknown_axes)
        state = DeviceState.MOVING if device.is_moving else DeviceState.IDLE
        if self._fault is not None:
            state = DeviceState.FAULT
        elif device.is_playing:
            state = DeviceState.PLAYING
        elif self._homing.under_way:
            state = DeviceState.HOMING
        return DeviceStatus(state, device.progress, self._fault, not unhomed, unhomed)

    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        self._simulate_until_now()
        with permit.passing():
            for axis, target in targets.items():
                index = self.axes.index(axis)
                self._lease_ends_s.pop(index, None)
                self._open_device.move_to(index, target, speeds.get(axis))

    def _move_velocity(self, velocities: dict[str, float], lease_s: float, permit: Permit) -> None:
        self._simulate_until_now()
        end_s = self.clock() - self._opened_at_s + lease_s
        with permit.passing():
            for axis, velocity in velocities.items():
                index = self.axes.index(axis)
                self._open_device.drive(index, velocity)
                self._lease_ends_s.pop(index, None)
                if velocity:
                    self._lease_ends_s[index] = end_s

    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        self._simulate_until_now()
        with permit.passing():
            self._open_device.home(tuple(self.axes.index(axis) for axis in axes))

    def _set_voltage(self, axis: str, voltage: float, permit: Permit) -> None:
        model = self.robot.axes[axis]
        if not isinstance(model, PiezoAxis) or model.controller is not None:
            raise LimitError(
                "{name}: the controller of axis {axis} sets its voltage", name=self.name, axis=axis
            )
        if axis in self.compensated_axes:
            raise LimitError(
                "{name}: the inverse of axis {axis} sets its voltage; remove the inverse first",
                name=self.name,
                axis=axis,
            )
        if axis in self.closed_loops:
            raise LimitError(
                "{name}: the loop of axis {axis} sets its voltage; open the loop first",
                name=self.name,
                axis=axis,
            )
        try:
            check_target(self.robot, axis, voltage * model.gain)
        except InputError as error:
            raise LimitError(str(error)) from error
        assert model.voltage_range is not None, "the voltage was checked against it"
        max_slew_speed = (
            VOLTAGE_SLEW_RANGES_PER_S
            * (model.voltage_range[1] - model.voltage_range[0])
            * abs(model.gain)
        )
        speed = min(max_slew_speed, model.max_speed or max_slew_speed)
        self._move_to({axis: voltage * model.gain}, {axis: speed}, permit)

    def read_capture(self) -> CapturedSamples | None:
        """Return the samples captured since the previous call, or None if there are none."""
        return self._running_capture.read_captured() if self._running_capture is not None else None

    def _capture(self, axes: tuple[str, ...], rate_hz: float, count: int) -> None:
        self._simulate_until_now()
        columns = tuple(self.axes.index(axis) for axis in axes)
        begin_s = self._open_device.time_s
        self._running_capture = SimulatedCapture(axes, columns, rate_hz, count, begin_s)

    def _commanded(self, axis: str) -> float:
        self._simulate_until_now()
        return float(self._open_device.command[self.axes.index(axis)])

    def _upload(self, profile: MotionProfile, permit: Permit) -> None:
        index = self.axes.index(profile.axis)
        motion = ProfileMotion(
            profile, index, self._commanded(profile.axis), self._open_device.tick_s
        )
        with permit.passing():
            self._profile = motion

    def _trigger(self, permit: Permit) -> None:
        self._simulate_until_now()
        profile, device = self._profile, self._open_device
        if profile is None:
            raise StateError("{name}: there is no profile to run; upload one first", name=self.name)
        if device.is_moving or device.command[profile.index] != profile.start:
            raise StateError(
                "{name}: the axis has moved since the profile was uploaded; wait until it is "
                "at rest, and upload the profile again",
                name=self.name,
            )
        self._profile = None
        with permit.passing():
            device.run_profile(profile)

    def _abort(self) -> None:
        self._simulate_until_now()
        self._profile = None
        if self._open_device.running_profile:
            self._open_device.stop()

    def _play(self, trajectory: Record, permit: Permit) -> None:
        if len(trajectory.time_s) > 1:
            rate_hz = 1.0 / float(np.diff(trajectory.time_s).min())
            if rate_hz > MAX_RATE_HZ * (1.0 + 1e-6):
                raise LimitError(
                    "simulator: the trajectory has {rate_hz} rows per second, but at "
                    "most {max_rate_hz} can be played; resample the trajectory",
                    rate_hz=format_rounded(rate_hz, 6),
                    max_rate_hz=MAX_RATE_HZ,
                )
        self._simulate_until_now()
        playback = self._open_device.prepare_playback(trajectory)
        with permit.passing():
            self._open_device.play(playback)

    def _stop(self) -> None:
        self._tool_on = False
        self._stop_times_s.append(self.clock() - self._opened_at_s)

    def _clear_fault(self, permit: Permit) -> None:
        device = self._make_device(
            self._open_device.actuator_command, self.clock() - self._opened_at_s
        )
        with permit.passing():
            self._stop_times_s.clear()
            self._lease_ends_s.clear()
            self._device = device
            self._fault = None

    def _read(self) -> DeviceSamples:
        # Simulating many samples at once costs about as much as a single one.
        simulated_s = self._open_device.time_s
        if simulated_s < 0.0 or self.clock() - self._opened_at_s - simulated_s >= _MIN_READ_S:
            self._simulate_until_now()
        samples = DeviceSamples.join(self._unread, len(self.axes))
        self._unread.clear()
        return samples

    @property
    def _open_device(self) -> SimulatedDevice:
        assert self._device is not None, "the base class calls hooks only while the device is open"
        return self._device

    def _simulate_until_now(self) -> None:
        """Simulate up to the current time of the clock, with each stop at its requested time."""
        if self._fault is not None:
            return
        device = self._open_device
        now_s = min(self.clock() - self._opened_at_s, device.time_s + MAX_READ_S)
        try:
            while (end_s := self._find_next_end_s()) <= now_s:
                self._store_samples(device.advance(end_s))
                self._end_motion(device, end_s)
            self._store_samples(device.advance(now_s))
            self._set_true_positions(device.true_position)
        except (PlantError, LostLoopError) as error:
            self._fault = str(error)

    def _store_samples(self, parts: list[DeviceSamples]) -> None:
        self._unread += parts
        if self._running_capture is not None:
            for part in parts:
                self._running_capture.take_samples(part)

    def _find_next_end_s(self) -> float:
        """Return the time of the next requested stop or end of a lease."""
        stop_s = self._stop_times_s[0] if self._stop_times_s else float("inf")
        return min(stop_s, min(self._lease_ends_s.values(), default=float("inf")))

    def _end_motion(self, device: SimulatedDevice, time_s: float) -> None:
        if self._stop_times_s and self._stop_times_s[0] <= time_s:
            device.stop()
            # One stop executes all stops requested up to this time.
            while self._stop_times_s and self._stop_times_s[0] <= time_s:
                self._stop_times_s.popleft()
            self._lease_ends_s.clear()
            return
        expired_axes = [index for index, end_s in self._lease_ends_s.items() if end_s <= time_s]
        for index in expired_axes:
            del self._lease_ends_s[index]
            device.drive(index, 0.0)


@contextmanager
def _translate_model_errors() -> Iterator[None]:
    """Convert errors of a model into limit errors of the device."""
    try:
        yield
    except InputError as error:
        raise LimitError(str(error)) from error
