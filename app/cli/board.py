"""``rotemina board``: virtual boards with a simulated machine, for a host to connect to."""

import argparse
import gc
import os
import selectors
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Literal

from rotemina.app.cli.board_ports import HostPort, PseudoTerminal, Socket
from rotemina.app.cli.options import add_robot, robot_of, tell_model
from rotemina.app.cli.termination import termination_requested
from rotemina.drivers.mc68hc11.axes import board_axes
from rotemina.drivers.mc68hc11.line_budget import BAUDS
from rotemina.drivers.virtual_board.boards import VirtualBoards
from rotemina.drivers.virtual_board.fault_injection import FaultCommandError, RandomFaults, inject
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

_WAKE_S, _SLEEP_S = 1e-3, 20e-3  # at least so long, and at most, between two looks
_SWITCH_S = 2e-4
_MOST_PORTS = 2
_STDIN = 0


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "board",
        help="serve virtual boards that behave like the real ones, with the robot's model "
        "behind them",
        description="Serve the boards of a robot, with its model and effects behind them, on "
        "pseudo-terminals or on sockets of this machine, byte by byte as fast as a "
        "real line. Two ports are a line for each board; one port for more than three"
        " axes is a bus that both share. Lines on standard input inject faults: drop "
        "N, double N, corrupt N, garbage N, delay T ms (each towards 'board' or "
        "'host'), silence T s, space T s, reset BOARD, brown-out BOARD, freeze AXIS, "
        "thaw AXIS, lose AXIS N, joystick X Y Z BUTTONS.",
    )
    add_robot(parser)
    parser.add_argument(
        "--port", type=Path, action="append", default=[], metavar="PATH",
        help="name of the pseudo-terminal",
    )  # fmt: skip
    parser.add_argument(
        "--tcp", action="append", default=[], metavar="HOST:PORT",
        help="listen at this address instead; only 127.0.0.1 or ::1, port 0 for any free "
        "port",
    )  # fmt: skip
    parser.add_argument("--bus", action="store_true", help="serve both boards on one line")
    parser.add_argument(
        "--baud", type=int, default=BAUDS[0], metavar="N",
        help="bit rate of the lines, 125000 or 9600 (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--clock", type=int, choices=(2, 4), default=4,
        help="clock E of the boards' chips in MHz; half the clock halves the rates "
        "(default: 4)",
    )  # fmt: skip
    parser.add_argument("--unpaced", action="store_true", help="transmit bytes without delay")
    parser.add_argument(
        "--seed", type=int, default=0, metavar="N", help="seed of noise and faults (default: 0)"
    )
    parser.add_argument(
        "--position-known", action="store_true", help="start homed and without a fault"
    )
    parser.add_argument(
        "--mishaps", type=float, default=0.0, metavar="RATE",
        help="random disturbances of the lines per second (default: 0)",
    )  # fmt: skip
    parser.add_argument(
        "--until-stdin-closes", action="store_true", help="end when standard input closes"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Serve until termination is requested."""
    if options.seed < 0:
        raise InputError(message("cli", "--seed {seed}: must be 0 or more").fill(seed=options.seed))
    if not 0.0 <= options.mishaps <= 1000.0:
        raise InputError(
            message("cli", "--mishaps {mishaps}: must be from 0 to 1000 a second").fill(
                mishaps=options.mishaps
            )
        )
    robot = robot_of(options)
    count = _count_of_ports(options, len(board_axes(robot)))
    boards = _boards(options, robot, count)
    with ExitStack() as stack:
        ports: list[HostPort] = []
        for make in _makers(options, count):
            ports.append(make())
            stack.callback(ports[-1].close)
        ended = stack.enter_context(termination_requested())
        _boards(options, robot, count).rehearse()
        tell_model(options, robot.name)
        for port, line in zip(ports, boards.lines, strict=True):
            who = " and ".join(f"board {number}" for number in line.numbers)
            _tell(f"listening on {port.name}: {who}")
        gc.collect()
        gc.freeze()  # what lives as long as the process need not be looked through while hosts wait
        _Server(boards, ports, options).serve(ended)
    return 0


def _boards(options: argparse.Namespace, robot: Robot, count: Literal[1, 2]) -> VirtualBoards:
    return VirtualBoards(
        robot,
        ports=count,
        baud=options.baud,
        paced=not options.unpaced,
        seed=options.seed,
        position_known=options.position_known,
        tick_s=2e-3 / options.clock,
    )


def _count_of_ports(options: argparse.Namespace, boards: int) -> Literal[1, 2]:
    asked = len(options.port) + len(options.tcp)
    if asked > _MOST_PORTS:
        raise InputError(
            message("cli", "{asked} ports: two boards have at most {most_ports}").fill(
                asked=asked, most_ports=_MOST_PORTS
            )
        )
    if options.bus and asked == _MOST_PORTS:
        raise InputError(message("cli", "--bus is one line; name only one port"))
    if options.bus and boards == 1:
        raise InputError(
            message("cli", "--bus: the robot's axes need only one board, which shares no line")
        )
    one = options.bus or asked == 1 or (not asked and boards == 1)
    return 1 if one else 2


def _makers(options: argparse.Namespace, count: int) -> Iterator[Callable[[], HostPort]]:
    if not options.port and not options.tcp:
        for _ in range(count):
            yield PseudoTerminal
    for path in options.port:
        yield partial(PseudoTerminal, path)
    for address in options.tcp:
        yield partial(Socket, address, _tell)


class _Ears(threading.Thread):
    """Hears what hosts and standard input say, at the moment they do, whatever is simulated."""

    def __init__(self, ports: Sequence[HostPort]) -> None:
        super().__init__(name="board ears", daemon=True)
        self.rung = threading.Event()
        self.heard: deque[tuple[int, bytes, float]] = deque()  # which port, what, host time s
        self.commands: deque[bytes] = deque()
        # Elsewhere nothing but sockets can be waited for.
        self.listens = os.name == "posix" and sys.stdin is not None
        self._ports = tuple(ports)
        self._ended = threading.Event()

    def run(self) -> None:
        """Listen until `end`."""
        while not self._ended.is_set():
            # Few handles, which change, and files among them: a selector made anew takes them all.
            with selectors.SelectSelector() as selector:
                for port in self._ports:
                    for handle in port.handles():
                        selector.register(handle, selectors.EVENT_READ)
                if self.listens:
                    selector.register(_STDIN, selectors.EVENT_READ)
                ready = {key.fd for key, _ in selector.select(_SLEEP_S)}
            if _STDIN in ready:
                self._hear_commands()
            for number, port in enumerate(self._ports):
                if not ready.isdisjoint(port.handles()) and (data := port.receive()):
                    self.heard.append((number, data, time.monotonic()))
            if ready:
                self.rung.set()

    def end(self) -> None:
        """End, and wait for it."""
        self._ended.set()
        self.join()

    def _hear_commands(self) -> None:
        data = os.read(_STDIN, 4096)
        self.listens = bool(data)
        self.commands.append(data)


class _Server:
    """Lets the boards live in real time, and carries bytes and commands to and fro."""

    def __init__(
        self, boards: VirtualBoards, ports: list[HostPort], options: argparse.Namespace
    ) -> None:
        self._boards = boards
        self._ends = list(zip(ports, boards.lines, strict=True))
        self._mishaps = RandomFaults(boards, options.mishaps, options.seed)
        self._until_stdin = options.until_stdin_closes
        self._ears = _Ears(ports)
        self._met: set[str] = set()
        self._line = b""

    def serve(self, ended: Callable[[], bool]) -> None:
        """Continue until ``ended``."""
        sys.setswitchinterval(_SWITCH_S)  # the ears must not wait for what is simulated
        began_s = time.monotonic()
        _tell(f"0.0000 s is {began_s:.6f} s of this machine's monotonic clock")
        self._ears.start()
        now_s = 0.0
        try:
            while not ended() and (self._ears.listens or not self._until_stdin):
                self._ears.rung.wait(min(max(self._boards.wake_s - now_s, _WAKE_S), _SLEEP_S))
                self._ears.rung.clear()
                self._hear(began_s)
                now_s = time.monotonic() - began_s
                self._mishaps.live(now_s)
                for port, line in self._ends:
                    port.send(line.advance(now_s))
                for event in self._boards.notes.taken():
                    _tell(f"{event.at_s:.4f} s: {event.text}")
        finally:
            self._ears.end()

    def _hear(self, began_s: float) -> None:
        while self._ears.heard:
            number, data, host_time_s = self._ears.heard.popleft()
            port, line = self._ends[number]
            if port.name not in self._met:
                self._met.add(port.name)
                _tell(f"{port.name}: a host speaks")
            # What came while the boards were further already comes now.
            line.receive(data, max(host_time_s - began_s, self._boards.now_s))
        while self._ears.commands:
            self._command(self._ears.commands.popleft())

    def _command(self, data: bytes) -> None:
        *lines, self._line = (self._line + data).split(b"\n")
        for line in lines:
            command = line.decode("utf-8", "replace").strip()
            try:
                if command:
                    inject(self._boards, command)
            except FaultCommandError as error:
                print(f"rotemina: {error}", file=sys.stderr, flush=True)


def _tell(text: str) -> None:
    print(text, flush=True)
