"""Optional abilities of devices. Each ability is a base class from which a driver may inherit.

As in :class:`rotemina.drivers.contract.Driver`, final methods check a request, and hooks execute
it.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, final

from rotemina.drivers.abilities.capture import CapturedSamples, CaptureRates
from rotemina.drivers.abilities.profile import MotionProfile
from rotemina.drivers.contract import (
    DeviceState,
    Driver,
    LimitError,
    LinkQuality,
    Permit,
    PermitPurpose,
    StateError,
)
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, format_rounded, marked, message
from rotemina.sim.records import Record
from rotemina.sim.trajectory import (
    DEFAULT_SETPOINT_PERIOD_S,
    CheckedTrajectory,
    accept_trajectory,
    is_finite,
)

MAX_LEASE_S = 1.0
DISPLAY_ROWS, DISPLAY_COLUMNS = 2, 20


class VelocityMover(Driver, ABC):
    """A device that moves axes at a speed while its lease is renewed."""

    @final
    def move_velocity(
        self, velocities: Mapping[str, float], lease_s: float, *, permit: Permit | None = None
    ) -> None:
        """Move axes at these speeds (m/s or rad/s) until the lease runs out. Returns at once.

        Another call before the end of the lease continues the motion without a jump. Otherwise the
        device halts the axes, without a fault, even if the host has crashed. An axis also halts at
        the end of its range. A speed of zero halts an axis at once. Axes that are not named
        continue as before.

        Raises
        ------
        LimitError
            If there is no such axis, a speed exceeds the axis' limit, or the lease is not more
            than 0 s and at most 1 s; then no axis moves.
        StateError
            See :meth:`Driver.move_to`.
        """
        permit = self._require_permit(permit)
        self.check_velocity(velocities, lease_s)
        self._require_not_busy("move")
        if velocities:
            self._move_velocity(dict(velocities), lease_s, permit)

    @final
    def check_velocity(self, velocities: Mapping[str, float], lease_s: float) -> None:
        """Raise the :class:`LimitError` that :meth:`move_velocity` would raise, if any."""
        if not is_finite(lease_s) or not 0.0 < lease_s <= MAX_LEASE_S:
            raise LimitError(
                "{name}: lease of {lease} s: must be more than 0 s and at most {longest} s",
                name=self.name,
                lease=lease_s,
                longest=format_rounded(MAX_LEASE_S, 6),
            )
        for axis, speed in velocities.items():
            if axis not in self.robot.axes:
                raise LimitError(
                    "{name}: no such axis {axis}; it has {axes}",
                    name=self.name,
                    axis=repr(axis),
                    axes=", ".join(self.axes),
                )
            max_speed = self.robot.axes[axis].max_speed
            if not is_finite(speed) or (
                max_speed is not None and abs(speed) > max_speed * (1.0 + 1e-9)
            ):
                bound = (
                    marked("engine", "a finite number")
                    if max_speed is None
                    else message("engine", "at most {most}").fill(most=max_speed)
                )
                raise LimitError(
                    "{name}: axis {axis}: speed {speed} {unit}/s: must be {bound}",
                    name=self.name,
                    axis=AxisName(axis),
                    speed=speed,
                    unit=self.robot.unit(axis) or "?",
                    bound=bound,
                )

    @abstractmethod
    def _move_velocity(self, velocities: dict[str, float], lease_s: float, permit: Permit) -> None:
        """Move at these speeds until the lease runs out; the limits have been checked."""


class AxisHomer(Driver, ABC):
    """A device that finds the positions of its axes with limit switches."""

    @property
    @abstractmethod
    def homing_axes(self) -> tuple[str, ...]:
        """The axes that can be homed. The positions of all other axes are always known."""

    @final
    def home(self, axes: Sequence[str], *, permit: Permit | None = None) -> None:
        """Start searching for the limit switches of axes, which gives their positions.

        Returns at once; during the search the state is ``homing``. `stop` ends the search and
        leaves the positions unknown.

        Raises
        ------
        LimitError
            If an axis has no limit switch.
        StateError
            If the device is closed, has a fault, or is not at rest.
        """
        permit = self._require_permit(permit, PermitPurpose.HOMING)
        self._require_open("home")
        status = self._status()
        if status.state is not DeviceState.IDLE or status.silent_s > 0.0:
            obstacle = (
                message("engine", "a fault ({fault})").fill(fault=status.fault)
                if status.fault
                else status.state
            )
            raise StateError(
                "{name}: cannot home ({why}); wait, stop or clear it first",
                name=self.name,
                why=obstacle,
            )
        for axis in axes:
            if axis not in self.homing_axes:
                available_axes = ", ".join(self.homing_axes) or marked("engine", "no axis")
                raise LimitError(
                    "{name}: axis {axis} has no limit switch; axes with one: {have}",
                    name=self.name,
                    axis=repr(axis),
                    have=available_axes,
                )
        if axes:
            self._home(tuple(axes), permit)

    @abstractmethod
    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        """Start searching for the limit switches of axes that can be homed."""


# In ranges of the amplifier per second. A faster ramp makes piezos ring beyond their range.
VOLTAGE_SLEW_RANGES_PER_S = 1.0


class VoltageOutput(Driver, ABC):
    """A device that sets the voltages of its piezo amplifiers directly."""

    @final
    def set_voltage(self, axis: str, voltage: float, *, permit: Permit | None = None) -> None:
        """Ramp to a voltage, V, no faster than `VOLTAGE_SLEW_RANGES_PER_S`.

        The next move starts from the position that results.

        Raises
        ------
        LimitError
            If the axis has no amplifier, or the voltage is beyond its range.
        StateError
            See :meth:`Driver.move_to`.
        """
        permit = self._require_permit(permit)
        state = self._require_operational("set a voltage")
        if state is not DeviceState.IDLE:
            raise StateError(
                "{name}: cannot set a voltage while it is {state}; stop it or wait",
                name=self.name,
                state=state,
            )
        bounds = getattr(self.robot.axes.get(axis), "voltage_range", None)
        if bounds is None:
            raise LimitError(
                "{name}: axis {axis} has no amplifier with a voltage range",
                name=self.name,
                axis=repr(axis),
            )
        if not bounds[0] <= voltage <= bounds[1]:
            raise LimitError(
                "{name}: axis {axis}: {voltage} V: must be {low} to {high} V",
                name=self.name,
                axis=AxisName(axis),
                voltage=format_rounded(voltage, 6),
                low=format_rounded(bounds[0], 6),
                high=format_rounded(bounds[1], 6),
            )
        self._set_voltage(axis, voltage, permit)

    @abstractmethod
    def _set_voltage(self, axis: str, voltage: float, permit: Permit) -> None:
        """Ramp to a voltage that is within the range."""


class FastCapturer(Driver, ABC):
    """A device that samples some axes faster than it reports all of them."""

    @property
    @abstractmethod
    def capture_rates(self) -> CaptureRates:
        """The largest rates and numbers of samples of a capture."""

    @final
    def capture(self, axes: Sequence[str], rate_hz: float, count: int) -> None:
        """Start a capture; :meth:`read_capture` returns its samples. This ends an earlier capture.

        Raises
        ------
        LimitError
            If there is no such axis, or the rate or the number of samples is too large.
        StateError
            If the device is closed.
        """
        self._require_open("capture")
        rates = self.capture_rates
        for axis in axes:
            if axis not in self.robot.axes:
                raise LimitError(
                    "{name}: no such axis {axis}; it has {axes}",
                    name=self.name,
                    axis=repr(axis),
                    axes=", ".join(self.axes),
                )
        if not 1 <= len(axes) <= rates.max_axes:
            raise LimitError(
                "{name}: capture of {axes} axes: must be 1 to {most}",
                name=self.name,
                axes=len(axes),
                most=rates.max_axes,
            )
        max_rate_hz = rates.max_rate_for(len(axes))
        if not 0.0 < rate_hz <= max_rate_hz:
            raise LimitError(
                "{name}: capture of {axes} axes at {rate_hz} Hz: must be at most {most} Hz",
                name=self.name,
                axes=len(axes),
                rate_hz=format_rounded(rate_hz, 6),
                most=format_rounded(max_rate_hz, 6),
            )
        if not 1 <= count <= rates.max_samples:
            raise LimitError(
                "{name}: capture of {count} samples: must be 1 to {most}",
                name=self.name,
                count=count,
                most=rates.max_samples,
            )
        self._capture(tuple(axes), rate_hz, count)

    @abstractmethod
    def read_capture(self) -> CapturedSamples | None:
        """Return the samples of the latest capture since the previous call, or None."""

    @abstractmethod
    def _capture(self, axes: tuple[str, ...], rate_hz: float, count: int) -> None:
        """Start a capture that is within :attr:`capture_rates`."""

    # Former names, which are supported for one more release.
    captured = FormerMember("read_capture")


class ProfileRunner(Driver, ABC):
    """A device that runs a short motion by itself, at its own control rate."""

    @final
    def upload(self, profile: MotionProfile, *, permit: Permit | None = None) -> None:
        """Upload a profile that begins at the axis' position; :meth:`trigger` starts it.

        Raises
        ------
        LimitError
            If the profile leaves the axis' range from its current position, or is too fast.
        StateError
            If the device is closed, has a fault, or is not at rest.
        """
        permit = self._require_permit(permit)
        state = self._require_operational("accept a profile")
        if state is not DeviceState.IDLE:
            raise StateError(
                "{name}: cannot accept a profile while it is {state}", name=self.name, state=state
            )
        try:
            profile.check(self.robot, self._commanded(profile.axis))
        except InputError as error:
            raise LimitError(str(error)) from error
        self._upload(profile, permit)

    @final
    def trigger(self, *, permit: Permit | None = None) -> None:
        """Start the uploaded profile.

        Raises
        ------
        StateError
            If no profile was uploaded, or the device is not at rest.
        """
        permit = self._require_permit(permit)
        self._require_not_busy("run a profile")
        self._trigger(permit)

    @final
    def abort(self) -> None:
        """Discard the profile. A running profile is halted without a fault, and the axis holds."""
        if self._is_open:
            self._abort()

    @abstractmethod
    def _commanded(self, axis: str) -> float:
        """Return the last commanded position of an axis, m or rad."""

    @abstractmethod
    def _upload(self, profile: MotionProfile, permit: Permit) -> None:
        """Upload a profile that is within all limits."""

    @abstractmethod
    def _trigger(self, permit: Permit) -> None:
        """Start the profile; raise :class:`StateError` if there is none."""

    @abstractmethod
    def _abort(self) -> None:
        pass


class AnalogInputs(Driver, ABC):
    """A device with the potentiometers and buttons of a joystick."""

    @abstractmethod
    def analog_inputs(self) -> tuple[tuple[float, ...], tuple[bool, ...]]:
        """Return the latest readings of the potentiometers, 0 to 1, and which buttons are held."""


class TextDisplay(Driver, ABC):
    """A device with a small display of 2 × 20 characters."""

    @final
    def show(self, row: int, text: str) -> None:
        """Show text in a row, 0 or 1. Longer text is truncated to 20 characters.

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
                "{name}: row {row} of the display: must be 0 or {last}",
                name=self.name,
                row=row,
                last=DISPLAY_ROWS - 1,
            )
        self._show(row, text[:DISPLAY_COLUMNS].ljust(DISPLAY_COLUMNS))

    @abstractmethod
    def _show(self, row: int, text: str) -> None:
        """Show text of exactly the length of a row."""


class LinkReporter(Driver, ABC):
    """A device that reports the quality of its line."""

    @abstractmethod
    def link_quality(self) -> LinkQuality:
        """Return the quality of the line. Sends nothing, never waits; any thread may call it."""


class TrajectoryPlayer(Driver, ABC):
    """A device that plays a whole trajectory on its own clock."""

    @property
    def setpoint_period_s(self) -> float:
        """Time between two set-points of the device, s.

        The device holds each row of a trajectory until the next. A driver overrides this property
        with the period of its device. Trajectories are checked against this period.
        """
        return DEFAULT_SETPOINT_PERIOD_S

    @final
    def accept(self, trajectory: Record | CheckedTrajectory) -> CheckedTrajectory:
        """Return the checked trajectory that :meth:`play` would play; sends nothing.

        A trajectory that was already checked for this robot and set-point period is returned
        unchanged.

        Raises
        ------
        LimitError
            If the trajectory exceeds a limit or is made for another robot.
        """
        try:
            return accept_trajectory(self.robot, trajectory, self.setpoint_period_s)
        except InputError as error:
            raise LimitError(str(error)) from error

    @final
    def play(self, trajectory: Record | CheckedTrajectory, *, permit: Permit | None = None) -> None:
        """Start playing the ``cmd`` channels of a trajectory. Returns at once.

        The device first moves to the first row, within its limits, and settles. Its samples contain
        the row of the trajectory that is in effect. Axes without a ``cmd`` channel hold.

        Raises
        ------
        LimitError
            If the trajectory exceeds a limit or is made for another robot or device.
        StateError
            If the device is closed, has a fault, moves or plays.
        """
        permit = self._require_permit(permit)
        state = self._require_operational("play")
        if state is not DeviceState.IDLE:
            raise StateError(
                "{name} is still {state}; stop it or wait before playing",
                name=self.name,
                state=state,
            )
        self._play(self.accept(trajectory).commands, permit)

    @abstractmethod
    def _play(self, trajectory: Record, permit: Permit) -> None:
        """Start playing a trajectory that is within all limits.

        Send each later set-point inside ``with permit.passing(begins=False):``.
        """


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Capturer="FastCapturer",
        Display="TextDisplay",
        Homer="AxisHomer",
        LONGEST_LEASE_S="MAX_LEASE_S",
        Linked="LinkReporter",
        Parameterised="rotemina.drivers.abilities.parameters.ParameterStore",
        VOLTAGE_SLEW="VOLTAGE_SLEW_RANGES_PER_S",
    )
