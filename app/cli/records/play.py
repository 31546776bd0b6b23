"""``rotemina play``: play a trajectory on the simulator and write the record."""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from rotemina.app.cli.control import load_named_inverse
from rotemina.app.cli.terminal import (
    add_columns,
    add_max_speed,
    add_robot,
    check_output_files,
    find_robot_file,
    load_selected_robot,
    print_message,
    print_model,
    print_written_file,
    read_records_of_model,
    require_speed_limits,
    with_max_speeds,
)
from rotemina.app.errors import CommandError
from rotemina.app.motion import playback
from rotemina.sim.messages import MessageWording, message
from rotemina.sim.records import write_record
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import (
    DryRun,
    dry_run,
    find_moved_axes,
)
from rotemina.sim.units import format_exact

if TYPE_CHECKING:
    from rotemina.app.motion.session import NamedRegulation


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
        help="convert every set-point with the recommended inverse of this file",
    )
    parser.add_argument(
        "--tuning",
        type=Path,
        metavar="FILE",
        help="control the axis with the loop chosen in this file of 'rotemina tune'; "
        "--compensate, if given, becomes its feed-forward",
    )
    parser.add_argument("--seed", type=int, default=0, help="seed of the sensor noise (default: 0)")
    parser.add_argument(
        "--dry-run", action="store_true", help="only check the trajectory against the limits"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Check and play the trajectory, and write the record."""
    check_output_files(
        [options.output],
        [
            options.trajectory,
            options.compensate,
            options.tuning,
            find_robot_file(options.robot),
        ],
    )
    robot = load_selected_robot(options)
    (trajectory,) = read_records_of_model(options, robot, [options.trajectory])
    limited_robot = with_max_speeds(options, robot, find_moved_axes(trajectory))
    dry_run_result = dry_run(limited_robot, trajectory)
    if not dry_run_result.allowed:
        raise CommandError(
            "{trajectory}: {objections}{more}",
            trajectory=options.trajectory,
            objections=dry_run_result.objections[0],
            more=_describe_more_objections(dry_run_result),
        )
    if options.dry_run:
        text = message("cli", "{trajectory}: {duration}, {rows} rows, {verdict}").fill(
            trajectory=options.trajectory,
            duration=format_exact(dry_run_result.duration_s, "s"),
            rows=dry_run_result.rows,
            verdict=dry_run_result.verdict,
        )
        print_model(options, robot.name)
        print_message(options, text)
        return 0
    require_speed_limits(options, limited_robot, dry_run_result.moved_axes)
    inverse = None if options.compensate is None else load_named_inverse(options.compensate, robot)
    loop = None if options.tuning is None else _load_loop(options.tuning, robot)
    output = options.output or _make_output_path(options.trajectory)
    print_model(options, robot.name)
    # --max-speed limits only the trajectory, so the simulator receives the original robot.
    record = playback.play_offline(
        robot,
        dry_run_result.require().commands,
        seed=options.seed,
        progress=_make_progress_printer(options.wording),
        inverse=inverse,
        loop=loop,
    )
    write_record(record, output)
    print_written_file(options, output, len(record.time_s), record.duration_s)
    return 0


def _load_loop(path: Path, robot: Robot) -> "NamedRegulation":
    """Load the controller chosen in a tuning file.

    Raise InputError if its loop is unstable on this robot.
    """
    from rotemina.app.motion.session import make_regulation
    from rotemina.sim.tuning import load_tuning

    return make_regulation(robot, load_tuning(path), path.name)


def _describe_more_objections(dry_run_result: DryRun) -> str:
    other_count = len(dry_run_result.objections) - 1
    return f" (and {other_count} more)" if other_count else ""


def _make_output_path(trajectory: Path) -> Path:
    """Derive the file name of the record from that of the trajectory.

    Raise InputError if the file exists.
    """
    stem = trajectory.name.removesuffix(".gz").rsplit(".", 1)[0]
    output = Path(f"{stem}-record.csv")
    if output.exists():
        raise CommandError("{output} already exists; choose another file with -o", output=output)
    return output


def _make_progress_printer(wording: MessageWording) -> Callable[[float], None] | None:
    if not sys.stderr.isatty():
        return None

    def show(fraction: float) -> None:
        end = "\n" if fraction >= 1.0 else ""
        text = message("cli", "playing {share} %").fill(share=f"{100 * fraction:3.0f}")
        print(f"\r{wording.format_message(text)}", end=end, file=sys.stderr, flush=True)

    return show
