"""``rotemina gap``: the diagnosis of the gap between model and machine, and what follows from it.

``diagnose`` finds causes, ``predict`` asks the corrected model, ``twin`` writes it as a robot
file, ``blind`` tests the diagnosis itself, ``bench`` does so on machines that are known.
"""

import argparse
from pathlib import Path

from rotemina.app.cli import gap_bench, gap_blind, gap_diagnose
from rotemina.app.cli.options import add_columns, tell, tell_model, tell_written
from rotemina.sim.errors import InputError
from rotemina.sim.gap.output.digital_twin import twin_text, write_twin
from rotemina.sim.gap.output.document_reader import read_document
from rotemina.sim.gap.output.prediction import predict
from rotemina.sim.messages import joined, message
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.writing import write_record
from rotemina.sim.trajectory.axis_limits import check_commands_of_model


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "gap",
        help="diagnose the gap between model and machine, predict, correct the model",
        description="Diagnose the gap between the model and records of the real machine.",
    )
    parser.set_defaults(run=_nothing)
    verbs = parser.add_subparsers(title="subcommands", metavar="")
    gap_diagnose.add_parser(verbs)
    _add_predict(verbs)
    _add_twin(verbs)
    gap_blind.add_parser(verbs)
    gap_bench.add_parser(verbs)


def _nothing(_options: argparse.Namespace) -> int:
    raise InputError(
        message(
            "cli",
            "gap: name a subcommand: diagnose, predict, twin, blind or bench (see --help)",
        )
    )


def _add_predict(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    parser = verbs.add_parser(
        "predict",
        help="write the corrected model's answer to new commands",
        description="Drive the corrected model of a diagnosis with the commands of a trajectory "
        "or record, and write the expected record, without noise, rounding and "
        "chance.",
    )
    parser.add_argument(
        "document", type=Path, metavar="OUT.json", help="file of 'gap diagnose --json'"
    )
    parser.add_argument("commands", type=Path, metavar="COMMANDS", help="a trajectory or record")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="RECORD",
        help="file for the record (default: COMMANDS-predicted.csv in this folder)",
    )
    parser.add_argument(
        "--after",
        type=Path,
        metavar="RECORD",
        help="the motion before this one; the model starts with its memory of it",
    )
    parser.add_argument(
        "--pause",
        type=float,
        default=0.0,
        metavar="S",
        help="seconds between the end of that motion and the first command (default: 0)",
    )
    add_columns(parser)
    parser.set_defaults(run=run_predict)


def _add_twin(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    parser = verbs.add_parser(
        "twin",
        help="write a robot file with the fitted effects",
        description="Write the diagnosed robot with the fitted effects after its own ones, as a "
        "robot file for --robot of every command.",
    )
    parser.add_argument(
        "document", type=Path, metavar="OUT.json", help="file of 'gap diagnose --json'"
    )
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="ROBOT")
    parser.add_argument(
        "--robot",
        dest="base",
        metavar="NAME_OR_FILE",
        help="keep the text of this robot file with its comments; it must be the diagnosed"
        " robot (default: the shipped robot if it is the same, else a new text)",
    )
    parser.set_defaults(run=run_twin)


def run_predict(options: argparse.Namespace) -> int:
    """Predict and write the record."""
    document = read_document(options.document)
    robot = document.corrected
    commands = read_record(options.commands, columns=options.columns, robot=robot)
    remedy = message("cli", "diagnose the records of that machine")
    check_commands_of_model(robot, commands, options.commands, remedy)
    output = options.output or _free_name(options.commands)
    for source in (options.document, options.commands, options.after):
        if source is not None and output.exists() and output.samefile(source):
            raise InputError(
                message("cli", "{output} is named twice; give each file its own name").fill(
                    output=output
                )
            )
    after = None
    if options.after is not None:
        after = read_record(options.after, columns=options.columns, robot=robot)
    elif options.pause:
        raise InputError(message("cli", "--pause: name the previous motion by --after"))
    tell_model(options, robot.name, options.document)
    record = predict(robot, commands, document.offsets, after=after, pause_s=options.pause)
    write_record(record, output)
    tell_written(options, output, len(record.time_s), record.duration_s)
    return 0


def run_twin(options: argparse.Namespace) -> int:
    """Write the robot file."""
    document = read_document(options.document)
    write_twin(twin_text(document.robot, document.effects, options.base), options.output)
    added = [
        message("cli", "{effect} on axis {axis}").fill(effect=effect.id, axis=effect.axis)
        for effect in document.effects
    ]
    said = message("cli", "{output}: robot {robot} with {effects}").fill(
        output=options.output,
        robot=document.robot.name,
        effects=joined(added, ", ") if added else message("cli", "no further effects"),
    )
    tell(options, said)
    return 0


def _free_name(commands: Path) -> Path:
    """Name the record after the commands; what is there already is not overwritten unasked."""
    stem = commands.name.removesuffix(".gz").rsplit(".", 1)[0]
    output = Path(f"{stem}-predicted.csv")
    if output.exists():
        raise InputError(
            message("cli", "{output} already exists; name the record by -o").fill(output=output)
        )
    return output
