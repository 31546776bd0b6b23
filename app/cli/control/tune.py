"""``rotemina tune``: search for gains of a position loop with the simulated axis."""

import argparse
import sys
from concurrent.futures import ThreadPoolExecutor
from math import isfinite
from pathlib import Path
from typing import Any

from rotemina.app.cli.terminal import (
    TerminalProgressLine,
    add_robot,
    check_output_files,
    find_json_file,
    find_robot_file,
    load_robot_with_effects,
    prepare_workers,
    print_message,
    print_model,
)
from rotemina.app.errors import CommandError
from rotemina.app.settings import format_json, write_text
from rotemina.sim.feedback import AxisLoop, check_stability
from rotemina.sim.gap.result import Progress
from rotemina.sim.messages import format_fixed, format_rounded, message
from rotemina.sim.tuning import SecondObjective
from rotemina.sim.units import align_columns, format_exact

_DEFAULT_RATE_HZ = 5000.0

_TABLE_HEADER = (
    message("cli", "point"),
    message("cli", "tracking error [%]"),
    message("cli", "settling [ms]"),
    message("cli", "overshoot [%]"),
    "Ms",
    message("cli", "effort [1/s]"),
    message("cli", "integral gain [1/s]"),
    "",
    "",
)


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "tune",
        help="find gains for a position loop with the simulated axis",
        description="Search for the gains of a PI or PID loop with a notch and a low-pass filter "
        "for one axis. NSGA-II simulates the loop with the effects and the noise of the robot "
        "file. It minimizes the tracking error and, as second objective, the control effort or "
        "the settling time. The peak sensitivity stays bounded even if the gain and the "
        "resonance of the axis differ by 5 %. Ctrl-C ends the search and keeps the points "
        "found so far.",
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        metavar="TUNING",
        help="TOML file for the result; with --choose, the file to change",
    )
    parser.add_argument("--axis", metavar="NAME", help="axis to be tuned")
    add_robot(parser)
    parser.add_argument(
        "--effects",
        metavar="FILE",
        help="use the effects of this robot file instead of those of --robot",
    )
    parser.add_argument(
        "--inverse",
        type=Path,
        metavar="FILE",
        help="use the recommended inverse of this file as feed-forward",
    )
    parser.add_argument(
        "--rate",
        type=float,
        default=_DEFAULT_RATE_HZ,
        metavar="HZ",
        help="rate of the loop (default: 5000)",
    )
    parser.add_argument(
        "--delay",
        type=int,
        default=0,
        metavar="N",
        help="delay of the outputs, in sampling periods",
    )
    parser.add_argument(
        "--against",
        choices=[str(objective) for objective in SecondObjective],
        default=str(SecondObjective.EFFORT),
        help="second objective in addition to the tracking error (default: effort)",
    )
    for name, default in (("generations", 50), ("population", 60), ("seed", 1)):
        parser.add_argument(
            f"--{name}", type=int, default=default, metavar="N", help="default: %(default)s"
        )
    parser.add_argument("--jobs", type=int, metavar="N", help="number of cores (default: all)")
    parser.add_argument(
        "--json", metavar="OUT", help="also write the result as JSON ('-' prints it)"
    )
    parser.add_argument(
        "--choose",
        type=int,
        metavar="N",
        help="do not search: choose point N of the existing result",
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Search for gains or choose a point, then write and print the result."""
    return _choose_point(options) if options.choose is not None else _run_search(options)


def _run_search(options: argparse.Namespace) -> int:
    if options.axis is None:
        raise CommandError(
            "tune: give the axis with --axis, or the number of a point with --choose"
        )
    check_output_files([options.output, find_json_file(options.json)], _list_inputs(options))
    # These imports are slow, and only a search needs them.
    from rotemina.sim.tuning import (
        SearchGeneration,
        SearchSettings,
        TuningProblem,
        make_tuning,
        run_search,
        save_tuning,
    )

    settings = SearchSettings(
        generations=options.generations,
        population=options.population,
        seed=options.seed,
        against=SecondObjective(options.against),
    )
    problem = TuningProblem(
        load_robot_with_effects(options),
        options.axis,
        options.rate,
        delay=options.delay,
        inverse=_load_inverse(options),
    )
    print_model(options, problem.robot.name)
    generation: SearchGeneration | None = None
    with (
        prepare_workers(options.jobs, cluster=None) as jobs,
        ThreadPoolExecutor(jobs) as pool,
        TerminalProgressLine(sys.stderr, options.wording) as show_progress,
    ):
        try:
            for generation in run_search(problem, settings, pool.map):
                progress_text = message(
                    "cli", "{done} of {total} generations, {points} points"
                ).fill(done=generation.done, total=generation.total, points=len(generation.front))
                show_progress(
                    Progress("tuning", options.axis, progress_text, generation.completed_share)
                )
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            if generation is None or not generation.front:
                raise
    assert generation is not None
    tuning = make_tuning(
        problem, settings, generation, inverse=str(options.inverse.name) if options.inverse else ""
    )
    save_tuning(tuning, options.output)
    _print_tuning(tuning, options)
    if tuning.provenance.is_complete:
        return 0
    warning = message(
        "cli",
        "stopped after {done} of {total} generations; {output} holds the points found so far, "
        "and is marked as incomplete",
    ).fill(done=generation.done, total=generation.total, output=options.output)
    print(f"rotemina: {options.wording.format_message(warning)}", file=sys.stderr)
    return 130


def _choose_point(options: argparse.Namespace) -> int:
    """Choose another point in the existing result file ``--output``."""
    from rotemina.sim.tuning import load_tuning, save_tuning

    check_output_files([find_json_file(options.json)], [options.output, *_list_inputs(options)])
    tuning = load_tuning(options.output).with_choice(options.choose)
    robot = load_robot_with_effects(options)
    if robot.name != tuning.provenance.robot:
        raise CommandError(
            "{output} was tuned for robot {robot}, not for {name}; select that robot with --robot",
            output=options.output,
            robot=repr(tuning.provenance.robot),
            name=repr(robot.name),
        )
    loop = AxisLoop(robot, tuning.axis, tuning.rate_hz, delay=tuning.delay)
    check_stability(
        loop.sampled_axis, tuning.chosen_point.gains, tuning.provenance.peak_sensitivity
    )
    save_tuning(tuning, options.output)
    print_model(options, robot.name)
    _print_tuning(tuning, options)
    return 0


def _list_inputs(options: argparse.Namespace) -> list[Path | None]:
    return [find_robot_file(options.robot), find_robot_file(options.effects), options.inverse]


def _load_inverse(options: argparse.Namespace) -> Any:
    """Load the inverse at the rate of the loop.

    With ``preview``, the inverse omits its lag stage, because the loop passes the set-points to it
    earlier by just this lag.
    """
    if options.inverse is None:
        return None
    from rotemina.sim.compensate import Inverse, read_trained

    training_result, _ = read_trained(options.inverse)
    model = training_result.models[training_result.recommended_kind]
    if model.axis != options.axis:
        raise CommandError(
            "{inverse} is an inverse of axis {axis}, but {options_axis} is to be tuned; "
            "choose one that was trained on this axis",
            inverse=options.inverse,
            axis=model.axis,
            options_axis=options.axis,
        )
    return Inverse(model, 1.0 / options.rate, preview=True)


def _print_tuning(tuning: Any, options: argparse.Namespace) -> None:
    from rotemina.sim.tuning import to_document

    text = format_json(_replace_non_finite(to_document(tuning)))
    if options.json == "-":
        print(text)
        return
    if options.json is not None:
        write_text(Path(options.json), text + "\n")
    title = message("cli", "{output}: axis {axis}, loop at {rate}").fill(
        output=options.output, axis=tuning.axis, rate=format_exact(tuning.rate_hz, "Hz")
    )
    print_message(options, title)
    rows: list[tuple[str, ...]] = [_TABLE_HEADER]
    for number, point in enumerate(tuning.points):
        figures = point.figures
        rows.append(
            (
                str(number),
                format_fixed(100.0 * figures.tracking_rms, 4),
                format_fixed(1e3 * figures.settling_s, 2),
                format_fixed(100.0 * figures.overshoot, 3),
                format_fixed(figures.peak_sensitivity, 3),
                format_fixed(figures.effort, 3),
                format_rounded(point.gains.integral, 5),
                message("cli", "chosen") if number == tuning.chosen else "",
                message("cli", "recommended") if number == tuning.recommended else "",
            )
        )
    print(align_columns([[options.wording.format_field(cell) for cell in row] for row in rows]))


def _replace_non_finite(value: Any) -> Any:
    """Replace numbers that are not finite by None, because JSON has no such numbers."""
    if isinstance(value, dict):
        return {key: _replace_non_finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_replace_non_finite(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value
