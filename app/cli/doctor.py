"""``rotemina doctor``: whether this machine can run the program, and what to do where not."""

import argparse
import json
import os
from dataclasses import asdict
from itertools import chain

_BROKEN = 1


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
            print(f"{found.state:9}{found.name:14}{found.seen}", flush=True)
            if found.advice:
                print(f"{'':23}→ {found.advice}", flush=True)
    if options.json:
        print(json.dumps([asdict(found) for found in findings], indent=1, ensure_ascii=False))
    return _BROKEN if any(found.state is State.BROKEN for found in findings) else 0
