"""Optional abilities of devices: each is a base class to be inherited beside others.

The rules are those of :class:`rotemina.drivers.driver.Driver`: final methods check, hooks do.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import final

from rotemina.drivers.capture import Captured, CaptureRates
from rotemina.drivers.driver import Driver
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.gate import Permit, Purpose
from rotemina.drivers.line_quality import LinkQuality
from rotemina.drivers.parameters import ParameterDifference
from rotemina.drivers.profile import Profile
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, marked, message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.axis_limits import is_finite
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory, accepted
from rotemina.sim.trajectory.speed_and_acceleration import SETPOINT_PERIOD_S

LONGEST_LEASE_S = 1.0
DISPLAY_ROWS, DISPLAY_COLUMNS = 2, 20


class VelocityMover(Driver, ABC):
    """A device that moves axes at a speed while its lease is renewed."""

    @final
    def move_velocity(
        self, velocities: Mapping[str, float], lease_s: float, *, permit: Permit | None = None
    ) -> None:
        """Let axes move at these speeds (m/s or rad/s) until the lease runs out. Returns at once.

        Renewed before its end it continues without a jump; not renewed, the axes come to a halt by
        themselves, without a fault, whatever has become of the host. At an end of its range an axis
        halts. Zero halts it at once. Other axes are left to what they do.

        Raises
        ------
        LimitError
            If there is no such axis, a speed is beyond what it may go, or the lease is none of
            0 to 1 s; then no axis moves.
        StateError
            As :meth:`Driver.move_to`.
        """
        permit = self._permitted(permit)
        self.check_velocity(velocities, lease_s)
        self._require_free("move")
        if velocities:
            self._move_velocity(dict(velocities), lease_s, permit)

    @final
    def check_velocity(self, velocities: Mapping[str, float], lease_s: float) -> None:
        """Raise :class:`LimitError` where :meth:`move_velocity` would; asks the device nothing."""
        if not is_finite(lease_s) or not 0.0 < lease_s <= LONGEST_LEASE_S:
            raise LimitError(
                message(
                    "engine",
                    "{name}: lease {lease} s: must be more than 0 s and at most {longest} s",
                ).fill(name=self.name, lease=lease_s, longest=rounded(LONGEST_LEASE_S, 6))
            )
        for axis, speed in velocities.items():
            if axis not in self.robot.axes:
                raise LimitError(
                    message("engine", "{name}: no such axis {axis}; it has {axes}").fill(
                        name=self.name, axis=repr(axis), axes=", ".join(self.axes)
                    )
                )
            most = self.robot.axes[axis].max_speed
            if not is_finite(speed) or (most is not None and abs(speed) > most * (1.0 + 1e-9)):
                bound = (
                    marked("engine", "a finite number")
                    if most is None
                    else message("engine", "at most {most}").fill(most=most)
                )
                raise LimitError(
                    message(
                        "engine",
                        "{name}: axis {axis}: speed {speed} {unit}/s: must be {bound}",
                    ).fill(
                        name=self.name,
                        axis=AxisName(axis),
                        speed=speed,
                        unit=self.robot.unit(axis) or "?",
                        bound=bound,
                    )
                )

    @abstractmethod
    def _move_velocity(self, velocities: dict[str, float], lease_s: float, permit: Permit) -> None:
        """Move at speeds that the axes may go, until the lease runs out."""


class Homer(Driver, ABC):
    """A device that can find out where its axes are, by their limit switches."""

    @property
    @abstractmethod
    def homing_axes(self) -> tuple[str, ...]:
        """The axes that have switches to be found; the others always know where they are."""

    @final
    def home(self, axes: Sequence[str], *, permit: Permit | None = None) -> None:
        """Begin to look for the limit switches of axes; their position is known afterwards.

        Returns at once; the state is ``homing`` meanwhile, and `stop` ends it, position unknown.

        Raises
        ------
        LimitError
            If an axis has no switch to be found.
        StateError
            If the device is closed, in a fault, or not at rest.
        """
        permit = self._permitted(permit, Purpose.HOMING)
        self._require_open("home")
        status = self._status()
        if status.state is not DeviceState.IDLE or status.silent_s > 0.0:
            why = (
                message("engine", "a fault ({fault})").fill(fault=status.fault)
                if status.fault
                else status.state
            )
            raise StateError(
                message("engine", "{name}: cannot home ({why}); wait, stop or clear it first").fill(
                    name=self.name, why=why
                )
            )
        for axis in axes:
            if axis not in self.homing_axes:
                have = ", ".join(self.homing_axes) or marked("engine", "no axis has any")
                raise LimitError(
                    message(
                        "engine", "{name}: axis {axis} has no limit switch; these: {have}"
                    ).fill(name=self.name, axis=repr(axis), have=have)
                )
        if axes:
            self._home(tuple(axes), permit)

    @abstractmethod
    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        """Begin to look for the switches of axes that have some."""


# Ranges of an amplifier a second: faster, a ramp leaves piezos ringing beyond their range.
VOLTAGE_SLEW = 1.0


class VoltageOutput(Driver, ABC):
    """A device whose piezo amplifiers can be given a voltage straight."""

    @final
    def set_voltage(self, axis: str, voltage: float, *, permit: Permit | None = None) -> None:
        """Set a voltage, V, within `VOLTAGE_SLEW`; the next move takes over from it.

        Raises
        ------
        LimitError
            If the axis has no amplifier, or the voltage is beyond its range.
        StateError
            As :meth:`Driver.move_to`.
        """
        permit = self._permitted(permit)
        state = self._require_sound("set a voltage")
        if state is not DeviceState.IDLE:
            raise StateError(
                message(
                    "engine",
                    "{name}: cannot set a voltage while it is {state}; stop it or wait",
                ).fill(name=self.name, state=state)
            )
        bounds = getattr(self.robot.axes.get(axis), "voltage_range", None)
        if bounds is None:
            raise LimitError(
                message("engine", "{name}: axis {axis} has no amplifier with a voltage range").fill(
                    name=self.name, axis=repr(axis)
                )
            )
        if not bounds[0] <= voltage <= bounds[1]:
            raise LimitError(
                message(
                    "engine", "{name}: axis {axis}: {voltage} V: must be {low} to {high} V"
                ).fill(
                    name=self.name,
                    axis=AxisName(axis),
                    voltage=rounded(voltage, 6),
                    low=rounded(bounds[0], 6),
                    high=rounded(bounds[1], 6),
                )
            )
        self._set_voltage(axis, voltage, permit)

    @abstractmethod
    def _set_voltage(self, axis: str, voltage: float, permit: Permit) -> None:
        """Put out a voltage inside the range."""


class Capturer(Driver, ABC):
    """A device that can sample some axes faster than it reports all of them."""

    @property
    @abstractmethod
    def capture_rates(self) -> CaptureRates:
        """How fast it can, Hz."""

    @final
    def capture(self, axes: Sequence[str], rate_hz: float, count: int) -> None:
        """Begin to take samples; :meth:`captured` hands them out. Another capture ends the first.

        Raises
        ------
        LimitError
            If there is no such axis, or the rate or number is beyond what the device can.
        StateError
            If the device is closed.
        """
        self._require_open("capture")
        rates = self.capture_rates
        for axis in axes:
            if axis not in self.robot.axes:
                raise LimitError(
                    message("engine", "{name}: no such axis {axis}; it has {axes}").fill(
                        name=self.name, axis=repr(axis), axes=", ".join(self.axes)
                    )
                )
        if not 1 <= len(axes) <= rates.axes:
            raise LimitError(
                message("engine", "{name}: capture of {axes} axes: must be 1 to {most}").fill(
                    name=self.name, axes=len(axes), most=rates.axes
                )
            )
        most = rates.of(len(axes))
        if not 0.0 < rate_hz <= most:
            raise LimitError(
                message(
                    "engine",
                    "{name}: capture of {axes} axes at {rate_hz} Hz: must be at most {most} Hz",
                ).fill(
                    name=self.name,
                    axes=len(axes),
                    rate_hz=rounded(rate_hz, 6),
                    most=rounded(most, 6),
                )
            )
        if not 1 <= count <= rates.samples:
            raise LimitError(
                message("engine", "{name}: capture of {count} samples: must be 1 to {most}").fill(
                    name=self.name, count=count, most=rates.samples
                )
            )
        self._capture(tuple(axes), rate_hz, count)

    @abstractmethod
    def captured(self) -> Captured | None:
        """Return the samples of the latest capture since the last call."""

    @abstractmethod
    def _capture(self, axes: tuple[str, ...], rate_hz: float, count: int) -> None:
        """Begin a capture that the device can do."""


class ProfileRunner(Driver, ABC):
    """A device that runs a short motion by itself, at its own control rate."""

    @final
    def upload(self, profile: Profile, *, permit: Permit | None = None) -> None:
        """Upload a profile that begins at the axis' position; it waits for :meth:`trigger`.

        Raises
        ------
        LimitError
            If it leaves the range, or is too fast, from where the axis is.
        StateError
            If the device is closed, faulty or not at rest.
        """
        permit = self._permitted(permit)
        state = self._require_sound("accept a profile")
        if state is not DeviceState.IDLE:
            raise StateError(
                message("engine", "{name}: cannot accept a profile while it is {state}").fill(
                    name=self.name, state=state
                )
            )
        try:
            profile.check(self.robot, self._commanded(profile.axis))
        except InputError as error:
            raise LimitError(str(error)) from error
        self._upload(profile, permit)

    @final
    def trigger(self, *, permit: Permit | None = None) -> None:
        """Let the profile run.

        Raises
        ------
        StateError
            If none was uploaded, or the device is not at rest.
        """
        permit = self._permitted(permit)
        self._require_free("run a profile")
        self._trigger(permit)

    @final
    def abort(self) -> None:
        """Forget the profile, or halt it where it is, without a fault; the axis holds there."""
        if self._is_open:
            self._abort()

    @abstractmethod
    def _commanded(self, axis: str) -> float:
        """Return where an axis was commanded last, m or rad."""

    @abstractmethod
    def _upload(self, profile: Profile, permit: Permit) -> None:
        """Hand over a profile that is inside every limit."""

    @abstractmethod
    def _trigger(self, permit: Permit) -> None:
        """Run it; raise :class:`StateError` if there is none."""

    @abstractmethod
    def _abort(self) -> None:
        """Forget or halt it."""


class AnalogInputs(Driver, ABC):
    """A device with a joystick's potentiometers and buttons on it."""

    @abstractmethod
    def analog_inputs(self) -> tuple[tuple[float, ...], tuple[bool, ...]]:
        """Return the latest readings, each 0 to 1, and whether each button is held."""


class Display(Driver, ABC):
    """A device with a small display of 2 × 20 signs."""

    @final
    def show(self, row: int, text: str) -> None:
        """Show text in a row, 0 or 1; what is longer than 20 signs is cut.

        Raises
        ------
        LimitError
            If there is no such row.
        StateError
            If the device is closed.
        """
        self._require_open("show text")
        if not 0 <= row < DISPLAY_ROWS:
            raise LimitError(
                message("engine", "{name}: row {row} of the display: must be 0 or {last}").fill(
                    name=self.name, row=row, last=DISPLAY_ROWS - 1
                )
            )
        self._show(row, text[:DISPLAY_COLUMNS].ljust(DISPLAY_COLUMNS))

    @abstractmethod
    def _show(self, row: int, text: str) -> None:
        """Show a whole row."""


class Parameterised(Driver, ABC):
    """A device that keeps parameters of its own, which may differ from the robot file.

    While they differ and nobody has accepted that, no motion is possible.
    """

    @property
    @abstractmethod
    def differences(self) -> tuple[ParameterDifference, ...]:
        """Where the device's parameters differ from the robot file, as of connecting."""

    @final
    def accept_parameters(self) -> None:
        """Move with the device's parameters as they are, until it is opened again."""
        self._require_open("accept its parameters")
        self._accept_parameters()

    @final
    def write_parameters(self, *, permit: Permit | None = None) -> None:
        """Begin to write the robot file's parameters into the device; it keeps them.

        Raises
        ------
        StateError
            If the device is closed or not at rest.
        """
        permit = self._permitted(permit, Purpose.SERVICE)
        self._require_open("write its parameters")
        state = self._status().state
        if state not in (DeviceState.IDLE, DeviceState.FAULT):
            raise StateError(
                message("engine", "{name}: cannot write its parameters while it is {state}").fill(
                    name=self.name, state=state
                )
            )
        self._write_parameters(permit)

    @abstractmethod
    def _accept_parameters(self) -> None:
        """Take the device's own for good."""

    @abstractmethod
    def _write_parameters(self, permit: Permit) -> None:
        """Begin to write."""


class Linked(Driver, ABC):
    """A device at the end of a line that has a quality."""

    @abstractmethod
    def link_quality(self) -> LinkQuality:
        """Return the quality of the line; sends nothing, never waits, any thread."""


class TrajectoryPlayer(Driver, ABC):
    """A device that plays a whole trajectory on its own clock."""

    @property
    def setpoint_period_s(self) -> float:
        """How often the device applies set-points, s: it holds rows that are farther apart.

        A driver that knows its device says so here; trajectories are judged by it.
        """
        return SETPOINT_PERIOD_S

    @final
    def accept(self, trajectory: Record | CheckedTrajectory) -> CheckedTrajectory:
        """Return what :meth:`play` would play; asks the device nothing.

        One that was checked for this robot and set-point period is not checked again.

        Raises
        ------
        LimitError
            If the trajectory exceeds a limit or is not one for this robot.
        """
        try:
            return accepted(self.robot, trajectory, self.setpoint_period_s)
        except InputError as error:
            raise LimitError(str(error)) from error

    @final
    def play(self, trajectory: Record | CheckedTrajectory, *, permit: Permit | None = None) -> None:
        """Begin to play the ``cmd`` channels of a trajectory. Returns at once.

        The device first goes to the first row within its limits and settles; its samples name the
        row of the trajectory that began to act. Axes that the trajectory does not name hold.

        Raises
        ------
        LimitError
            If the trajectory exceeds a limit or is not one for this robot or device.
        StateError
            If the device is closed, faulty, moving or playing.
        """
        permit = self._permitted(permit)
        state = self._require_sound("play")
        if state is not DeviceState.IDLE:
            raise StateError(
                message("engine", "{name} is still {state}; stop it or wait before playing").fill(
                    name=self.name, state=state
                )
            )
        self._play(self.accept(trajectory).commands, permit)

    @abstractmethod
    def _play(self, trajectory: Record, permit: Permit) -> None:
        """Begin to play a trajectory that is inside every limit.

        Each set-point on the way passes ``permit.passing(begins=False)``.
        """
