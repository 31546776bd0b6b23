"""``rotemina doctor``: check whether this computer can run the program, and give advice."""

import argparse
import json
import os
from dataclasses import asdict
from itertools import chain

from rotemina.sim.messages import marked

_EXIT_BROKEN = 1
_STATE_TEXTS = {
    "ok": marked("cli", "ok"),
    "limited": marked("cli", "limited"),
    "broken": marked("cli", "broken"),
}
_TRANSLATED_NAMES = (
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
        help="check this computer, and advise what to do",
        description="Check Python, packages, Qt, permissions of serial ports and joysticks, "
        "folders, disk and clock. No board is opened except by --port. Exit status: 0"
        " the program runs (limits are reported), 1 something is broken.",
    )
    parser.add_argument("--json", action="store_true", help="print the findings as JSON")
    parser.add_argument(
        "--port",
        action="append",
        default=[],
        metavar="DEVICE",
        help="test whether this serial port reaches the bit rate of the boards, 125000 baud; this "
        "may reset the connected device",
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print a line for each finding, with advice below; return 1 if anything is broken."""
    # Both imports are slow, and other subcommands do not need them.
    from rotemina.app.system import FindingState, check_line_rate, run_checks

    findings = []
    for finding in chain(run_checks(os.environ), map(check_line_rate, options.port)):
        findings.append(finding)
        if not options.json:
            wording = options.wording
            name = (
                wording.localize_text("cli", finding.name)
                if finding.name in _TRANSLATED_NAMES
                else finding.name
            )
            state = wording.localize_text("cli", _STATE_TEXTS[finding.state])
            print(f"{state:16}{name:22}{wording.format_field(finding.seen)}", flush=True)
            if finding.advice:
                print(f"{'':38}→ {wording.format_field(finding.advice)}", flush=True)
    if options.json:
        print(json.dumps([asdict(finding) for finding in findings], indent=1, ensure_ascii=False))
    return _EXIT_BROKEN if any(finding.state is FindingState.BROKEN for finding in findings) else 0
