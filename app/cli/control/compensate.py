"""``rotemina compensate``: inverse models of piezo hysteresis."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rotemina.app.cli.control import compensate_check, compensate_train
from rotemina.app.cli.terminal import (
    add_columns,
    add_robot,
    check_output_files,
    find_robot_file,
    load_selected_robot,
    print_message,
    print_model,
    print_written_file,
    read_records_of_model,
)
from rotemina.sim.messages import message
from rotemina.sim.records import write_record
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import DEFAULT_SETPOINT_PERIOD_S

if TYPE_CHECKING:
    from rotemina.app.motion.session import NamedInverse


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "compensate",
        help="train inverse models of hysteresis, check them, and apply them to trajectories",
        description="Learn which commands bring a piezo axis to the desired positions: an ANFIS, "
        "the modified and the classical Prandtl–Ishlinskii inverse and a straight "
        "line, compared with each other.",
    )
    verbs = parser.add_subparsers(title="subcommands", metavar="", required=True)
    compensate_train.add_parser(verbs)
    compensate_check.add_parser(verbs)
    _add_apply(verbs)


def _add_apply(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    parser = verbs.add_parser(
        "apply",
        help="write a trajectory with the commands that compensate its hysteresis",
        description="Convert a trajectory with the recommended inverse of a file, check the result "
        "against the robot's limits, and write it, so that any player can play it. The axis "
        "must start at rest after a rise from the low end of its range.",
    )
    parser.add_argument(
        "inverse", type=Path, metavar="INVERSE", help="file written by 'rotemina compensate train'"
    )
    parser.add_argument("trajectory", type=Path, metavar="TRAJECTORY")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT")
    add_robot(parser)
    add_columns(parser)
    parser.set_defaults(run=run_apply)


def run_apply(options: argparse.Namespace) -> int:
    """Compensate a trajectory, check it against the limits, and write it."""
    from rotemina.app.motion.session import make_compensated_trajectory

    check_output_files(
        [options.output], [options.inverse, options.trajectory, find_robot_file(options.robot)]
    )
    robot = load_selected_robot(options)
    inverse = load_named_inverse(options.inverse, robot)
    (trajectory,) = read_records_of_model(options, robot, [options.trajectory])
    axis = inverse.model.axis
    commands = make_compensated_trajectory(
        robot, trajectory, {axis: inverse}, DEFAULT_SETPOINT_PERIOD_S
    ).commands
    write_record(commands, options.output)
    print_model(options, robot.name)
    print_written_file(options, options.output, len(commands.time_s), commands.duration_s)
    text = message("cli", "axis {axis}: commands of {inverse}; other axes unchanged")
    print_message(options, text.fill(axis=axis, inverse=inverse.name))
    return 0


def load_named_inverse(path: Path, robot: Robot) -> "NamedInverse":
    """Load the recommended inverse of a file.

    Raises
    ------
    CompensationError
        If the file cannot be read, or belongs to another robot.
    """
    from rotemina.app.motion.session import NamedInverse, check_inverse_fits
    from rotemina.sim.compensate import KIND_NAMES, read_trained

    training_result, provenance = read_trained(path)
    model = training_result.models[training_result.recommended_kind]
    inverse = NamedInverse(
        model, provenance.robot, f"{KIND_NAMES[training_result.recommended_kind]}, {path.name}"
    )
    check_inverse_fits(robot, inverse)
    return inverse
