"""``rotemina doctor``: check whether this computer can run the program, and suggest remedies."""

import argparse
import json
import os
from dataclasses import asdict
from itertools import chain

from rotemina.sim.messages import marked

_BROKEN = 1
_STATES = {
    "ok": marked("cli", "ok"),
    "limited": marked("cli", "limited"),
    "broken": marked("cli", "broken"),
}
_NAMES = (
    marked("cli", "dependencies"),
    marked("cli", "Qt libraries"),
    marked("cli", "Qt platform"),
    marked("cli", "rendering"),
    marked("cli", "serial ports"),
    marked("cli", "line rate"),
    marked("cli", "joysticks"),
    marked("cli", "folders"),
    marked("cli", "disk"),
    marked("cli", "clock"),
)


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "doctor",
        help="check this machine, and advise what to do",
        description="Check Python, packages, Qt, permissions of serial ports and joysticks, "
        "folders, disk and clock. No board is opened except by --port. Exit status: 0"
        " the program runs (limits are reported), 1 something is broken.",
    )
    parser.add_argument("--json", action="store_true", help="print the findings as JSON")
    parser.add_argument(
        "--port", action="append", default=[], metavar="DEVICE",
        help="test whether this serial port reaches the bit rate of the boards, 125000 "
"baud; this may reset the connected device",
    )  # fmt: skip
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print a line for each finding, advice below it; status 1 if anything is broken."""
    from rotemina.app.line_rate import line_rate  # both take their time to import
    from rotemina.app.machine_check import State, examine

    findings = []
    for found in chain(examine(os.environ), map(line_rate, options.port)):
        findings.append(found)
        if not options.json:
            say = options.wording
            name = say.text("cli", found.name) if found.name in _NAMES else found.name
            state = say.text("cli", _STATES[found.state])
            print(f"{state:16}{name:22}{say.shown(found.seen)}", flush=True)
            if found.advice:
                print(f"{'':38}→ {say.shown(found.advice)}", flush=True)
    if options.json:
        print(json.dumps([asdict(found) for found in findings], indent=1, ensure_ascii=False))
    return _BROKEN if any(found.state is State.BROKEN for found in findings) else 0
