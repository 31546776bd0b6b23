"""``rotemina compare``: how far the nominal model is from a record of the real machine."""

import argparse
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from rotemina.app.cli.options import (
    add_columns,
    add_robot,
    records_of_model,
    robot_of,
    tell_model,
)
from rotemina.app.files import json_text
from rotemina.sim.comparison.comparison import Comparison, compare
from rotemina.sim.comparison.comparison_picture import draw_figure, format_of
from rotemina.sim.comparison.run_comparison import compare_runs
from rotemina.sim.comparison.table import runs_table, table
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.whole_files import replaced


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "compare",
        help="compare the model with a record of the real machine",
        description="Simulate the nominal model with the commands of a record, and print how far "
        "the real machine is from it in each measured signal (u, ref, meas). With "
        "--with, print how far two runs of the machine are apart.",
    )
    parser.add_argument("record", type=Path, metavar="RECORD", help="a record file (.csv, .gz)")
    parser.add_argument(
        "--with",
        type=Path,
        dest="other",
        metavar="RECORD",
        help="compare with this run of the machine instead of the model",
    )
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--fit",
        type=lambda text: tuple(name.strip() for name in text.split(",") if name.strip()),
        default=(),
        metavar="NAMES",
        help="fit these by least squares first: gain, offset",
    )
    parser.add_argument("--json", metavar="OUT", help="write the figures as JSON ('-' prints them)")
    parser.add_argument("--plot", type=Path, metavar="OUT", help="draw a picture (.svg .png .pdf)")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Compare, print a table, and write the requested files."""
    robot = robot_of(options)
    record = _record(options, robot)
    comparison, found, text = _compared(options, robot, record)
    # Both files appear together or neither: a failure at one leaves the other's place alone.
    with ExitStack() as files:
        if options.plot is not None:
            picture_format = format_of(options.plot)
            draw_figure(comparison, files.enter_context(replaced(options.plot)), picture_format)
        if options.json not in (None, "-"):
            files.enter_context(replaced(options.json)).write(json_text(found).encode("utf-8"))
    if options.other is None:
        tell_model(options, robot.name)
    print(json_text(found) if options.json == "-" else text)
    return 0


def _record(options: argparse.Namespace, robot: Robot) -> Record:
    """Read the record; one that is compared with another run may leave the model's range."""
    if options.other is None:
        (record,) = records_of_model(options, robot, [options.record])
        return record
    return read_record(options.record, columns=options.columns, robot=robot)


def _compared(
    options: argparse.Namespace, robot: Robot, record: Record
) -> tuple[Comparison, dict[str, Any], str]:
    """Return the comparison, with the model or another run, as JSON and as text too."""
    if options.other is None:
        comparison = compare(robot, record, fit=options.fit)
        return comparison, comparison.as_json(), table(comparison, options.wording)
    if options.fit:
        raise InputError(
            message(
                "cli", "--fit re-fits the model, which --with does not use; use only one of them"
            )
        )
    other = read_record(options.other, columns=options.columns, robot=robot)
    runs = compare_runs(robot, record, other)
    return runs.comparison, runs.as_json(), runs_table(runs, options.wording)
