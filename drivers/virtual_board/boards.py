"""One or two boards on their lines, with their machine; time is advanced explicitly.

Time is given by the caller, in seconds since the process began: nothing here waits or looks at a
clock, so a test may let hours pass in minutes.
"""

from math import floor, inf
from typing import Literal

import numpy as np

from rotemina.drivers.mc68hc11.axes import board_axes
from rotemina.drivers.mc68hc11.line_budget import BAUDS, Line
from rotemina.drivers.mc68hc11.protocol_codes import Fault
from rotemina.drivers.virtual_board.clock import BoardClock
from rotemina.drivers.virtual_board.firmware import Firmware
from rotemina.drivers.virtual_board.line import SerialLine
from rotemina.drivers.virtual_board.machine import Machine
from rotemina.drivers.virtual_board.motion_handlers import press
from rotemina.drivers.virtual_board.observer_notes import Notes
from rotemina.drivers.virtual_board.samples import take_samples
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

TICK_S = 5e-4  # the announced captures of 2000 Hz need it
_OFFSETS_US = (5_000_000, (1 << 32) - 60_000_000)  # the second board's clock turns after a minute
_BLOCK = 200  # ticks at once: what the machine keeps of its readings


class Port:
    """The host's end of a line."""

    def __init__(self, boards: "VirtualBoards", line: SerialLine) -> None:
        self._boards = boards
        self._line = line

    @property
    def numbers(self) -> tuple[int, ...]:
        """The boards at its end."""
        return tuple(board.number for board in self._line.boards)

    def receive(self, data: bytes, at_s: float) -> None:
        """Let the host have written these bytes at this time.

        Raises
        ------
        PlantError
            If the motion leaves what a number can hold.
        """
        self._boards.live(at_s)
        self._line.receive(data, self._boards.now_s)

    def advance(self, to_s: float) -> bytes:
        """Advance until this time; return what has reached the host by then.

        Raises
        ------
        PlantError
            If the motion leaves what a number can hold.
        """
        self._boards.live(to_s)
        return self._line.taken(self._boards.now_s)


class VirtualBoards:
    """One machine, one or two boards, one or two serial lines.

    Two ports are a line for each board; one port is a line for the only board of up to three axes,
    or a shared bus with both.

    Parameters
    ----------
    robot : Robot
        With the effects, sensors and noise of its file.
    ports : int
        1 or 2.
    baud : int
    paced : bool
        Whether bytes take as long as the baud rate says, or none.
    seed : int
        Of noise, random effects and disturbances.
    position_known : bool
        Begin homed and without a fault, as after a power-up that was long ago.
    start_fraction : float
        Where in its range each axis stands at first.
    tick_s : float
        Interval between the boards' control ticks.
    crystal_ppm : tuple of float
        How much too fast the crystal of each board is.

    Raises
    ------
    InputError
        If boards cannot move this robot, or there is no such line.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        ports: Literal[1, 2] = 2,
        baud: int = BAUDS[0],
        paced: bool = True,
        seed: int = 0,
        position_known: bool = False,
        start_fraction: float = 0.5,
        tick_s: float = TICK_S,
        crystal_ppm: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        own = board_axes(robot)
        if baud not in BAUDS:
            raise InputError(
                message("engine", "baud {baud}: must be one of {names}").fill(
                    baud=baud, names=", ".join(map(str, BAUDS))
                )
            )
        if ports > len(own):
            raise InputError(
                message(
                    "engine",
                    "robot {name}: its {count} axes need only one board, which has one port; "
                    "leave out the second one",
                ).fill(name=repr(robot.name), count=len(robot.axes))
            )
        self.tick_s = tick_s
        self.notes = Notes()
        axes = tuple(axis for board in own for axis in board)
        ranges = (robot.axes[axis.name].range for axis in axes)
        starts = [low + start_fraction * (high - low) for low, high in ranges]
        position = [axis.value(axis.steps(at)) for axis, at in zip(axes, starts, strict=True)]
        self.machine = Machine(robot, axes, tick_s=tick_s, seed=seed, position=np.array(position))
        shared = ports < len(own)
        speed = Line(baud, half_duplex=shared)
        self.boards = tuple(
            Firmware(
                number,
                robot,
                board,
                self.machine,
                first=sum(map(len, own[: number - 1])),
                clock=BoardClock(tick_s, _OFFSETS_US[number - 1], ppm=crystal_ppm[number - 1]),
                line=speed,
                notes=self.notes,
                tick_s=tick_s,
            )
            for number, board in enumerate(own, start=1)
        )
        self.machine.previews = [board.preview for board in self.boards]
        groups = [self.boards] if shared else [(board,) for board in self.boards]
        self.serial = tuple(
            SerialLine(group, speed, paced=paced, seed=seed + number)
            for number, group in enumerate(groups)
        )
        self.lines = tuple(Port(self, line) for line in self.serial)
        self._tick = 0
        self.now_s = 0.0
        if not position_known:
            for one in self.boards:
                one.power_up(Fault.RESET)

    @property
    def moving(self) -> bool:
        """Whether any axis is on its way."""
        return any(board.moving or board.stream.playing for board in self.boards)

    @property
    def wake_s(self) -> float:
        """When, from the present on, bytes reach the host or a sample is taken next, at latest.

        For whoever has real time to sleep through; bytes that the host writes come on top.
        """
        sample = min((board.reporter.next_tick for board in self.boards), default=inf)
        lines = min(min(line.next_s, line.leaves_s) for line in self.serial)
        return min(sample * self.tick_s, lines)

    def live(self, to_s: float) -> None:
        """Advance until this time, s; a time that is over changes nothing.

        Raises
        ------
        PlantError
            If the motion leaves what a number can hold.
        """
        while True:
            line = min(self.serial, key=lambda one: one.next_s)
            if line.next_s > to_s:
                break
            self.now_s = max(self.now_s, line.next_s)
            self._tick_until(self.now_s)
            line.step()
        self.now_s = max(self.now_s, to_s)
        self._tick_until(self.now_s)

    def rehearse(self) -> None:
        """Move a little and look, so that all that is compiled at its first use is so from now on.

        These boards are used up by it: whoever serves others in real time does it before.
        """
        for drive in self.boards[0].drives:
            drive.move_to(drive.position + 10.0, 1e3)
        self.live(self.now_s + 0.05)
        self.machine.simulate()

    def set_inputs(self, readings: tuple[int, int, int], buttons: int = 0, board: int = 1) -> None:
        """Hold the joystick at a board: three readings of 12 bits, and buttons bit by bit."""
        one = self.boards[board - 1]
        one.readings = list(readings)
        press(one, buttons)

    def lcd(self, board: int = 1) -> tuple[str, ...]:
        """Return the lines that a board's display shows."""
        return tuple(self.boards[board - 1].lcd)

    def _tick_until(self, at_s: float) -> None:
        last = floor(at_s / self.tick_s + 1e-6)
        while self._tick < last:
            first = self._tick + 1
            for board in self.boards:
                board.act(first)
            actions = min((board.next_action() for board in self.boards), default=inf)
            samples = min((board.reporter.next_tick for board in self.boards), default=inf)
            end = int(min(last, first + _BLOCK - 1, max(actions - 1, first), max(samples, first)))
            self._run(end - self._tick)

    def _run(self, ticks: int) -> None:
        """Let some ticks pass at once, and take the samples of the last one."""
        commands = [board.generate(ticks) for board in self.boards]
        self.machine.add(np.concatenate(commands, axis=1))
        self._tick += ticks
        for line in self.serial:
            for board in line.boards:
                if board.reporter.next_tick <= self._tick:
                    line.say(board, take_samples(board), self._tick * self.tick_s)
