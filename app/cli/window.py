"""``rotemina`` without a subcommand: open the window, or run without a display."""

import argparse
from pathlib import Path

from rotemina.app.cli.terminal import DECIMAL_SIGNS, ENGLISH, add_robot


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the window to the top level."""
    add_robot(parser, default="rotemina")
    parser.add_argument(
        "--driver",
        default="simulator",
        metavar="NAME",
        help="driver of the machine (default: simulator)",
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        dest="assignments",
        metavar="NAME=VALUE",
        help="a setting of the driver, such as port=/dev/ttyUSB0 (may be repeated; "
        "default: last used in the window)",
    )
    parser.add_argument(
        "--offscreen",
        action="store_true",
        help="run without a display: play the example trajectory on the simulator, compare"
        " model and machine, and write picture and report into a folder",
    )
    parser.add_argument(
        "--output",
        type=Path,
        default=Path("rotemina-run"),
        metavar="DIR",
        help="folder for the picture and the report of a run without a display (default: "
        "rotemina-run)",
    )
    parser.add_argument(
        "--language",
        choices=(ENGLISH, *DECIMAL_SIGNS),
        help="language of window, help and messages (default: last used in the window, "
        "else the system's)",
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Open the window, or run offscreen if requested."""
    # Qt is imported only for the window, so that the subcommands work without its libraries.
    from rotemina.app.shell.startup import start

    return start(
        options.robot,
        driver=options.driver,
        assignments=options.assignments,
        offscreen=options.offscreen,
        output=options.output,
        ui_language=options.language,
    )
