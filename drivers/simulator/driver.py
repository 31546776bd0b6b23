"""The simulator: a robot with its effects behind the same contract as a real device."""

import time
from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from types import MappingProxyType
from typing import ClassVar

import numpy as np

from rotemina.drivers.abilities import (
    VOLTAGE_SLEW,
    Capturer,
    Homer,
    ProfileRunner,
    TrajectoryPlayer,
    VelocityMover,
    VoltageOutput,
)
from rotemina.drivers.capture import Captured, CaptureRates
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.gate import Permit
from rotemina.drivers.model_abilities import Compensator, EffectCarrier, Regulator
from rotemina.drivers.profile import Profile
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.drivers.simulator.device import SimulatedDevice
from rotemina.drivers.simulator.fast_captures import Capturing
from rotemina.drivers.simulator.front_panel import FrontPanel
from rotemina.drivers.simulator.homing import Homing
from rotemina.drivers.simulator.profile_motion import ProfileMotion
from rotemina.drivers.simulator.true_positions import TruePositions
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.errors import InputError
from rotemina.sim.feedback.errors import LostLoopError
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.messages import message
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import AxisEffect, ForceAxis, PiezoAxis, Robot, StepperAxis
from rotemina.sim.trajectory.axis_limits import check_target
from rotemina.sim.trajectory.setpoint_limits import SetpointLimits

MAX_RATE_HZ = 20_000.0
_PORTION_S = 0.016  # device time that is simulated at once when somebody only reads
MAX_READ_S = 5.0  # device time that one call simulates at most; the rest waits for the next
MAX_CAPTURE = 100_000  # samples


class Simulator(
    TrajectoryPlayer,
    VelocityMover,
    Homer,
    VoltageOutput,
    Capturer,
    ProfileRunner,
    FrontPanel,
    TruePositions,
    EffectCarrier,
    Compensator,
    Regulator,
):
    """A machine that behaves as its robot file says.

    Device time is the clock's time since ``open``; what happened since the last call is simulated
    when a call asks for it, so the clock may be real or set by hand. A request takes effect at the
    next tick after the clock's present. A robot with controllers runs under them. After being
    closed and opened again, the machine stands where its last set-point was. Effects are those of
    the robot file until others are set.

    Settings: ``sample_rate_hz`` of samples and set-points; ``seed`` of noise and random effects;
    ``settle_s`` at the first row of a trajectory; ``start_fraction`` of its range at which each
    axis first stands; ``start_homed``: whether the steppers know at first where that is.
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
        self._tick_s = 1.0 / self._number("sample_rate_hz", 1.0, MAX_RATE_HZ)
        self._settle_s = self._number("settle_s", 0.0, 60.0)
        self._seed = int(self._number("seed", 0, 2**63))
        for axis in robot.axes.values():
            if isinstance(axis, ForceAxis) and axis.controller is None:
                raise SettingError(
                    message(
                        "engine",
                        "simulator: robot {name} has a force axis without a controller; add "
                        "one to the robot file",
                    ).fill(name=repr(robot.name))
                )
        self._position = self._start_position(self._number("start_fraction", 0.0, 1.0))
        self._are_at(self._position)
        start_homed = self.settings["start_homed"]
        self._homing = Homing(() if start_homed else map(self.axes.index, self.homing_axes))
        self._capturing: Capturing | None = None
        self._profile: ProfileMotion | None = None
        self._opened_at_s = 0.0
        self._device: SimulatedDevice | None = None
        self._effects = robot.effects
        self._fault: str | None = None
        # Appended to by any thread, which a deque allows; emptied by the driver's own thread.
        self._stops_s: deque[float] = deque()
        self._leases_s: dict[int, float] = {}  # when each ends, by the axis' number
        self._unread: list[Samples] = []

    @property
    def setpoint_period_s(self) -> float:
        """The interval between samples, at which loops are closed too, s."""
        return self._tick_s

    @property
    def stop_pending(self) -> bool:
        """Whether a requested stop lies ahead of the simulated time."""
        return bool(self._stops_s)

    @property
    def effects(self) -> tuple[AxisEffect, ...]:
        """The effects in place, those that are switched off among them."""
        return self._effects

    @property
    def homing_axes(self) -> tuple[str, ...]:
        """The steppers: a piezo's sensor always knows where it is."""
        axes = self.robot.axes.items()
        return tuple(name for name, axis in axes if isinstance(axis, StepperAxis))

    @property
    def capture_rates(self) -> CaptureRates:
        """All axes at the rate of the samples, from which a capture is taken."""
        rate_hz = 1.0 / self._tick_s
        return CaptureRates(rate_hz, rate_hz, len(self.axes), MAX_CAPTURE)

    def _set_effects(self, effects: tuple[AxisEffect, ...], permit: Permit) -> None:
        self._catch_up()
        plant, state = self._running.with_effects(effects)
        with permit.passing():
            self._running.use(plant, state)
            self._effects = effects

    @property
    def compensated(self) -> Mapping[str, Exceedance]:
        """The axes whose set-points go through an inverse, and in what each has gone beyond it."""
        device = self._device
        found = {} if device is None else device.compensated
        return {self.axes[index]: said for index, said in found.items()}

    @property
    def regulated(self) -> Mapping[str, Regulation]:
        """The loops that are closed, by axis."""
        device = self._device
        found = {} if device is None else device.regulated
        return {self.axes[index]: one for index, one in found.items()}

    @property
    def regulation_limited(self) -> tuple[str, ...]:
        """The axes whose loop asks for more than a limit allows at present."""
        device = self._device
        return () if device is None else tuple(self.axes[index] for index in device.limited)

    def _compensate(self, axis: str, model: InverseModel | None, permit: Permit) -> None:
        index = self._open_loop_piezo(axis, "an inverse")
        self._catch_up()
        with _as_limit():
            rest = self._running.rest(index, model)  # it takes a while, for which no stop may wait
            with permit.passing():
                self._running.compensate(index, model, rest)

    def _regulate(self, axis: str, regulation: Regulation | None, permit: Permit) -> None:
        index = self._open_loop_piezo(axis, "a loop")
        self._catch_up()
        self._profile = None  # it was made for the ticks before
        with permit.passing(), _as_limit():
            self._running.regulate(index, regulation)

    def _open_loop_piezo(self, axis: str, what: str) -> int:
        """Return the number of an axis that may have an inverse, or a loop."""
        described = self.robot.axes[axis]
        if not isinstance(described, PiezoAxis) or described.controller is not None:
            raise LimitError(
                message(
                    "engine",
                    "{name}: axis {axis} is not a piezo in open loop, which {what} needs",
                ).fill(name=self.name, axis=axis, what=what)
            )
        return self.axes.index(axis)

    def _number(self, name: str, least: float, greatest: float) -> float:
        value = self.settings[name]
        if isinstance(value, str) or not least <= value <= greatest:
            raise SettingError(
                message(
                    "engine",
                    "simulator: setting {name} = {value} is not between {least} and {greatest}",
                ).fill(name=name, value=repr(value), least=least, greatest=greatest)
            )
        return value

    def _start_position(self, fraction: float) -> FloatArray:
        limits = SetpointLimits.of(self.robot)
        return np.asarray(limits.low + fraction * (limits.high - limits.low))

    def _open(self) -> None:
        self._opened_at_s = self.clock()
        self._stops_s.clear()
        self._leases_s.clear()
        self._unread.clear()
        self._capturing = None
        self._profile = None
        self._fault = None
        self._tool_on = False
        self._device = self._made(self._position, 0.0)

    def _made(self, position: FloatArray, time_s: float) -> SimulatedDevice:
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
        self._catch_up()
        self._homing.give_up()
        self._position = self._running.sent
        self._stops_s.clear()
        self._unread.clear()
        self._device = None

    def _status(self) -> DeviceStatus:
        device = self._running
        unhomed = tuple(self.axes[index] for index in self._homing.unknown)
        state = DeviceState.MOVING if device.moving else DeviceState.IDLE
        if self._fault is not None:
            state = DeviceState.FAULT
        elif device.playing:
            state = DeviceState.PLAYING
        elif self._homing.under_way:
            state = DeviceState.HOMING
        return DeviceStatus(state, device.progress, self._fault, not unhomed, unhomed)

    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        self._catch_up()
        with permit.passing():
            for axis, target in targets.items():
                index = self.axes.index(axis)
                self._leases_s.pop(index, None)
                self._running.move_to(index, target, speeds.get(axis))

    def _move_velocity(self, velocities: dict[str, float], lease_s: float, permit: Permit) -> None:
        self._catch_up()
        ends_s = self.clock() - self._opened_at_s + lease_s
        with permit.passing():
            for axis, velocity in velocities.items():
                index = self.axes.index(axis)
                self._running.drive(index, velocity)
                self._leases_s.pop(index, None)
                if velocity:
                    self._leases_s[index] = ends_s

    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        self._catch_up()
        with permit.passing():
            self._running.home(tuple(self.axes.index(axis) for axis in axes))

    def _set_voltage(self, axis: str, voltage: float, permit: Permit) -> None:
        model = self.robot.axes[axis]
        if not isinstance(model, PiezoAxis) or model.controller is not None:
            raise LimitError(
                message(
                    "engine",
                    "{name}: the controller of axis {axis} sets its voltage",
                ).fill(name=self.name, axis=axis)
            )
        if axis in self.compensated:
            raise LimitError(
                message(
                    "engine",
                    "{name}: the inverse of axis {axis} sets its voltage; remove the inverse first",
                ).fill(name=self.name, axis=axis)
            )
        if axis in self.regulated:
            raise LimitError(
                message(
                    "engine",
                    "{name}: the loop of axis {axis} sets its voltage; open the loop first",
                ).fill(name=self.name, axis=axis)
            )
        try:
            check_target(self.robot, axis, voltage * model.gain)
        except InputError as error:
            raise LimitError(str(error)) from error
        assert model.voltage_range is not None, "the voltage is within it"
        slew = VOLTAGE_SLEW * (model.voltage_range[1] - model.voltage_range[0]) * abs(model.gain)
        speed = min(slew, model.max_speed or slew)
        self._move_to({axis: voltage * model.gain}, {axis: speed}, permit)

    def captured(self) -> Captured | None:
        """Return what the reads since it was last asked for have brought, or None: nothing."""
        return self._capturing.handed_out() if self._capturing is not None else None

    def _capture(self, axes: tuple[str, ...], rate_hz: float, count: int) -> None:
        self._catch_up()
        columns = tuple(self.axes.index(axis) for axis in axes)
        begin_s = self._running.time_s
        self._capturing = Capturing(axes, columns, rate_hz, count, begin_s)

    def _commanded(self, axis: str) -> float:
        self._catch_up()
        return float(self._running.command[self.axes.index(axis)])

    def _upload(self, profile: Profile, permit: Permit) -> None:
        index = self.axes.index(profile.axis)
        made = ProfileMotion(profile, index, self._commanded(profile.axis), self._running.tick_s)
        with permit.passing():
            self._profile = made

    def _trigger(self, permit: Permit) -> None:
        self._catch_up()
        profile, device = self._profile, self._running
        if profile is None:
            raise StateError(
                message("engine", "{name}: there is no profile to run; upload one first").fill(
                    name=self.name
                )
            )
        if device.moving or device.command[profile.index] != profile.start:
            raise StateError(
                message(
                    "engine",
                    "{name}: the axis of the profile has moved since; wait until it rests, and "
                    "upload the profile again",
                ).fill(name=self.name)
            )
        self._profile = None
        with permit.passing():
            device.run(profile)

    def _abort(self) -> None:
        self._catch_up()
        self._profile = None
        if self._running.running_profile:
            self._running.stop()

    def _play(self, trajectory: Record, permit: Permit) -> None:
        if len(trajectory.time_s) > 1:
            rate_hz = 1.0 / float(np.diff(trajectory.time_s).min())
            if rate_hz > MAX_RATE_HZ * (1.0 + 1e-6):
                raise LimitError(
                    message(
                        "engine",
                        "simulator: the trajectory has {rate_hz} rows per second, but at "
                        "most {max_rate_hz} can be played; resample the trajectory",
                    ).fill(rate_hz=rounded(rate_hz, 6), max_rate_hz=MAX_RATE_HZ)
                )
        self._catch_up()
        playing = self._running.playing_of(trajectory)
        with permit.passing():
            self._running.play(playing)

    def _stop(self) -> None:
        self._tool_on = False
        self._stops_s.append(self.clock() - self._opened_at_s)

    def _clear_fault(self, permit: Permit) -> None:
        device = self._made(self._running.sent, self.clock() - self._opened_at_s)
        with permit.passing():
            self._stops_s.clear()
            self._leases_s.clear()
            self._device = device
            self._fault = None

    def _read(self) -> Samples:
        # A portion costs as much as a single sample: it is worth while to wait for one.
        since_s = self._running.time_s
        if since_s < 0.0 or self.clock() - self._opened_at_s - since_s >= _PORTION_S:
            self._catch_up()
        samples = Samples.joined(self._unread, len(self.axes))
        self._unread.clear()
        return samples

    @property
    def _running(self) -> SimulatedDevice:
        assert self._device is not None, "the base class calls hooks of an open device only"
        return self._device

    def _catch_up(self) -> None:
        """Simulate up to the clock's present, with every stop at the time it was requested."""
        if self._fault is not None:
            return
        device = self._running
        now_s = min(self.clock() - self._opened_at_s, device.time_s + MAX_READ_S)
        try:
            while (end_s := self._next_end_s()) <= now_s:
                self._keep(device.advance(end_s))
                self._end(device, end_s)
            self._keep(device.advance(now_s))
            self._are_at(device.true_position)
        except (PlantError, LostLoopError) as error:
            self._fault = str(error)

    def _keep(self, parts: list[Samples]) -> None:
        self._unread += parts
        if self._capturing is not None:
            for part in parts:
                self._capturing.take(part)

    def _next_end_s(self) -> float:
        """Return when the next stop was requested, or a lease runs out."""
        stop_s = self._stops_s[0] if self._stops_s else float("inf")
        return min(stop_s, min(self._leases_s.values(), default=float("inf")))

    def _end(self, device: SimulatedDevice, at_s: float) -> None:
        """Carry out the stop, or the end of the leases, of this time."""
        if self._stops_s and self._stops_s[0] <= at_s:
            device.stop()
            while self._stops_s and self._stops_s[0] <= at_s:  # one stop is as good as many
                self._stops_s.popleft()
            self._leases_s.clear()
            return
        for index in [index for index, end_s in self._leases_s.items() if end_s <= at_s]:
            del self._leases_s[index]
            device.drive(index, 0.0)


@contextmanager
def _as_limit() -> Iterator[None]:
    """Tell what a model does not allow as a limit of the device."""
    try:
        yield
    except InputError as error:
        raise LimitError(str(error)) from error
