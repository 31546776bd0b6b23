"""The firmware of one virtual board: its control tick, and how it halts.

It is called at the ticks at which something is due, and lets its drives generate what lies between.
What frames ask of it is in ``messages.py``.
"""

from math import inf

import numpy as np

from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.mc68hc11.framing import Frame
from rotemina.drivers.mc68hc11.line_budget import Line
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import LCD_COLUMNS, LCD_ROWS, Fault, State
from rotemina.drivers.virtual_board.axis_drive import AxisDrive
from rotemina.drivers.virtual_board.clock import MASK, BoardClock
from rotemina.drivers.virtual_board.homing import HomingAxis
from rotemina.drivers.virtual_board.machine import Machine
from rotemina.drivers.virtual_board.observer_notes import Notes, StopNote
from rotemina.drivers.virtual_board.parameter_memory import ParameterMemory
from rotemina.drivers.virtual_board.profile_motion import Profile
from rotemina.drivers.virtual_board.reporter import Reporter
from rotemina.drivers.virtual_board.setpoint_stream import Stream
from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import Robot

_WATCH_US = 500_000
_LOOK_S, _LOOK_CLOSER_S = 10e-3, 1e-3  # between looks at the switches of steppers that move
_MARGIN_S = 2.0  # looks at full speed: from there on the board looks closer
_CENTRE = 2048


class Firmware:
    """A board with up to three axes.

    Parameters
    ----------
    number : int
        Its address, 1 or 2.
    robot : Robot
    axes : sequence of BoardAxis
    machine : Machine
        What it moves, with the axes of all boards.
    first : int
        The number of its first axis in the machine.
    clock : BoardClock
    line : Line
        What its serial line can carry.
    notes : Notes
    tick_s : float
    """

    def __init__(
        self,
        number: int,
        robot: Robot,
        axes: tuple[BoardAxis, ...],
        machine: Machine,
        *,
        first: int,
        clock: BoardClock,
        line: Line,
        notes: Notes,
        tick_s: float,
    ) -> None:
        self.number = number
        self.robot = robot
        self.axes = axes
        self.machine = machine
        self.indices = range(first, first + len(axes))
        self.clock = clock
        self.line = line
        self.notes = notes
        self.tick_s = tick_s
        self.kept = ParameterMemory(robot, axes)
        self.steppers = [bool(machine.stepper[index]) for index in self.indices]
        self.now = 0  # the latest tick that is over
        self.readings = [_CENTRE] * 3
        self.buttons = 0
        begin = (machine.position[index] / machine.step[index] for index in self.indices)
        self.drives = [AxisDrive(tick_s, round(at)) for at in begin]
        self._clear_memory()
        self.known, self.fault = True, Fault.NONE
        for axis, drive in enumerate(self.drives):
            self.rebound(axis, drive)

    def _clear_memory(self) -> None:
        """Begin as after power came."""
        self.stream, self.profile = Stream(), Profile()
        self.homing: dict[int, HomingAxis] = {}
        self.leases: dict[int, int] = {}
        self.homed: set[int] = set()
        self.last: tuple[int, Frame | None] | None = None  # number and answer
        self.watch_us = _WATCH_US
        self.watch_tick: int | None = None
        self.reporter = Reporter(waits=self.line.half_duplex)
        self._said = 0
        self.lcd = [" " * LCD_COLUMNS] * LCD_ROWS
        self.ways = [0.0] * len(self.axes)  # in which direction each axis went last
        self._ends = np.array([drive.position for drive in self.drives])  # the latest commands
        self._speed = np.zeros(len(self.axes))  # steps a tick, of the latest one
        self._stop_heard_s: float | None = None

    def rebound(self, axis: int, drive: AxisDrive) -> None:
        """Let a drive keep to what the parameters say."""
        kept = self.kept
        drive.bound(*kept.limits(axis), kept.speed(axis), kept.acceleration(axis))

    def reset(self, fault: Fault) -> None:
        """Restart as after power-up: the positions of the steppers are unknown."""
        self.kept.recall(self.now_s)
        for axis, drive in enumerate(self.drives):
            self.rebound(axis, drive)
        self._clear_memory()
        self.clock = BoardClock(self.tick_s, since_s=self.now * self.tick_s)
        self.power_up(fault)

    def power_up(self, fault: Fault) -> None:
        """Count from where the steppers are, and let the piezos' voltage go to zero as it may."""
        self.fault = fault
        self.known = not any(self.steppers)
        for axis, index in enumerate(self.indices):
            if self.steppers[axis]:
                self.machine.count_from_here(index, 0, 0)
                self.drives[axis] = AxisDrive(self.tick_s, 0.0)
                self.rebound(axis, self.drives[axis])
            else:
                drive = self.drives[axis]
                drive.ramp(round(self.kept.rest(axis)), self.kept.slew(axis))
        self._ends = np.array([drive.position for drive in self.drives])
        self._note(f"fault {fault.name}")

    @property
    def now_s(self) -> float:
        """The latest tick, as time of the process."""
        return self.now * self.tick_s

    @property
    def moving(self) -> bool:
        """Whether an axis is on its way by something else than set-points."""
        drives = any(drive.moving for drive in self.drives)
        return drives or bool(self.homing) or self.profile.running

    @property
    def state(self) -> State:
        """What telemetry says."""
        capture = self.reporter.capture
        capturing = capture is not None and capture.begins <= self.now
        return State(
            State.MOVING * self.moving
            | State.PLAYING * (self.stream.playing or self.profile.running)
            | State.HOMING * bool(self.homing)
            | State.FAULT * bool(self.fault)
            | State.CAPTURING * capturing
            | State.ARMED * (self.profile.trigger is not None)
            | State.POSITION_UNKNOWN * (not self.known)
            | State.WRITING * self.kept.writing(self.now_s)
        )

    def stop(self, heard_s: float) -> None:
        """Carry out a stop that was heard at this time."""
        if self._stop_heard_s is None:  # one that is said again is the same
            self._stop_heard_s = heard_s
            self.notes.say(heard_s, f"board {self.number}: stop heard")
        self.halt(Fault.STOPPED)

    def halt(self, fault: Fault) -> None:
        """Bring everything to rest: steppers brake, piezos keep their voltage."""
        if self.fault is Fault.NONE:
            self.fault = fault
            self._note(f"fault {fault.name}")
        speeds = self._speeds()
        at_once = fault in (Fault.LATE_SETPOINT, Fault.SOFT_LIMIT)
        for axis, drive in enumerate(self.drives):
            if not self.steppers[axis] or at_once:
                drive.hold()
            elif axis in speeds:
                drive.place(drive.position, speeds[axis])
            else:
                drive.halt()
        self.stream.clear()
        self.profile.end()
        self.leases.clear()
        self.reporter.capture = None
        self.end_homing()

    def _speeds(self) -> dict[int, float]:
        """Return how fast axes go, steps/s, that are not moved by their drives."""
        speeds = {}
        if self.stream.playing:
            speeds = {axis: speed / self.tick_s for axis, speed in enumerate(self.stream.speeds)}
        if self.profile.running:
            speeds[self.profile.axis] = float(self._speed[self.profile.axis]) / self.tick_s
        return speeds

    def end_homing(self) -> None:
        """Leave homing, done or not."""
        for axis in self.homing:
            self.rebound(axis, self.drives[axis])
        self.homing.clear()

    def end_profile(self) -> None:
        """Halt the axis of a running profile; no fault."""
        axis, running = self.profile.axis, self.profile.running
        speed = self._speeds().get(axis, 0.0)
        self.profile.clear()
        if running:
            drive = self.drives[axis]
            drive.place(drive.position, speed if self.steppers[axis] else 0.0)

    def act(self, tick: int) -> None:
        """Do what is due at a tick, before its command is generated."""
        if self._steppers_move():
            self.machine.simulate()
            self._look_at_switches()
            self._go_on_homing()
        for axis in [axis for axis, end in self.leases.items() if end <= tick]:
            del self.leases[axis]
            self.drives[axis].halt()
        if self.watch_tick is not None and self.watch_tick <= tick:
            self.watch_tick = None
            self.halt(Fault.WATCHDOG)
        self._play(tick)

    def _steppers_move(self) -> bool:
        if self.stream.playing:
            return any(self.steppers)
        if self.profile.running and self.steppers[self.profile.axis]:
            return True
        own = zip(self.steppers, self.drives, strict=True)
        return bool(self.homing) or any(stepper and drive.moving for stepper, drive in own)

    def _look_at_switches(self) -> None:
        for axis, index in enumerate(self.indices):
            if not self.steppers[axis] or axis in self.homing:
                continue
            low, high = self.machine.closed(index)
            drive = self.drives[axis]
            way = drive.velocity if drive.moving else self.ways[axis]
            if (low and way < 0.0) or (high and way > 0.0):
                if self.fault is Fault.NONE:
                    self.halt(Fault.LIMIT_SWITCH)
                return

    def _go_on_homing(self) -> None:
        for axis, homing in list(self.homing.items()):
            index = self.indices[axis]
            if homing.step(self.machine.closed(index)[0]):
                zero = -self.kept.way_to_zero(axis)
                self.machine.count_from_here(index, zero, zero)
                homing.count()
            if homing.done:
                self.homed.add(axis)
        if self.homing and all(homing.done for homing in self.homing.values()):
            self.end_homing()
            steppers = {axis for axis, stepper in enumerate(self.steppers) if stepper}
            self.known = self.known or steppers <= self.homed
            self._note("homed" if self.known else "homed in part")

    def _play(self, tick: int) -> None:
        point = self.stream.due(tick)
        if point is not None:
            for drive, position in zip(self.drives, point.position, strict=False):
                drive.place(position)
        if self._starving(tick):
            self.halt(Fault.LATE_SETPOINT)

    def _starving(self, tick: int) -> bool:
        """Whether the stream's next segment should begin by a tick, and is not here."""
        return self.stream.starves and self.clock.tick_at(self.stream.starts_us, tick) <= tick

    def next_action(self) -> float:
        """Return the next tick at which something is due, beyond the present block."""
        ticks = [*self.leases.values()]
        ticks += [one for one in (self.watch_tick, self.stream.next_tick) if one is not None]
        if self.stream.starves:
            ticks.append(self.clock.tick_at(self.stream.starts_us, self.now))
        if self._steppers_move():
            ticks.append(self.now + 1 + self._until_look())
        return min(ticks, default=inf)

    def _until_look(self) -> int:
        for axis, index in enumerate(self.indices):
            margin_m = _MARGIN_S * _LOOK_S * self.kept.speed(axis) * self.machine.step[index]
            if self.steppers[axis] and self.machine.near_switch(index, margin_m):
                return max(1, round(_LOOK_CLOSER_S / self.tick_s))
        return max(1, round(_LOOK_S / self.tick_s))

    def generate(self, ticks: int) -> FloatArray:
        """Return the commands (ticks, axes) of the next ticks, whole steps."""
        before = self._ends
        if not self.moving and self._stop_heard_s is None:
            self._ends = np.array([drive.position for drive in self.drives])
            self._note_ways(before)
            self.now += ticks
            return np.tile(np.rint(self._ends), (ticks, 1))
        commands = np.empty((ticks, len(self.axes)))
        for axis, drive in enumerate(self.drives):
            if self.profile.running and axis == self.profile.axis:
                commands[:, axis] = self._profile(ticks, drive)
            else:
                commands[:, axis] = drive.generate(ticks)
        self.now += ticks
        last = commands[-2] if ticks > 1 else before
        self._speed = commands[-1] - last
        self._ends = commands[-1].copy()
        self._note_ways(before)
        commands = np.rint(commands)
        if self._stop_heard_s is not None and not any(drive.moving for drive in self.drives):
            self._note_rest(commands, before)
        return commands

    def _note_ways(self, before: FloatArray) -> None:
        for axis, change in enumerate(np.sign(self._ends - before)):
            self.ways[axis] = float(change) or self.ways[axis]

    def preview(self, ticks: int) -> FloatArray | None:
        """Return the coming commands (ticks, axes) if no frame arrives, or None if unknown.

        While set-points play, these are fewer: up to the last one that waits.
        """
        if self.profile.running:
            return None
        if self.stream.playing:
            held = tuple(drive.position for drive in self.drives)
            return np.rint(self.stream.preview(self.now, ticks, held))
        ahead = [drive.preview(ticks) for drive in self.drives]
        return np.rint(np.stack(ahead, axis=1))

    def _profile(self, ticks: int, drive: AxisDrive) -> FloatArray:
        """Return the positions (ticks,) of the axis that a profile moves."""
        profile, axis = self.profile, self.profile.axis
        assert profile.since is not None, "it runs"
        begin_us = self.clock.at_tick(profile.since)
        numbers = range(self.now + 1, self.now + 1 + ticks)
        elapsed_us = np.array([self.clock.at_tick(one) - begin_us & MASK for one in numbers])
        elapsed = np.rint(elapsed_us / (1e6 * self.tick_s)).astype(np.int64)
        positions = profile.positions(elapsed)
        low, high = self.kept.limits(axis)
        beyond = np.flatnonzero((np.rint(positions) < low) | (np.rint(positions) > high))
        if len(beyond):
            positions[beyond[0] :] = positions[beyond[0] - 1] if beyond[0] else drive.position
        drive.place(float(positions[-1]))
        if len(beyond):
            self.halt(Fault.SOFT_LIMIT)
        elif elapsed[-1] >= profile.ticks:
            profile.end()
        return positions

    def _note_rest(self, commands: FloatArray, before: FloatArray) -> None:
        changes = np.diff(np.vstack((np.rint(before), commands)), axis=0).any(axis=1)
        last = int(np.flatnonzero(changes)[-1]) + 1 if changes.any() else 0
        rest_s = (self.now - len(commands) + last) * self.tick_s
        assert self._stop_heard_s is not None, "the caller looked"
        heard_s = self._stop_heard_s
        self._stop_heard_s = None
        self.notes.stopped(StopNote(self.number, heard_s, max(rest_s, heard_s)))

    def framed(self, message: Message) -> Frame:
        """Return a frame of the board's own count."""
        number = self._said
        self._said = (number + 1) % 256
        return Frame(self.number, number, message.TYPE, message.packed(), from_board=True)

    def _note(self, text: str) -> None:
        self.notes.say(self.now_s, f"board {self.number}: {text}")
