"""``rotemina play``: play a trajectory on the simulator and write the record."""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from rotemina.app.cli.compensate_apply import named_inverse
from rotemina.app.cli.options import (
    add_columns,
    add_max_speed,
    add_robot,
    check_speed_limits,
    records_of_model,
    robot_of,
    tell,
    tell_model,
    tell_written,
    with_max_speeds,
)
from rotemina.app.motion.player import play_offline
from rotemina.sim.errors import InputError
from rotemina.sim.messages import Wording, message
from rotemina.sim.quantities import exact
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.dry_run import DryRun, dry_run, moved_axes

if TYPE_CHECKING:
    from rotemina.app.motion.regulation import NamedRegulation


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "play",
        help="play a trajectory on the simulator and write the record",
        description="Check a trajectory against the robot's limits, play it on the simulator "
        "as fast as possible, and write the record.",
    )
    parser.add_argument("trajectory", type=Path, metavar="TRAJECTORY")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="RECORD",
        help="file for the record (default: TRAJECTORY-record.csv in this folder)",
    )
    add_robot(parser)
    add_columns(parser)
    add_max_speed(parser)
    parser.add_argument(
        "--compensate",
        type=Path,
        metavar="INVERSE",
        help="send every set-point through the inverse that this file recommends",
    )
    parser.add_argument(
        "--tuning",
        type=Path,
        metavar="FILE",
        help="close the loop that this file of rotemina tune has chosen, with --compensate"
        " as feed-forward if given",
    )
    parser.add_argument(
        "--seed", type=int, default=0, help="seed of the sensors' noise (default: 0)"
    )
    parser.add_argument(
        "--dry-run", action="store_true", help="only check the trajectory against the limits"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Check, play, and write the record."""
    robot = robot_of(options)
    (trajectory,) = records_of_model(options, robot, [options.trajectory])
    limited = with_max_speeds(options, robot, moved_axes(trajectory))
    checked = dry_run(limited, trajectory)
    if not checked.allowed:
        raise InputError(
            message("cli", "{trajectory}: {objections}{more}").fill(
                trajectory=options.trajectory, objections=checked.objections[0], more=_more(checked)
            )
        )
    if options.dry_run:
        said = message("cli", "{trajectory}: {duration}, {rows} rows, {verdict}").fill(
            trajectory=options.trajectory,
            duration=exact(checked.duration_s, "s"),
            rows=checked.rows,
            verdict=checked.verdict,
        )
        tell_model(options, robot.name)
        tell(options, said)
        return 0
    check_speed_limits(options, limited, checked.moved_axes)
    inverse = None if options.compensate is None else named_inverse(options.compensate, robot)
    loop = None if options.tuning is None else _loop(options.tuning, robot)
    output = options.output or _free_name(options.trajectory)
    tell_model(options, robot.name)
    record = play_offline(
        robot,
        checked.require().commands,  # the limit is the operator's, not the device's
        seed=options.seed,
        progress=_progress(options.wording),
        inverse=inverse,
        loop=loop,
    )
    write_record(record, output)
    tell_written(options, output, len(record.time_s), record.duration_s)
    return 0


def _loop(path: Path, robot: Robot) -> "NamedRegulation":
    """Return the loop that a file has chosen, if it is stable on this robot."""
    from rotemina.app.motion.regulation import regulation_of
    from rotemina.sim.tuning.tuning_result import load_tuning

    return regulation_of(robot, load_tuning(path), path.name)


def _more(checked: DryRun) -> str:
    others = len(checked.objections) - 1
    return f" (and {others} more)" if others else ""


def _free_name(trajectory: Path) -> Path:
    """Name the record after the trajectory; what is there already is not overwritten unasked."""
    stem = trajectory.name.removesuffix(".gz").rsplit(".", 1)[0]
    output = Path(f"{stem}-record.csv")
    if output.exists():
        raise InputError(
            message("cli", "{output} already exists; name the record by -o").fill(output=output)
        )
    return output


def _progress(wording: Wording) -> Callable[[float], None] | None:
    if not sys.stderr.isatty():
        return None

    def show(share: float) -> None:
        end = "\n" if share >= 1.0 else ""
        said = message("cli", "playing {share} %").fill(share=f"{100 * share:3.0f}")
        print(f"\r{wording.of(said)}", end=end, file=sys.stderr, flush=True)

    return show
