"""``rotemina board``: virtual boards with a simulated machine, to which a host can connect."""

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

from rotemina.app.cli.machine.board_ports import HostPort, LoopbackSocket, PseudoTerminal
from rotemina.app.cli.terminal import add_robot, load_selected_robot, print_model, watch_termination
from rotemina.app.errors import CommandError
from rotemina.drivers.contract import FaultCommandError
from rotemina.drivers.mc68hc11 import BAUD_RATES
from rotemina.drivers.mc68hc11.protocol import make_board_axes
from rotemina.drivers.virtual_board import RandomFaults, VirtualBoards, inject_fault
from rotemina.sim.robot import Robot

# Shortest and longest wait between two steps of the server.
_MIN_WAIT_S, _MAX_WAIT_S = 1e-3, 20e-3
# Python's default switch interval of 5 ms would delay the listener thread.
_THREAD_SWITCH_INTERVAL_S = 2e-4
_MAX_PORTS = 2
_STDIN_HANDLE = 0


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "board",
        help="serve virtual boards that behave like the real ones, with the robot's model "
        "behind them",
        description="Serve the boards of a robot, with its model and effects behind them, on "
        "pseudo-terminals or on sockets of this computer, at the byte rate of a real "
        "serial line. With two ports, each board has its own line. With one port and more "
        "than three axes, both boards share the line as a bus. Commands on standard input, "
        "one per line, inject faults: drop "
        "N, double N, corrupt N, garbage N, delay T ms (each towards 'board' or "
        "'host'), silence T s, space T s, reset BOARD, brown-out BOARD, freeze AXIS, "
        "thaw AXIS, lose AXIS N, joystick X Y Z BUTTONS.",
    )
    add_robot(parser)
    parser.add_argument(
        "--port", type=Path, action="append", default=[], metavar="PATH",
        help="path of a symbolic link to the pseudo-terminal",
    )  # fmt: skip
    parser.add_argument(
        "--tcp", action="append", default=[], metavar="HOST:PORT",
        help="listen on this address instead; only 127.0.0.1 or ::1, port 0 for any free "
        "port",
    )  # fmt: skip
    parser.add_argument("--bus", action="store_true", help="serve both boards on one line")
    parser.add_argument(
        "--baud", type=int, default=BAUD_RATES[0], metavar="N",
        help="bit rate of the lines, 125000 or 9600 (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--clock", type=int, choices=(2, 4), default=4,
        help="E clock of the boards' microcontrollers, MHz; 2 halves their tick rate "
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
        help="average number of random line faults per second (default: 0)",
    )  # fmt: skip
    parser.add_argument(
        "--until-stdin-closes", action="store_true", help="end when standard input closes"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Serve until termination is requested."""
    if options.seed < 0:
        raise CommandError("--seed {seed}: must be 0 or more", seed=options.seed)
    if not 0.0 <= options.mishaps <= 1000.0:
        raise CommandError(
            "--mishaps {mishaps}: must be from 0 to 1000 a second", mishaps=options.mishaps
        )
    robot = load_selected_robot(options)
    port_count = _count_ports(options, len(make_board_axes(robot)))
    boards = _make_boards(options, robot, port_count)
    with ExitStack() as stack:
        ports: list[HostPort] = []
        for make_port in _list_port_factories(options, port_count):
            ports.append(make_port())
            stack.callback(ports[-1].close)
        is_termination_requested = stack.enter_context(watch_termination())
        # A run with other boards compiles the numba code now, so that the first host does not wait.
        _make_boards(options, robot, port_count).warm_up()
        print_model(options, robot.name)
        for port, board_line in zip(ports, boards.host_ports, strict=True):
            names = " and ".join(f"board {number}" for number in board_line.board_numbers)
            _print_line(f"listening on {port.name}: {names}")
        gc.collect()
        # Later garbage collections skip all existing objects, so they delay hosts less.
        gc.freeze()
        _BoardServer(boards, ports, options).serve(is_termination_requested)
    return 0


def _make_boards(
    options: argparse.Namespace, robot: Robot, port_count: Literal[1, 2]
) -> VirtualBoards:
    return VirtualBoards(
        robot,
        ports=port_count,
        baud=options.baud,
        paced=not options.unpaced,
        seed=options.seed,
        position_known=options.position_known,
        # A tick takes 2000 cycles of the E clock.
        tick_s=2e-3 / options.clock,
    )


def _count_ports(options: argparse.Namespace, board_count: int) -> Literal[1, 2]:
    requested = len(options.port) + len(options.tcp)
    if requested > _MAX_PORTS:
        raise CommandError(
            "{asked} ports: two boards have at most {most_ports}",
            asked=requested,
            most_ports=_MAX_PORTS,
        )
    if options.bus and requested == _MAX_PORTS:
        raise CommandError("--bus uses one line; name only one port")
    if options.bus and board_count == 1:
        raise CommandError("--bus: the robot's axes need only one board, so no line is shared")
    is_one_port = options.bus or requested == 1 or (not requested and board_count == 1)
    return 1 if is_one_port else 2


def _list_port_factories(
    options: argparse.Namespace, port_count: int
) -> Iterator[Callable[[], HostPort]]:
    if not options.port and not options.tcp:
        for _ in range(port_count):
            yield PseudoTerminal
    for path in options.port:
        yield partial(PseudoTerminal, path)
    for address in options.tcp:
        yield partial(LoopbackSocket, address, _print_line)


class _ListenerThread(threading.Thread):
    def __init__(self, ports: Sequence[HostPort]) -> None:
        super().__init__(name="board listener", daemon=True)
        self.wake_event = threading.Event()
        # For each piece of data: number of the port, data, and host time of arrival, s.
        self.received: deque[tuple[int, bytes, float]] = deque()
        self.commands: deque[bytes] = deque()
        self.is_stdin_open = sys.stdin is not None
        # On Windows, select() accepts only sockets, so another thread reads standard input there.
        self._selects_stdin = os.name == "posix"
        self._ports = tuple(ports)
        self._end_event = threading.Event()

    def run(self) -> None:
        """Listen until :meth:`end` is called."""
        if not self._selects_stdin:
            # Nothing can interrupt its read, so the end of the program must not wait for it.
            threading.Thread(
                target=self._read_all_commands, name="board commands", daemon=True
            ).start()
        while not self._end_event.is_set():
            # There are only a few handles and they change, so a new selector in each turn is
            # simplest. Unlike epoll, select() accepts files.
            with selectors.SelectSelector() as selector:
                for port in self._ports:
                    for handle in port.get_handles():
                        selector.register(handle, selectors.EVENT_READ)
                if self._selects_stdin and self.is_stdin_open:
                    selector.register(_STDIN_HANDLE, selectors.EVENT_READ)
                ready = {key.fd for key, _ in selector.select(_MAX_WAIT_S)}
            if _STDIN_HANDLE in ready:
                self._read_commands()
            for number, port in enumerate(self._ports):
                if not ready.isdisjoint(port.get_handles()) and (data := port.receive()):
                    self.received.append((number, data, time.monotonic()))
            if ready:
                self.wake_event.set()

    def end(self) -> None:
        """End the thread, and wait until it has ended."""
        self._end_event.set()
        self.join()

    def _read_all_commands(self) -> None:
        while self.is_stdin_open:
            self._read_commands()
            self.wake_event.set()

    def _read_commands(self) -> None:
        try:
            data = os.read(_STDIN_HANDLE, 4096)
        except OSError:
            # The terminal is gone. This thread must continue to serve the ports.
            data = b""
        self.is_stdin_open = bool(data)
        self.commands.append(data)


class _BoardServer:
    def __init__(
        self, boards: VirtualBoards, ports: list[HostPort], options: argparse.Namespace
    ) -> None:
        self._boards = boards
        self._connections = list(zip(ports, boards.host_ports, strict=True))
        self._random_faults = RandomFaults(boards, options.mishaps, options.seed)
        self._ends_with_stdin = options.until_stdin_closes
        self._listener = _ListenerThread(ports)
        self._ports_with_host: set[str] = set()
        self._incomplete_line = b""

    def serve(self, is_termination_requested: Callable[[], bool]) -> None:
        """Serve until ``is_termination_requested`` returns true."""
        sys.setswitchinterval(_THREAD_SWITCH_INTERVAL_S)
        start_s = time.monotonic()
        _print_line(f"0.0000 s is {start_s:.6f} s of this machine's monotonic clock")
        self._listener.start()
        now_s = 0.0
        try:
            while not is_termination_requested() and (
                self._listener.is_stdin_open or not self._ends_with_stdin
            ):
                self._listener.wake_event.wait(
                    min(max(self._boards.next_event_s - now_s, _MIN_WAIT_S), _MAX_WAIT_S)
                )
                self._listener.wake_event.clear()
                self._process_input(start_s)
                now_s = time.monotonic() - start_s
                self._random_faults.advance(now_s)
                for port, board_line in self._connections:
                    port.send(board_line.advance(now_s))
                for event in self._boards.notes.take_events():
                    _print_line(f"{event.at_s:.4f} s: {event.text}")
        finally:
            self._listener.end()

    def _process_input(self, start_s: float) -> None:
        while self._listener.received:
            number, data, host_time_s = self._listener.received.popleft()
            port, board_line = self._connections[number]
            if port.name not in self._ports_with_host:
                self._ports_with_host.add(port.name)
                _print_line(f"{port.name}: receiving data from a host")
            # Simulated time cannot go back, so data may arrive at the boards a little late.
            board_line.receive(data, max(host_time_s - start_s, self._boards.now_s))
        while self._listener.commands:
            self._run_commands(self._listener.commands.popleft())

    def _run_commands(self, data: bytes) -> None:
        *lines, self._incomplete_line = (self._incomplete_line + data).split(b"\n")
        for line in lines:
            command = line.decode("utf-8", "replace").strip()
            try:
                if command:
                    inject_fault(self._boards, command)
            except FaultCommandError as error:
                print(f"rotemina: {error}", file=sys.stderr, flush=True)


def _print_line(text: str) -> None:
    print(text, flush=True)
