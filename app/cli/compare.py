"""``rotemina compare``: how far the nominal model is from a record of the real machine."""

import argparse
from pathlib import Path

from rotemina.app.cli.options import add_columns, add_robot, robot_of
from rotemina.app.files import write_json
from rotemina.sim.comparison.comparison import FITTABLE, compare
from rotemina.sim.comparison.figure import save_figure
from rotemina.sim.comparison.table import table
from rotemina.sim.records.reading import read_record


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
    if options.plot is not None:
        save_figure(comparison, options.plot)
    if options.json is not None:
        write_json(comparison.as_json(), options.json)
    if options.json != "-":
        print(table(comparison))
    return 0
