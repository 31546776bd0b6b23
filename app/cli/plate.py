"""``rotemina plate``: compute the plate that holds the pin, and put it into a robot file."""

import argparse
from pathlib import Path

import numpy as np

from rotemina.app.cli.options import add_robot, robot_of, tell_model
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.export import write_vtu
from rotemina.sim.plate.mesh import DIVISIONS
from rotemina.sim.plate.modes import eigenmodes
from rotemina.sim.plate.pin import pin_length
from rotemina.sim.plate.plate_report import (
    entry_text,
    mode_lines,
    plate_lines,
    ramp_lines,
    range_lines,
)
from rotemina.sim.plate.quasi_static_ramp import DURATION_S, STEPS, Ramp, move_bottom, ramp_path
from rotemina.sim.plate.robot_entries import applied
from rotemina.sim.plate.statics import UnitSolutions, hold, solve
from rotemina.sim.plate.stress import least_safety, motion_ranges
from rotemina.sim.robot.model import Robot
from rotemina.sim.robot.writing import write_robot
from rotemina.sim.whole_files import replaced

_COLUMNS = (
    "time_s,bottom_zn_m,bottom_thx_rad,bottom_thy_rad,hub_zn_m,hub_thx_rad,hub_thy_rad,"
    "force_N,moment_x_Nm,moment_y_Nm,slip_m,slip_x_rad,slip_y_rad,friction_used,pin_stress_Pa"
)


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "plate",
        help="compute the plate that holds the pin by finite elements: stress, stiffness, modes",
        description="Compute the thin plate that holds the pin, as [plate] of the robot file "
        "describes it (without that, the shipped plate).",
    )
    verbs = parser.add_subparsers(title="subcommands", metavar="", required=True)
    _add_solve(verbs)
    _add_apply(verbs)


def _add_solve(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    solving = verbs.add_parser(
        "solve",
        help="compute stress, reactions, stiffness, friction in the seat, modes, safety "
        "against yield",
        description="Move the pin's bottom slowly to a place (by default to the end of the range "
        "of every axis), and report.",
    )
    _add_common(solving)
    solving.add_argument("--zn", type=float, metavar="UM", help="displacement along the pin, µm")
    solving.add_argument(
        "--thx",
        type=float,
        metavar="URAD",
        help="sideways displacement divided by the pin's length, µrad",
    )
    solving.add_argument(
        "--thy",
        type=float,
        metavar="URAD",
        help="sideways displacement divided by the pin's length, µrad",
    )
    solving.add_argument(
        "--seconds",
        type=float,
        default=DURATION_S,
        metavar="S",
        help="duration of the motion, s (default: 30)",
    )
    solving.add_argument("--back", action="store_true", help="move back to the start as well")
    solving.add_argument(
        "--modes", type=int, default=10, metavar="N", help="number of modes (default: 10)"
    )
    solving.add_argument("--vtu", type=Path, metavar="FILE", help="write mesh and fields")
    solving.add_argument("--ramp", type=Path, metavar="FILE", help="write the motion as CSV (SI)")
    solving.set_defaults(run=_solve)


def _add_apply(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    applying = verbs.add_parser(
        "apply",
        help="write a robot file with the plate's stiffness, mass and couplings",
        description="Turn the plate into entries of a robot file, and print how far they are from"
        " its present ones. Damping stays.",
    )
    _add_common(applying)
    applying.add_argument("-o", "--output", type=Path, required=True, metavar="ROBOT_FILE")
    applying.set_defaults(run=_apply)


def _add_common(parser: argparse.ArgumentParser) -> None:
    add_robot(parser)
    parser.add_argument(
        "--divisions",
        type=int,
        default=DIVISIONS,
        metavar="N",
        help="elements around the circumference (default: %(default)s)",
    )


def _solve(options: argparse.Namespace) -> int:
    """Solve the plate and print what comes out."""
    robot = robot_of(options)
    ranges = motion_ranges(robot)
    target = _target(options, ranges)
    length = pin_length(robot)
    solutions = solve(hold(robot.plate, options.divisions))
    path = ramp_path(target, steps=STEPS, back=options.back)
    ramp = move_bottom(solutions, length, path, options.seconds)
    modes = eigenmodes(solutions.held, length, options.modes)
    if options.vtu is not None:
        write_vtu(options.vtu, solutions, ramp.hub[STEPS], modes)
    if options.ramp is not None:
        _write_ramp(ramp, options.ramp)
    tell_model(options, robot.name)
    for lines in (
        plate_lines(solutions),
        ramp_lines(solutions, ramp),
        range_lines(least_safety(solutions, ranges), robot.plate),
        mode_lines(modes),
    ):
        print("\n".join(lines))
    return 0


def _target(options: argparse.Namespace, ranges: np.ndarray) -> np.ndarray:
    """Return where the pin's bottom goes, SI: what is given, or else the ends of the ranges."""
    given = [options.zn, options.thx, options.thy]
    if all(value is None for value in given):
        return ranges[:, 1]
    target = np.array([0.0 if value is None else 1e-6 * value for value in given])
    if not np.isfinite(target).all():
        raise InputError(message("cli", "--zn, --thx, --thy: must be finite numbers"))
    if np.abs(target).max() > _FARTHEST:
        raise PlateError(
            message(
                "cli",
                "the pin's bottom cannot move that far: --zn, --thx, --thy must be within ± "
                "{farthest} µm or µrad",
            ).fill(farthest=1000000.0 * _FARTHEST)
        )
    return target


_FARTHEST = 0.01  # m or rad; far beyond what linear theory is for


def _write_ramp(ramp: Ramp, path: Path) -> None:
    table = np.column_stack(
        [
            ramp.time_s,
            ramp.bottom,
            ramp.hub,
            ramp.force,
            ramp.slip,
            ramp.utilization,
            ramp.pin_stress,
        ]
    )
    with replaced(path) as file:
        np.savetxt(file, table, delimiter=",", header=_COLUMNS, comments="", fmt="%.12g")


def _apply(options: argparse.Namespace) -> int:
    """Write the robot with the plate's figures and print how far they are."""
    robot: Robot = robot_of(options)
    solutions: UnitSolutions = solve(hold(robot.plate, options.divisions))
    made, entries = applied(robot, solutions)
    write_robot(made, options.output)
    tell_model(options, robot.name)
    print("\n".join(plate_lines(solutions)))
    print(f"{options.output}: entries, and how far they are from those of {robot.name}")
    print("\n".join(f"  {entry_text(entry)}" for entry in entries))
    return 0
