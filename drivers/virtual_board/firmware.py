"""Firmware of one virtual board: its control ticks, and how it halts.

The firmware is called only at ticks at which something is due. Its drives generate the commands for
all ticks in between. Frames are handled in ``request_handlers.py`` and ``motion_handlers.py``.
"""

from math import inf

import numpy as np

from rotemina.drivers.mc68hc11 import LineCapacity
from rotemina.drivers.mc68hc11.protocol import (
    LCD_COLUMNS,
    LCD_ROWS,
    BoardAxis,
    BoardFault,
    BoardState,
    SerialFrame,
    WireMessage,
)
from rotemina.drivers.virtual_board.axis_drive import AxisDrive
from rotemina.drivers.virtual_board.clock import TIME_MASK, CrystalClock
from rotemina.drivers.virtual_board.homing import HomingAxis
from rotemina.drivers.virtual_board.machine import BoardMachine
from rotemina.drivers.virtual_board.observer_notes import BoardEventLog, StopNote
from rotemina.drivers.virtual_board.parameter_memory import ParameterMemory
from rotemina.drivers.virtual_board.profile_motion import OnBoardProfile
from rotemina.drivers.virtual_board.reporter import BoardReporter
from rotemina.drivers.virtual_board.setpoint_stream import SetpointStream
from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot import Robot

_DEFAULT_WATCHDOG_US = 500_000
# Intervals between checks of the limit switches while steppers move, far from a switch and near it.
_SWITCH_CHECK_S, _NEAR_SWITCH_CHECK_S = 10e-3, 1e-3
# A stepper is near a switch if at full speed it can reach the switch within this many intervals.
_NEAR_SWITCH_INTERVALS = 2.0
_JOYSTICK_CENTRE = 2048


class BoardFirmware:
    """Firmware of a virtual board with up to three axes.

    Parameters
    ----------
    number : int
        Address of the board, 1 or 2.
    robot : Robot
    axes : sequence of BoardAxis
    machine : BoardMachine
        Machine with the axes of all boards.
    first_machine_index : int
        Index of the board's first axis in the machine.
    clock : CrystalClock
    line : LineCapacity
        Capacity of the serial line.
    notes : BoardEventLog
    tick_s : float
    """

    def __init__(
        self,
        number: int,
        robot: Robot,
        axes: tuple[BoardAxis, ...],
        machine: BoardMachine,
        *,
        first_machine_index: int,
        clock: CrystalClock,
        line: LineCapacity,
        notes: BoardEventLog,
        tick_s: float,
    ) -> None:
        self.number = number
        self.robot = robot
        self.axes = axes
        self.machine = machine
        self.machine_indices = range(first_machine_index, first_machine_index + len(axes))
        self.clock = clock
        self.line_capacity = line
        self.notes = notes
        self.tick_s = tick_s
        self.parameters = ParameterMemory(robot, axes)
        self.is_stepper = [bool(machine.is_stepper[index]) for index in self.machine_indices]
        # Latest tick whose commands have been generated.
        self.latest_tick = 0
        self.joystick_readings = [_JOYSTICK_CENTRE] * 3
        self.buttons = 0
        positions = (
            machine.position[index] / machine.step_size[index] for index in self.machine_indices
        )
        self.drives = [AxisDrive(tick_s, round(position)) for position in positions]
        self._clear_memory()
        self.is_position_known, self.fault = True, BoardFault.NONE
        for axis, drive in enumerate(self.drives):
            self.apply_limits(axis, drive)

    def _clear_memory(self) -> None:
        self.stream, self.profile = SetpointStream(), OnBoardProfile()
        self.homing: dict[int, HomingAxis] = {}
        # Tick at which the lease of a motion at a speed expires, by axis.
        self.lease_end_ticks: dict[int, int] = {}
        self.homed_axes: set[int] = set()
        # Number of the latest received frame, and the answer to it.
        self.last_exchange: tuple[int, SerialFrame | None] | None = None
        self.watchdog_us = _DEFAULT_WATCHDOG_US
        self.watchdog_tick: int | None = None
        self.reporter = BoardReporter(waits_for_poll=self.line_capacity.half_duplex)
        self._next_frame_number = 0
        self.lcd = [" " * LCD_COLUMNS] * LCD_ROWS
        # Direction of the latest motion of each axis.
        self.last_directions = [0.0] * len(self.axes)
        self._latest_commands = np.array([drive.position for drive in self.drives])
        # Steps moved in the latest tick, by axis.
        self._steps_per_tick = np.zeros(len(self.axes))
        self._stop_received_s: float | None = None

    def apply_limits(self, axis: int, drive: AxisDrive) -> None:
        """Set the limits of a drive from the parameters."""
        parameters = self.parameters
        drive.set_limits(
            *parameters.get_limits(axis),
            parameters.get_max_speed(axis),
            parameters.get_max_acceleration(axis),
        )

    def reset(self, fault: BoardFault) -> None:
        """Restart as after power-up. The positions of the steppers are unknown."""
        self.parameters.recall(self.now_s)
        for axis, drive in enumerate(self.drives):
            self.apply_limits(axis, drive)
        self._clear_memory()
        self.clock = CrystalClock(self.tick_s, since_s=self.latest_tick * self.tick_s)
        self.power_up(fault)

    def power_up(self, fault: BoardFault) -> None:
        """Set the counters of the steppers to zero, and ramp the voltages of the piezos to zero."""
        self.fault = fault
        self.is_position_known = not any(self.is_stepper)
        for axis, index in enumerate(self.machine_indices):
            if self.is_stepper[axis]:
                self.machine.set_counters(index, 0, 0)
                self.drives[axis] = AxisDrive(self.tick_s, 0.0)
                self.apply_limits(axis, self.drives[axis])
            else:
                drive = self.drives[axis]
                drive.ramp(
                    round(self.parameters.find_rest_position(axis)),
                    self.parameters.compute_slew(axis),
                )
        self._latest_commands = np.array([drive.position for drive in self.drives])
        self._record_event(f"fault {fault.name}")

    @property
    def now_s(self) -> float:
        """Simulated time of the latest tick, s."""
        return self.latest_tick * self.tick_s

    @property
    def moving(self) -> bool:
        """Whether an axis is moving by itself, that is, not by streamed set-points."""
        is_drive_moving = any(drive.moving for drive in self.drives)
        return is_drive_moving or bool(self.homing) or self.profile.running

    @property
    def state(self) -> BoardState:
        """State that telemetry reports."""
        capture = self.reporter.capture
        is_capturing = capture is not None and capture.begin_tick <= self.latest_tick
        return BoardState(
            BoardState.MOVING * self.moving
            | BoardState.PLAYING * (self.stream.playing or self.profile.running)
            | BoardState.HOMING * bool(self.homing)
            | BoardState.FAULT * bool(self.fault)
            | BoardState.CAPTURING * is_capturing
            | BoardState.ARMED * (self.profile.trigger is not None)
            | BoardState.POSITION_UNKNOWN * (not self.is_position_known)
            | BoardState.WRITING * self.parameters.is_writing(self.now_s)
        )

    def stop(self, received_s: float) -> None:
        """Execute a stop that was received at the time ``received_s``."""
        # A repeated stop does not count as another stop.
        if self._stop_received_s is None:
            self._stop_received_s = received_s
            self.notes.add_event(received_s, f"board {self.number}: stop heard")
        self.halt(BoardFault.STOPPED)

    def halt(self, fault: BoardFault) -> None:
        """Bring all axes to rest. Steppers brake, and piezos keep their voltage.

        After a late set-point and at a soft limit, steppers stop without braking.
        """
        if self.fault is BoardFault.NONE:
            self.fault = fault
            self._record_event(f"fault {fault.name}")
        speeds = self._get_driven_speeds()
        must_stop_at_once = fault in (BoardFault.LATE_SETPOINT, BoardFault.SOFT_LIMIT)
        for axis, drive in enumerate(self.drives):
            if not self.is_stepper[axis] or must_stop_at_once:
                drive.hold()
            elif axis in speeds:
                drive.place(drive.position, speeds[axis])
            else:
                drive.halt()
        self.stream.clear()
        self.profile.end()
        self.lease_end_ticks.clear()
        self.reporter.capture = None
        self.end_homing()

    def _get_driven_speeds(self) -> dict[int, float]:
        """Return the speeds, steps/s, of axes that a stream or a profile moves, by axis number."""
        speeds = {}
        if self.stream.playing:
            speeds = {axis: speed / self.tick_s for axis, speed in enumerate(self.stream.speeds)}
        if self.profile.running:
            speeds[self.profile.axis] = float(self._steps_per_tick[self.profile.axis]) / self.tick_s
        return speeds

    def end_homing(self) -> None:
        """End homing, whether it is completed or not."""
        for axis in self.homing:
            self.apply_limits(axis, self.drives[axis])
        self.homing.clear()

    def end_profile(self) -> None:
        """Delete the profile, and halt its axis if the profile is running. This is not a fault."""
        axis, was_running = self.profile.axis, self.profile.running
        speed = self._get_driven_speeds().get(axis, 0.0)
        self.profile.clear()
        if was_running:
            drive = self.drives[axis]
            drive.place(drive.position, speed if self.is_stepper[axis] else 0.0)

    def process_tick(self, tick: int) -> None:
        """Do everything that is due at a tick, before its commands are generated."""
        if self._has_moving_stepper():
            self.machine.simulate()
            self._check_switches()
            self._continue_homing()
        for axis in [axis for axis, end_tick in self.lease_end_ticks.items() if end_tick <= tick]:
            del self.lease_end_ticks[axis]
            self.drives[axis].halt()
        if self.watchdog_tick is not None and self.watchdog_tick <= tick:
            self.watchdog_tick = None
            self.halt(BoardFault.WATCHDOG)
        self._play_stream(tick)

    def _has_moving_stepper(self) -> bool:
        if self.stream.playing:
            return any(self.is_stepper)
        if self.profile.running and self.is_stepper[self.profile.axis]:
            return True
        return bool(self.homing) or any(
            is_stepper and drive.moving
            for is_stepper, drive in zip(self.is_stepper, self.drives, strict=True)
        )

    def _check_switches(self) -> None:
        for axis, index in enumerate(self.machine_indices):
            if not self.is_stepper[axis] or axis in self.homing:
                continue
            is_low_closed, is_high_closed = self.machine.read_switches(index)
            drive = self.drives[axis]
            direction = drive.velocity if drive.moving else self.last_directions[axis]
            if (is_low_closed and direction < 0.0) or (is_high_closed and direction > 0.0):
                if self.fault is BoardFault.NONE:
                    self.halt(BoardFault.LIMIT_SWITCH)
                return

    def _continue_homing(self) -> None:
        for axis, homing in list(self.homing.items()):
            index = self.machine_indices[axis]
            if homing.follow_switch(self.machine.read_switches(index)[0]):
                switch_position = -self.parameters.get_zero_distance(axis)
                self.machine.set_counters(index, switch_position, switch_position)
                homing.set_zero()
            if homing.is_complete:
                self.homed_axes.add(axis)
        if self.homing and all(homing.is_complete for homing in self.homing.values()):
            self.end_homing()
            stepper_axes = {axis for axis, is_stepper in enumerate(self.is_stepper) if is_stepper}
            self.is_position_known = self.is_position_known or stepper_axes <= self.homed_axes
            self._record_event("homed" if self.is_position_known else "homed some axes")

    def _play_stream(self, tick: int) -> None:
        point = self.stream.take_due_point(tick)
        if point is not None:
            for drive, position in zip(self.drives, point.position, strict=False):
                drive.place(position)
        if self._is_stream_late(tick):
            self.halt(BoardFault.LATE_SETPOINT)

    def _is_stream_late(self, tick: int) -> bool:
        return (
            self.stream.is_starving
            and self.clock.find_tick(self.stream.next_start_us, tick) <= tick
        )

    def find_next_due_tick(self) -> float:
        """Return the next tick at which something is due."""
        ticks = [*self.lease_end_ticks.values()]
        ticks += [tick for tick in (self.watchdog_tick, self.stream.next_tick) if tick is not None]
        if self.stream.is_starving:
            ticks.append(self.clock.find_tick(self.stream.next_start_us, self.latest_tick))
        if self._has_moving_stepper():
            ticks.append(self.latest_tick + 1 + self._count_ticks_to_switch_check())
        return min(ticks, default=inf)

    def _count_ticks_to_switch_check(self) -> int:
        for axis, index in enumerate(self.machine_indices):
            margin_m = (
                _NEAR_SWITCH_INTERVALS
                * _SWITCH_CHECK_S
                * self.parameters.get_max_speed(axis)
                * self.machine.step_size[index]
            )
            if self.is_stepper[axis] and self.machine.is_near_switch(index, margin_m):
                return max(1, round(_NEAR_SWITCH_CHECK_S / self.tick_s))
        return max(1, round(_SWITCH_CHECK_S / self.tick_s))

    def generate(self, ticks: int) -> FloatArray:
        """Generate the commands (ticks, axes) of the next ticks, whole steps."""
        previous = self._latest_commands
        if not self.moving and self._stop_received_s is None:
            self._latest_commands = np.array([drive.position for drive in self.drives])
            self._update_directions(previous)
            self.latest_tick += ticks
            return np.tile(np.rint(self._latest_commands), (ticks, 1))
        commands = np.empty((ticks, len(self.axes)))
        for axis, drive in enumerate(self.drives):
            if self.profile.running and axis == self.profile.axis:
                commands[:, axis] = self._run_profile(ticks, drive)
            else:
                commands[:, axis] = drive.generate(ticks)
        self.latest_tick += ticks
        second_last_commands = commands[-2] if ticks > 1 else previous
        self._steps_per_tick = commands[-1] - second_last_commands
        self._latest_commands = commands[-1].copy()
        self._update_directions(previous)
        commands = np.rint(commands)
        if self._stop_received_s is not None and not any(drive.moving for drive in self.drives):
            self._record_standstill(commands, previous)
        return commands

    def _update_directions(self, previous: FloatArray) -> None:
        for axis, change in enumerate(np.sign(self._latest_commands - previous)):
            self.last_directions[axis] = float(change) or self.last_directions[axis]

    def preview(self, ticks: int) -> FloatArray | None:
        """Return the next commands (ticks, axes) if no frame arrives, or None if they are unknown.

        While a stream plays, there are fewer commands: those up to the last queued set-point.
        """
        if self.profile.running:
            return None
        if self.stream.playing:
            positions = tuple(drive.position for drive in self.drives)
            return np.rint(self.stream.preview(self.latest_tick, ticks, positions))
        commands = [drive.preview(ticks) for drive in self.drives]
        return np.rint(np.stack(commands, axis=1))

    def _run_profile(self, ticks: int, drive: AxisDrive) -> FloatArray:
        """Move the axis of a profile, and return its positions (ticks,), steps."""
        profile, axis = self.profile, self.profile.axis
        assert profile.start_tick is not None, "a running profile has a start tick"
        start_us = self.clock.find_time_us(profile.start_tick)
        tick_numbers = range(self.latest_tick + 1, self.latest_tick + 1 + ticks)
        elapsed_us = np.array(
            [
                self.clock.find_time_us(tick_number) - start_us & TIME_MASK
                for tick_number in tick_numbers
            ]
        )
        elapsed_ticks = np.rint(elapsed_us / (1e6 * self.tick_s)).astype(np.int64)
        positions = profile.evaluate_positions(elapsed_ticks)
        low, high = self.parameters.get_limits(axis)
        outside_indices = np.flatnonzero((np.rint(positions) < low) | (np.rint(positions) > high))
        if len(outside_indices):
            first_outside = outside_indices[0]
            positions[first_outside:] = (
                positions[first_outside - 1] if first_outside else drive.position
            )
        drive.place(float(positions[-1]))
        if len(outside_indices):
            self.halt(BoardFault.SOFT_LIMIT)
        elif elapsed_ticks[-1] >= profile.duration_ticks:
            profile.end()
        return positions

    def _record_standstill(self, commands: FloatArray, previous: FloatArray) -> None:
        has_changed = np.diff(np.vstack((np.rint(previous), commands)), axis=0).any(axis=1)
        last_change = int(np.flatnonzero(has_changed)[-1]) + 1 if has_changed.any() else 0
        rest_s = (self.latest_tick - len(commands) + last_change) * self.tick_s
        assert self._stop_received_s is not None, "called only after a stop was received"
        received_s = self._stop_received_s
        self._stop_received_s = None
        self.notes.add_stop(StopNote(self.number, received_s, max(rest_s, received_s)))

    def make_frame(self, message: WireMessage) -> SerialFrame:
        """Return the frame of a message, with the next frame number of the board."""
        number = self._next_frame_number
        self._next_frame_number = (number + 1) % 256
        return SerialFrame(self.number, number, message.TYPE, message.pack(), from_board=True)

    def _record_event(self, text: str) -> None:
        self.notes.add_event(self.now_s, f"board {self.number}: {text}")
