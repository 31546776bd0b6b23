"""``rotemina gap``: diagnose the gap between model and machine, and use the result.

``check`` says which effects records can show, ``diagnose`` finds causes, ``predict`` simulates
the corrected model, ``twin`` writes it as a robot file, ``blind`` tests the diagnosis with
generated cases, and ``bench`` with machines whose causes are known.
"""

import argparse
from pathlib import Path

from rotemina.app.cli.gap import gap_bench, gap_blind, gap_check, gap_diagnose
from rotemina.app.cli.terminal import (
    add_columns,
    check_output_files,
    print_message,
    print_model,
    print_written_file,
)
from rotemina.app.errors import CommandError
from rotemina.sim.gap.output import make_twin_text, predict, read_document, write_twin
from rotemina.sim.messages import join_messages, message
from rotemina.sim.records import read_record, write_record
from rotemina.sim.trajectory import check_commands_fit_model


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "gap",
        help="diagnose the gap between model and machine, predict, correct the model",
        description="Diagnose the gap between the model and records of the real machine.",
    )
    parser.set_defaults(run=_require_subcommand)
    verbs = parser.add_subparsers(title="subcommands", metavar="")
    gap_check.add_parser(verbs)
    gap_diagnose.add_parser(verbs)
    _add_predict(verbs)
    _add_twin(verbs)
    gap_blind.add_parser(verbs)
    gap_bench.add_parser(verbs)


def _require_subcommand(_options: argparse.Namespace) -> int:
    raise CommandError(
        "gap: name a subcommand: check, diagnose, predict, twin, blind or bench (see --help)"
    )


def _add_predict(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    parser = verbs.add_parser(
        "predict",
        help="write the response of the corrected model to new commands",
        description="Drive the corrected model of a diagnosis with the commands of a trajectory "
        "or record, and write the expected record, without noise, rounding and "
        "random effects.",
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
        help="the motion before this one; the model starts in the state after that motion",
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
        description="Write the diagnosed robot as a robot file for the option --robot of every "
        "command. The fitted effects are appended to its own effects.",
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
    """Predict the record of the corrected model, and write it."""
    document = read_document(options.document)
    robot = document.corrected
    commands = read_record(options.commands, columns=options.columns, robot=robot)
    remedy = message("cli", "diagnose the records of that machine")
    check_commands_fit_model(robot, commands, options.commands, remedy)
    output = options.output or _make_output_path(options.commands)
    check_output_files([output], [options.document, options.commands, options.after])
    previous_motion = None
    if options.after is not None:
        previous_motion = read_record(options.after, columns=options.columns, robot=robot)
    elif options.pause:
        raise CommandError("--pause needs a previous motion; give its record with --after")
    print_model(options, robot.name, options.document)
    record = predict(
        robot, commands, document.offsets, after=previous_motion, pause_s=options.pause
    )
    write_record(record, output)
    print_written_file(options, output, len(record.time_s), record.duration_s)
    return 0


def run_twin(options: argparse.Namespace) -> int:
    """Write the robot file of the corrected model."""
    check_output_files([options.output], [options.document])
    document = read_document(options.document)
    write_twin(make_twin_text(document.robot, document.effects, options.base), options.output)
    effect_texts = [
        message("cli", "{effect} on axis {axis}").fill(effect=effect.id, axis=effect.axis)
        for effect in document.effects
    ]
    text = message("cli", "{output}: robot {robot} with {effects}").fill(
        output=options.output,
        robot=document.robot.name,
        effects=join_messages(effect_texts, ", ")
        if effect_texts
        else message("cli", "no further effects"),
    )
    print_message(options, text)
    return 0


def _make_output_path(commands: Path) -> Path:
    """Derive the file name of the record from that of the commands; refuse an existing file."""
    stem = commands.name.removesuffix(".gz").rsplit(".", 1)[0]
    output = Path(f"{stem}-predicted.csv")
    if output.exists():
        raise CommandError("{output} already exists; choose another file with -o", output=output)
    return output
