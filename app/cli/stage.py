"""``rotemina stage``: an emulated G-code stage on a serial port that any program can open."""

import argparse
import os
import select
import sys
import time
from collections.abc import Callable
from pathlib import Path

from rotemina.app.cli.board_ports import PseudoTerminal
from rotemina.app.cli.options import add_robot, robot_of, tell_model
from rotemina.app.cli.termination import termination_requested
from rotemina.drivers.gcode.emulator import EmulatedStage

_STDIN = 0
_WAIT_S = 0.005  # so late it may tell what nobody asked for; questions wake it


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "stage",
        help="serve an emulated G-code stage, to try the driver gcode",
        description="Serve a GRBL controller with the axes of a robot behind it, byte by byte, on"
        " a pseudo-terminal. The robot file gives its settings, and may have stepper "
        "axes only. Lines on standard input: limit (a limit switch closes), power "
        "(its supply fails and returns), door and closed (its safety door opens and closes).",
    )
    add_robot(parser)
    parser.add_argument("--port", type=Path, metavar="PATH", help="name of the pseudo-terminal")
    parser.add_argument(
        "--all-at-once", action="store_true", help="home all axes together, as plain GRBL does"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Serve until termination is requested."""
    robot = robot_of(options)
    stage = EmulatedStage(robot, single_homing=not options.all_at_once)
    port = PseudoTerminal(options.port)
    tell_model(options, robot.name)
    try:
        with termination_requested() as ended:
            print(f"listening on {port.name}", flush=True)
            _serve(stage, port, ended)
    finally:
        port.close()
    return 0


def _serve(stage: EmulatedStage, port: PseudoTerminal, ended: Callable[[], bool]) -> None:
    began_s, heard = time.monotonic(), b""
    handles = [*port.handles(), *([_STDIN] if sys.stdin is not None else [])]
    while not ended():
        ready = select.select(handles, [], [], _WAIT_S)[0]
        if _STDIN in ready:
            data = os.read(_STDIN, 4096)
            if not data:
                handles.remove(_STDIN)
            *lines, heard = (heard + data).split(b"\n")
            for line in lines:
                _inject(stage, line.decode("utf-8", "replace").strip())
        now_s = time.monotonic() - began_s
        if ready:
            stage.receive(port.receive(), now_s)
        port.send(stage.advance(now_s))
        while stage.events:
            print(f"{now_s:.3f} s: {stage.events.pop(0)}", flush=True)


def _inject(stage: EmulatedStage, command: str) -> None:
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
