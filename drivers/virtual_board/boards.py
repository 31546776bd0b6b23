"""One or two boards on their lines, with their machine. The caller advances the time.

Times are simulated, in seconds since the start. The code neither waits nor reads a clock, so a test
can simulate hours in minutes.
"""

from math import floor, inf
from typing import Literal

import numpy as np

from rotemina.drivers.mc68hc11 import BAUD_RATES, LineCapacity
from rotemina.drivers.mc68hc11.protocol import BoardFault, make_board_axes
from rotemina.drivers.virtual_board.clock import CrystalClock
from rotemina.drivers.virtual_board.firmware import BoardFirmware
from rotemina.drivers.virtual_board.line import SerialLine
from rotemina.drivers.virtual_board.machine import BoardMachine
from rotemina.drivers.virtual_board.motion_handlers import press_buttons
from rotemina.drivers.virtual_board.observer_notes import BoardEventLog
from rotemina.drivers.virtual_board.samples import take_samples
from rotemina.sim.errors import InputError
from rotemina.sim.robot import Robot

# The offered capture rate of 2000 Hz needs ticks of this length.
DEFAULT_TICK_S = 5e-4
# The clocks start at different times. That of the second board wraps after a minute.
_CLOCK_OFFSETS_US = (5_000_000, (1 << 32) - 60_000_000)
# Maximum number of ticks that are generated at once. The machine must keep more readings than this
# for captures.
_MAX_BLOCK_TICKS = 200


class LinePort:
    """Host end of a line."""

    def __init__(self, boards: "VirtualBoards", line: SerialLine) -> None:
        self._boards = boards
        self._line = line

    @property
    def board_numbers(self) -> tuple[int, ...]:
        """Numbers of the boards on the line."""
        return tuple(board.number for board in self._line.boards)

    def receive(self, data: bytes, at_s: float) -> None:
        """Receive bytes that the host has written at the time ``at_s``.

        Raises
        ------
        PlantError
            If the motion exceeds the range of floating-point numbers.
        """
        self._boards.advance(at_s)
        self._line.receive(data, self._boards.now_s)

    def advance(self, to_s: float) -> bytes:
        """Advance to the time ``to_s``, and return the bytes that have reached the host by then.

        Raises
        ------
        PlantError
            If the motion exceeds the range of floating-point numbers.
        """
        self._boards.advance(to_s)
        return self._line.take_bytes(self._boards.now_s)


class VirtualBoards:
    """One or two virtual boards with their machine, on one or two serial lines.

    With two ports each board has its own line. With one port there is either a single board with up
    to three axes, or two boards on a shared bus.

    Parameters
    ----------
    robot : Robot
        Robot with the effects, sensors and noise of its file.
    ports : int
        1 or 2.
    baud : int
    paced : bool
        Whether bytes take the time that the baud rate implies. Otherwise they take no time.
    seed : int
        Seed of noise, random effects and disturbances.
    position_known : bool
        Whether the boards start homed and without a fault. Otherwise they start as after power-up.
    start_fraction : float
        Position of each axis at the start, as a fraction of its range.
    tick_s : float
        Interval between the control ticks of the boards.
    crystal_ppm : tuple of float
        Relative error of the crystal of each board, ppm. A positive error makes the clock fast.

    Raises
    ------
    InputError
        If boards cannot move this robot, or the baud rate or the number of ports is wrong.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        ports: Literal[1, 2] = 2,
        baud: int = BAUD_RATES[0],
        paced: bool = True,
        seed: int = 0,
        position_known: bool = False,
        start_fraction: float = 0.5,
        tick_s: float = DEFAULT_TICK_S,
        crystal_ppm: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        axes_of_boards = make_board_axes(robot)
        if baud not in BAUD_RATES:
            raise InputError(
                "baud {baud}: must be one of {names}",
                baud=baud,
                names=", ".join(map(str, BAUD_RATES)),
            )
        if ports > len(axes_of_boards):
            raise InputError(
                "robot {name}: its {count} axes need only one board, which has one port; "
                "leave out the second one",
                name=repr(robot.name),
                count=len(robot.axes),
            )
        self.tick_s = tick_s
        self.notes = BoardEventLog()
        axes = tuple(axis for board_axes in axes_of_boards for axis in board_axes)
        ranges = (robot.axes[axis.name].range for axis in axes)
        starts = [low + start_fraction * (high - low) for low, high in ranges]
        position = [
            axis.to_si(axis.to_steps(start)) for axis, start in zip(axes, starts, strict=True)
        ]
        self.machine = BoardMachine(
            robot, axes, tick_s=tick_s, seed=seed, position=np.array(position)
        )
        is_shared = ports < len(axes_of_boards)
        capacity = LineCapacity(baud, half_duplex=is_shared)
        self.boards = tuple(
            BoardFirmware(
                number,
                robot,
                board_axes,
                self.machine,
                first_machine_index=sum(map(len, axes_of_boards[: number - 1])),
                clock=CrystalClock(
                    tick_s, _CLOCK_OFFSETS_US[number - 1], ppm=crystal_ppm[number - 1]
                ),
                line=capacity,
                notes=self.notes,
                tick_s=tick_s,
            )
            for number, board_axes in enumerate(axes_of_boards, start=1)
        )
        self.machine.previews = [board.preview for board in self.boards]
        groups = [self.boards] if is_shared else [(board,) for board in self.boards]
        self.serial_lines = tuple(
            SerialLine(group, capacity, paced=paced, seed=seed + number)
            for number, group in enumerate(groups)
        )
        self.host_ports = tuple(LinePort(self, line) for line in self.serial_lines)
        self._tick = 0
        self.now_s = 0.0
        if not position_known:
            for firmware in self.boards:
                firmware.power_up(BoardFault.RESET)

    @property
    def moving(self) -> bool:
        """Whether any axis is moving."""
        return any(board.moving or board.stream.playing for board in self.boards)

    @property
    def next_event_s(self) -> float:
        """Time at which the next bytes reach the host or the next sample is taken, s.

        A program that runs in real time may sleep until then, unless the host writes bytes.
        """
        sample_tick = min((board.reporter.next_tick for board in self.boards), default=inf)
        line_event_s = min(
            min(line.next_event_s, line.next_departure_s) for line in self.serial_lines
        )
        return min(sample_tick * self.tick_s, line_event_s)

    def advance(self, to_s: float) -> None:
        """Advance to the time ``to_s``. A time in the past has no effect.

        Raises
        ------
        PlantError
            If the motion exceeds the range of floating-point numbers.
        """
        while True:
            line = min(self.serial_lines, key=lambda serial_line: serial_line.next_event_s)
            if line.next_event_s > to_s:
                break
            self.now_s = max(self.now_s, line.next_event_s)
            self._tick_until(self.now_s)
            line.process_next()
        self.now_s = max(self.now_s, to_s)
        self._tick_until(self.now_s)

    def warm_up(self) -> None:
        """Move the axes a little, so that all just-in-time compiled code is compiled.

        The axes are not moved back. So a program that runs in real time warms up a separate set of
        boards first.
        """
        for drive in self.boards[0].drives:
            drive.move_to(drive.position + 10.0, 1e3)
        self.advance(self.now_s + 0.05)
        self.machine.simulate()

    def set_inputs(self, readings: tuple[int, int, int], buttons: int = 0, board: int = 1) -> None:
        """Set the joystick of a board: three 12-bit readings, and the pressed buttons as bits."""
        firmware = self.boards[board - 1]
        firmware.joystick_readings = list(readings)
        press_buttons(firmware, buttons)

    def read_lcd(self, board: int = 1) -> tuple[str, ...]:
        """Return the rows of a board's display."""
        return tuple(self.boards[board - 1].lcd)

    def _tick_until(self, at_s: float) -> None:
        last_tick = floor(at_s / self.tick_s + 1e-6)
        while self._tick < last_tick:
            next_tick = self._tick + 1
            for board in self.boards:
                board.process_tick(next_tick)
            action_tick = min((board.find_next_due_tick() for board in self.boards), default=inf)
            sample_tick = min((board.reporter.next_tick for board in self.boards), default=inf)
            end_tick = int(
                min(
                    last_tick,
                    next_tick + _MAX_BLOCK_TICKS - 1,
                    max(action_tick - 1, next_tick),
                    max(sample_tick, next_tick),
                )
            )
            self._run_ticks(end_tick - self._tick)

    def _run_ticks(self, ticks: int) -> None:
        commands = [board.generate(ticks) for board in self.boards]
        self.machine.add_commands(np.concatenate(commands, axis=1))
        self._tick += ticks
        for line in self.serial_lines:
            for board in line.boards:
                if board.reporter.next_tick <= self._tick:
                    line.send_messages(board, take_samples(board), self._tick * self.tick_s)
