"""``rotemina compensate check``: check inverses on records not used in training."""

import argparse
import sys
from pathlib import Path

from rotemina.app.cli.compensate_table import document, table
from rotemina.app.cli.options import (
    add_columns,
    add_robot,
    records_of_model,
    robot_of,
    tell,
    tell_model,
)
from rotemina.app.cli.progress import ProgressLine
from rotemina.app.files import json_text, write_text
from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare.diagnosis_progress import Progress
from rotemina.sim.messages import message


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the verb."""
    parser = verbs.add_parser(
        "check",
        help="compare the commands of inverses for measured positions with the recorded ones",
        description="Feed the positions of records to each inverse of a file, and print the "
        "difference between its command and the recorded one. Rows with unknown "
        "history count from the first sweep over the whole range on.",
    )
    parser.add_argument("inverse", type=Path, metavar="INVERSE", help="a file that train wrote")
    parser.add_argument("records", type=Path, nargs="+", metavar="RECORD")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument("--json", metavar="OUT", help="write the figures as JSON ('-' prints them)")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Check, and print how far each kind is off."""
    from rotemina.sim.compensate.file import read_trained  # heavy to import
    from rotemina.sim.compensate.judgement import residual
    from rotemina.sim.compensate.samples import samples_of

    robot = robot_of(options)
    trained, provenance = read_trained(options.inverse)
    if provenance.robot != robot.name:
        raise InputError(
            message(
                "cli",
                "{inverse} was trained for robot {robot}, not for {name}; name that robot by "
                "--robot",
            ).fill(inverse=options.inverse, robot=repr(provenance.robot), name=repr(robot.name))
        )
    model = trained.models[trained.chosen]
    records = records_of_model(options, robot, options.records)
    samples = [
        samples_of(robot, model.axis, record, str(path))
        for record, path in zip(records, options.records, strict=True)
    ]
    runs = [(each, each.first) for each in samples]
    residuals = {}
    tell_model(options, robot.name)
    with ProgressLine(sys.stderr, options.wording) as line:
        for number, (kind, one) in enumerate(trained.models.items(), start=1):
            residuals[kind] = residual(one, runs)
            line(Progress("check", model.axis, kind, number / len(trained.models)))
    figures = json_text(document(model, residuals, trained))
    if options.json not in (None, "-"):
        write_text(Path(options.json), figures)
    print(figures if options.json == "-" else table(model, residuals, options.wording))
    if options.json != "-":
        tell(options, message("cli", "recommended after training: {why}").fill(why=trained.why))
    return 0
