"""``rotemina compare``: how far the nominal model is from a record of the real machine."""

import argparse
from contextlib import ExitStack
from pathlib import Path

from rotemina.app.cli.options import add_columns, add_robot, robot_of
from rotemina.app.files import json_text
from rotemina.sim.comparison.comparison import FITTABLE, compare
from rotemina.sim.comparison.figure import draw_figure, format_of
from rotemina.sim.comparison.table import table
from rotemina.sim.records.reading import read_record
from rotemina.sim.whole_files import replaced


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "compare",
        help="compare the model with a record of the real machine",
        description="Simulate the nominal model over a record's commands and say, for every "
        "measured tap (u, ref, meas), how far the real machine is from it.",
    )
    parser.add_argument("record", type=Path, metavar="RECORD", help="a record file (.csv, .gz)")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--fit",
        type=lambda text: tuple(name.strip() for name in text.split(",") if name.strip()),
        default=(),
        metavar="NAMES",
        help=f"re-fit these by least squares first: {','.join(FITTABLE)}",
    )
    parser.add_argument("--json", metavar="OUT", help="write the figures as JSON ('-' prints them)")
    parser.add_argument("--plot", type=Path, metavar="OUT", help="draw a picture (.svg .png .pdf)")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Compare, print a table, and write what was asked for."""
    robot = robot_of(options)
    record = read_record(options.record, columns=options.columns, robot=robot)
    comparison = compare(robot, record, fit=options.fit)
    # Both files appear together or neither: a failure at one leaves the other's place alone.
    with ExitStack() as files:
        if options.plot is not None:
            picture_format = format_of(options.plot)
            draw_figure(comparison, files.enter_context(replaced(options.plot)), picture_format)
        if options.json not in (None, "-"):
            text = json_text(comparison.as_json())
            files.enter_context(replaced(options.json)).write(text.encode("utf-8"))
    print(json_text(comparison.as_json()) if options.json == "-" else table(comparison))
    return 0
