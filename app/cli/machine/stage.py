"""``rotemina stage``: an emulated G-code stage on a serial port that any program can open."""

import argparse
import os
import select
import sys
import time
from collections.abc import Callable
from pathlib import Path

from rotemina.app.cli.machine.board_ports import PseudoTerminal
from rotemina.app.cli.terminal import (
    add_robot,
    load_selected_robot,
    print_model,
    watch_termination,
)
from rotemina.drivers.gcode import EmulatedStage

_STDIN_HANDLE = 0
# Longest wait for requests, which is also the longest delay of unsolicited reports.
_MAX_WAIT_S = 0.005


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "stage",
        help="serve an emulated G-code stage, to try out the driver gcode",
        description="Emulate a GRBL controller that drives the axes of a robot, on a "
        "pseudo-terminal. The robot file defines its settings, and must contain only stepper "
        "axes. Commands on standard input, one per line: limit (a limit switch closes), power "
        "(the supply fails and returns), door (the safety door opens), closed (the door "
        "closes).",
    )
    add_robot(parser)
    parser.add_argument(
        "--port", type=Path, metavar="PATH", help="path of a symbolic link to the pseudo-terminal"
    )
    parser.add_argument(
        "--all-at-once", action="store_true", help="home all axes together, as plain GRBL does"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Serve until termination is requested."""
    robot = load_selected_robot(options)
    stage = EmulatedStage(robot, single_homing=not options.all_at_once)
    port = PseudoTerminal(options.port)
    print_model(options, robot.name)
    try:
        with watch_termination() as is_termination_requested:
            print(f"listening on {port.name}", flush=True)
            _serve_stage(stage, port, is_termination_requested)
    finally:
        port.close()
    return 0


def _serve_stage(
    stage: EmulatedStage, port: PseudoTerminal, is_termination_requested: Callable[[], bool]
) -> None:
    start_s, incomplete_line = time.monotonic(), b""
    handles = [*port.get_handles(), *([_STDIN_HANDLE] if sys.stdin is not None else [])]
    while not is_termination_requested():
        ready = select.select(handles, [], [], _MAX_WAIT_S)[0]
        if _STDIN_HANDLE in ready:
            data = os.read(_STDIN_HANDLE, 4096)
            if not data:
                handles.remove(_STDIN_HANDLE)
            *lines, incomplete_line = (incomplete_line + data).split(b"\n")
            for line in lines:
                _run_command(stage, line.decode("utf-8", "replace").strip())
        now_s = time.monotonic() - start_s
        if ready:
            stage.receive(port.receive(), now_s)
        port.send(stage.advance(now_s))
        while stage.events:
            print(f"{now_s:.3f} s: {stage.events.pop(0)}", flush=True)


def _run_command(stage: EmulatedStage, command: str) -> None:
    commands = {
        "limit": stage.hit_limit,
        "power": stage.cut_power,
        "door": stage.open_door,
        "closed": stage.close_door,
    }
    if command in commands:
        commands[command]()
    elif command:
        print(
            f"rotemina: {command!r}: must be one of {', '.join(commands)}",
            file=sys.stderr,
            flush=True,
        )
