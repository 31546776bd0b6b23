"""``rotemina compensate check``: check inverses on records that were not used for training."""

import argparse
import sys
from pathlib import Path

from rotemina.app.cli.control.compensate_table import format_table, make_document
from rotemina.app.cli.terminal import (
    TerminalProgressLine,
    add_columns,
    add_robot,
    check_output_files,
    find_json_file,
    find_robot_file,
    load_selected_robot,
    print_message,
    print_model,
    read_records_of_model,
)
from rotemina.app.errors import CommandError
from rotemina.app.settings import format_json, write_text
from rotemina.sim.gap.result import Progress
from rotemina.sim.messages import message


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = verbs.add_parser(
        "check",
        help="compare the commands of inverses for measured positions with the recorded ones",
        description="Feed the positions of records to each inverse of a file, and print the "
        "difference between its command and the recorded one. If the history "
        "is unknown, rows count only after the first sweep over the whole range.",
    )
    parser.add_argument(
        "inverse", type=Path, metavar="INVERSE", help="file written by 'rotemina compensate train'"
    )
    parser.add_argument("records", type=Path, nargs="+", metavar="RECORD")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument("--json", metavar="OUT", help="write the figures as JSON ('-' prints them)")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Check the inverses, and print the errors of each kind."""
    # These imports are slow, and other subcommands do not need them.
    from rotemina.sim.compensate import compute_residual, read_samples, read_trained

    check_output_files(
        [find_json_file(options.json)],
        [options.inverse, *options.records, find_robot_file(options.robot)],
    )
    robot = load_selected_robot(options)
    training_result, provenance = read_trained(options.inverse)
    if provenance.robot != robot.name:
        raise CommandError(
            "{inverse} was trained for robot {robot}, not for {name}; select that robot with "
            "--robot",
            inverse=options.inverse,
            robot=repr(provenance.robot),
            name=repr(robot.name),
        )
    model = training_result.models[training_result.recommended_kind]
    records = read_records_of_model(options, robot, options.records)
    samples = [
        read_samples(robot, model.axis, record, str(path))
        for record, path in zip(records, options.records, strict=True)
    ]
    evaluated_samples = [(sample, sample.first) for sample in samples]
    residuals = {}
    print_model(options, robot.name)
    with TerminalProgressLine(sys.stderr, options.wording) as show_progress:
        for number, (kind, inverse) in enumerate(training_result.models.items(), start=1):
            residuals[kind] = compute_residual(inverse, evaluated_samples)
            fraction = number / len(training_result.models)
            show_progress(Progress("check", model.axis, kind, fraction))
    document = format_json(make_document(model, residuals, training_result))
    if options.json not in (None, "-"):
        write_text(Path(options.json), document)
    print(document if options.json == "-" else format_table(model, residuals, options.wording))
    if options.json != "-":
        print_message(
            options,
            message("cli", "recommended after training: {why}").fill(
                why=training_result.recommendation_reason
            ),
        )
    return 0
