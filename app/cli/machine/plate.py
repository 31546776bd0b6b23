"""``rotemina plate``: compute the plate that holds the pin, and put it into a robot file."""

import argparse
from pathlib import Path

import numpy as np

from rotemina.app.cli.terminal import add_robot, load_selected_robot, print_model
from rotemina.app.errors import CommandError
from rotemina.sim.errors import PlateError
from rotemina.sim.files import replace_file
from rotemina.sim.messages import message
from rotemina.sim.plate import (
    DEFAULT_DIVISIONS,
    DEFAULT_DURATION_S,
    DEFAULT_STEPS,
    RampResponse,
    UnitSolutions,
    apply_plate,
    clamp_plate,
    compute_eigenmodes,
    entry_text,
    find_min_safety,
    make_ramp_path,
    mode_lines,
    motion_ranges,
    move_bottom,
    pin_length,
    plate_lines,
    ramp_lines,
    range_lines,
    solve_unit_motions,
    write_vtu,
)
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import write_robot

_RAMP_HEADER = (
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
        description="Move the pin's bottom slowly to a position (by default the upper end of the "
        "range of every axis), and print the results.",
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
        default=DEFAULT_DURATION_S,
        metavar="S",
        help="duration of the motion, s (default: 30)",
    )
    solving.add_argument("--back", action="store_true", help="move back to the start as well")
    solving.add_argument(
        "--modes", type=int, default=10, metavar="N", help="number of modes (default: 10)"
    )
    solving.add_argument("--vtu", type=Path, metavar="FILE", help="write mesh and fields")
    solving.add_argument("--ramp", type=Path, metavar="FILE", help="write the motion as CSV (SI)")
    solving.set_defaults(run=_solve_plate)


def _add_apply(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    applying = verbs.add_parser(
        "apply",
        help="write a robot file with the plate's stiffness, mass and couplings",
        description="Turn the plate into entries of a robot file, and print how far they differ "
        "from its present ones. Damping is not changed.",
    )
    _add_common(applying)
    applying.add_argument("-o", "--output", type=Path, required=True, metavar="ROBOT_FILE")
    applying.set_defaults(run=_apply_plate)


def _add_common(parser: argparse.ArgumentParser) -> None:
    add_robot(parser)
    parser.add_argument(
        "--divisions",
        type=int,
        default=DEFAULT_DIVISIONS,
        metavar="N",
        help="elements around the circumference (default: %(default)s)",
    )


def _solve_plate(options: argparse.Namespace) -> int:
    robot = load_selected_robot(options)
    ranges = motion_ranges(robot)
    target = _choose_target(options, ranges)
    length = pin_length(robot)
    solutions = solve_unit_motions(clamp_plate(robot.plate, options.divisions))
    path = make_ramp_path(target, steps=DEFAULT_STEPS, back=options.back)
    ramp = move_bottom(solutions, length, path, options.seconds)
    modes = compute_eigenmodes(solutions.clamped, length, options.modes)
    if options.vtu is not None:
        write_vtu(options.vtu, solutions, ramp.hub[DEFAULT_STEPS], modes)
    if options.ramp is not None:
        _write_ramp(ramp, options.ramp)
    print_model(options, robot.name)
    for lines in (
        plate_lines(solutions),
        ramp_lines(solutions, ramp),
        range_lines(find_min_safety(solutions, ranges), robot.plate),
        mode_lines(modes),
    ):
        print("\n".join(lines))
    return 0


def _choose_target(options: argparse.Namespace, ranges: np.ndarray) -> np.ndarray:
    """Return the target of the pin's bottom, SI: the options, or else the upper range ends."""
    displacements = [options.zn, options.thx, options.thy]
    if all(value is None for value in displacements):
        return ranges[:, 1]
    target = np.array([0.0 if value is None else 1e-6 * value for value in displacements])
    if not np.isfinite(target).all():
        raise CommandError("--zn, --thx, --thy: must be finite numbers")
    if np.abs(target).max() > _MAX_DISPLACEMENT:
        raise PlateError(
            message(
                "cli",
                "the pin's bottom cannot move that far: --zn, --thx, --thy must be within ± "
                "{farthest} µm or µrad",
            ).fill(farthest=1000000.0 * _MAX_DISPLACEMENT)
        )
    return target


# Far beyond the displacements for which linear theory holds, m or rad.
_MAX_DISPLACEMENT = 0.01


def _write_ramp(ramp: RampResponse, path: Path) -> None:
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
    with replace_file(path) as file:
        np.savetxt(file, table, delimiter=",", header=_RAMP_HEADER, comments="", fmt="%.12g")


def _apply_plate(options: argparse.Namespace) -> int:
    """Write the robot file with the plate's values, and print how they differ from the old ones."""
    robot: Robot = load_selected_robot(options)
    solutions: UnitSolutions = solve_unit_motions(clamp_plate(robot.plate, options.divisions))
    new_robot, entries = apply_plate(robot, solutions)
    write_robot(new_robot, options.output)
    print_model(options, robot.name)
    print("\n".join(plate_lines(solutions)))
    print(f"{options.output}: entries, and their deviations from those of {robot.name}")
    print("\n".join(f"  {entry_text(entry)}" for entry in entries))
    return 0
