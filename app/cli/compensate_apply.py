"""``rotemina compensate apply``: write a trajectory with compensated commands."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rotemina.app.cli.options import (
    add_columns,
    add_robot,
    records_of_model,
    robot_of,
    tell,
    tell_model,
    tell_written,
)
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.speed_and_acceleration import SETPOINT_PERIOD_S

if TYPE_CHECKING:
    from rotemina.app.motion.compensation import NamedInverse


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the verb."""
    parser = verbs.add_parser(
        "apply",
        help="write a trajectory with the commands that compensate its hysteresis",
        description="Send a trajectory through the inverse that a file recommends, check the "
        "result against the robot's limits, and write it: any player can play it. The"
        " axis must start at rest after a rise from the low end of its range.",
    )
    parser.add_argument("inverse", type=Path, metavar="INVERSE", help="a file that train wrote")
    parser.add_argument("trajectory", type=Path, metavar="TRAJECTORY")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT")
    add_robot(parser)
    add_columns(parser)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Compensate, check, write."""
    from rotemina.app.motion.compensation import compensated_trajectory

    for path in (options.inverse, options.trajectory):
        if options.output.absolute() == path.absolute():
            raise InputError(
                message("cli", "{path} is named twice; give the output another name").fill(
                    path=path
                )
            )
    robot = robot_of(options)
    inverse = named_inverse(options.inverse, robot)
    (trajectory,) = records_of_model(options, robot, [options.trajectory])
    axis = inverse.model.axis
    sent = compensated_trajectory(robot, trajectory, {axis: inverse}, SETPOINT_PERIOD_S).commands
    write_record(sent, options.output)
    tell_model(options, robot.name)
    tell_written(options, options.output, len(sent.time_s), sent.duration_s)
    said = message("cli", "axis {axis}: commands of {inverse}; other axes unchanged")
    tell(options, said.fill(axis=axis, inverse=inverse.name))
    return 0


def named_inverse(path: Path, robot: Robot) -> "NamedInverse":
    """Return the inverse that a file recommends.

    Raises
    ------
    CompensationError
        If it cannot be read, or is of another robot.
    """
    from rotemina.app.motion.compensation import NamedInverse, check_belongs
    from rotemina.sim.compensate.file import read_trained
    from rotemina.sim.compensate.judgement import NAMES

    trained, provenance = read_trained(path)
    model = trained.models[trained.chosen]
    inverse = NamedInverse(model, provenance.robot, f"{NAMES[trained.chosen]}, {path.name}")
    check_belongs(robot, inverse)
    return inverse
