"""``rotemina compare``: compare the nominal model with a record of the real machine."""

import argparse
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from rotemina.app.cli.terminal import (
    add_columns,
    add_robot,
    check_output_files,
    find_json_file,
    find_robot_file,
    load_selected_robot,
    print_model,
    read_records_of_model,
)
from rotemina.app.errors import CommandError
from rotemina.app.settings import format_json
from rotemina.sim import comparison as model_comparison
from rotemina.sim.comparison import (
    ModelComparison,
    compare,
    compare_runs,
    format_runs_table,
    format_table,
)
from rotemina.sim.files import replace_file
from rotemina.sim.records import Record, read_record
from rotemina.sim.robot import Robot


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "compare",
        help="compare the model with a record of the real machine",
        description="Simulate the nominal model with the commands of a record, and print how far "
        "the real machine deviates from it in each measured signal (u, ref, meas). With "
        "--with, print how far two runs of the machine differ.",
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
        help="fit these parameters by least squares first: gain, offset",
    )
    parser.add_argument("--json", metavar="OUT", help="write the figures as JSON ('-' prints them)")
    parser.add_argument("--plot", type=Path, metavar="OUT", help="draw a picture (.svg .png .pdf)")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Compare, print a table, and write the requested files."""
    check_output_files(
        [options.plot, find_json_file(options.json)],
        [options.record, options.other, find_robot_file(options.robot)],
    )
    robot = load_selected_robot(options)
    record = _read_compared_record(options, robot)
    comparison, document, text = _compare(options, robot, record)
    # Both files are replaced together or not at all, even if writing one of them fails.
    with ExitStack() as files:
        if options.plot is not None:
            picture_format = model_comparison.find_picture_format(options.plot)
            model_comparison.draw_figure(
                comparison, files.enter_context(replace_file(options.plot)), picture_format
            )
        if options.json not in (None, "-"):
            files.enter_context(replace_file(options.json)).write(
                format_json(document).encode("utf-8")
            )
    if options.other is None:
        print_model(options, robot.name)
    print(format_json(document) if options.json == "-" else text)
    return 0


def _read_compared_record(options: argparse.Namespace, robot: Robot) -> Record:
    """Read the record. If it is compared with the model, its commands must fit the model."""
    if options.other is None:
        (record,) = read_records_of_model(options, robot, [options.record])
        return record
    return read_record(options.record, columns=options.columns, robot=robot)


def _compare(
    options: argparse.Namespace, robot: Robot, record: Record
) -> tuple[ModelComparison, dict[str, Any], str]:
    if options.other is None:
        comparison = compare(robot, record, fit=options.fit)
        return comparison, comparison.as_json(), format_table(comparison, options.wording)
    if options.fit:
        raise CommandError(
            "--fit re-fits the model, which --with does not use; use only one of them"
        )
    other = read_record(options.other, columns=options.columns, robot=robot)
    runs = compare_runs(robot, record, other)
    return runs.comparison, runs.as_json(), format_runs_table(runs, options.wording)
