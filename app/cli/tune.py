"""``rotemina tune``: search the gains of a position loop on the simulated axis."""

import argparse
import sys
from concurrent.futures import ThreadPoolExecutor
from math import isfinite
from pathlib import Path
from typing import Any

from rotemina.app.cli.options import add_robot, robot_with_effects, tell, tell_model
from rotemina.app.cli.progress import ProgressLine
from rotemina.app.cli.workers import workers
from rotemina.app.files import json_text, write_text
from rotemina.sim.errors import InputError
from rotemina.sim.feedback.axis_loop import AxisLoop
from rotemina.sim.feedback.stability import check_stability
from rotemina.sim.gap.compare.diagnosis_progress import Progress
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, fixed, rounded
from rotemina.sim.tables import aligned
from rotemina.sim.tuning.objectives import SecondObjective

_RATE_HZ = 5000.0

_HEAD = (
    message("cli", "point"),
    message("cli", "tracking [%]"),
    message("cli", "settling [ms]"),
    message("cli", "overshoot [%]"),
    "Ms",
    message("cli", "effort [1/s]"),
    message("cli", "integral [1/s]"),
    "",
    "",
)


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "tune",
        help="find the gains of a position loop on the simulated axis",
        description="Search the gains of a PI or PID loop with notch and low-pass for one axis, "
        "by NSGA-II on the simulated loop with the effects and the noise of its robot"
        " file: least tracking error against least effort or settling time, with a "
        "bound on the peak sensitivity of axes whose gain and resonance are off by 5 "
        "%. Ctrl-C ends the search and keeps the points found so far.",
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        metavar="TUNING",
        help="file of the result, TOML",
    )
    parser.add_argument("--axis", metavar="NAME", help="axis to be tuned")
    add_robot(parser)
    parser.add_argument(
        "--effects", metavar="FILE", help="take the effects of this robot file instead"
    )
    parser.add_argument(
        "--inverse",
        type=Path,
        metavar="FILE",
        help="feed forward through the inverse that this file recommends",
    )
    parser.add_argument(
        "--rate",
        type=float,
        default=_RATE_HZ,
        metavar="HZ",
        help="rate of the loop (default: 5000)",
    )
    parser.add_argument(
        "--delay", type=int, default=0, metavar="N", help="delay of the outputs in intervals"
    )
    parser.add_argument(
        "--against",
        choices=[str(one) for one in SecondObjective],
        default=str(SecondObjective.EFFORT),
        help="second objective beside the tracking error (default: effort)",
    )
    for name, preset in (("generations", 50), ("population", 60), ("seed", 1)):
        parser.add_argument(
            f"--{name}", type=int, default=preset, metavar="N", help="default: %(default)s"
        )
    parser.add_argument("--jobs", type=int, metavar="N", help="number of cores (default: all)")
    parser.add_argument(
        "--json", metavar="OUT", help="write the result as JSON too ('-' prints it)"
    )
    parser.add_argument(
        "--choose",
        type=int,
        metavar="N",
        help="do not search: choose point N of the existing result",
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Search, or choose; write the result, and print it."""
    return _choose(options) if options.choose is not None else _search(options)


def _search(options: argparse.Namespace) -> int:
    if options.axis is None:
        raise InputError(message("cli", "tune: name the axis by --axis, or a point by --choose"))
    _check(options)
    # These take their time to import, which only a search needs.
    from rotemina.sim.tuning.search import Generation, SearchSettings, generations
    from rotemina.sim.tuning.search_problem import TuningProblem
    from rotemina.sim.tuning.tuning_result import save_tuning, tuning_of

    settings = SearchSettings(
        generations=options.generations,
        population=options.population,
        seed=options.seed,
        against=SecondObjective(options.against),
    )
    problem = TuningProblem(
        robot_with_effects(options),
        options.axis,
        options.rate,
        delay=options.delay,
        inverse=_inverse(options),
    )
    tell_model(options, problem.robot.name)
    last: Generation | None = None
    with (
        workers(options.jobs, None) as jobs,
        ThreadPoolExecutor(jobs) as pool,
        ProgressLine(sys.stderr, options.wording) as listener,
    ):
        try:
            for last in generations(problem, settings, pool.map):
                found = message("cli", "{done} of {total} generations, {points} points").fill(
                    done=last.done, total=last.total, points=len(last.front)
                )
                listener(Progress("tuning", options.axis, found, last.share))
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            if last is None or not last.front:
                raise
    assert last is not None
    tuning = tuning_of(
        problem, settings, last, inverse=str(options.inverse.name) if options.inverse else ""
    )
    save_tuning(tuning, options.output)
    _tell(tuning, options)
    if tuning.provenance.whole:
        return 0
    said = message(
        "cli",
        "stopped after {done} of {total} generations; {output} holds the points found so far, "
        "and is marked as incomplete",
    ).fill(done=last.done, total=last.total, output=options.output)
    print(f"rotemina: {options.wording.of(said)}", file=sys.stderr)
    return 130


def _choose(options: argparse.Namespace) -> int:
    from rotemina.sim.tuning.tuning_result import load_tuning, save_tuning

    tuning = load_tuning(options.output).choosing(options.choose)
    robot = robot_with_effects(options)
    if robot.name != tuning.provenance.robot:
        raise InputError(
            message(
                "cli",
                "{output} was tuned for robot {robot}, not for {name}; name the robot by --robot",
            ).fill(
                output=options.output, robot=repr(tuning.provenance.robot), name=repr(robot.name)
            )
        )
    loop = AxisLoop(robot, tuning.axis, tuning.rate_hz, delay=tuning.delay)
    check_stability(loop.sampled, tuning.best.gains, tuning.provenance.peak_sensitivity)
    save_tuning(tuning, options.output)
    tell_model(options, robot.name)
    _tell(tuning, options)
    return 0


def _check(options: argparse.Namespace) -> None:
    """Refuse before the work what would fail after it."""
    written = [options.output]
    if options.json not in (None, "-"):
        written.append(Path(options.json))
    read = [Path(one) for one in (options.robot, options.effects, options.inverse) if one]
    for number, output in enumerate(written):
        if not output.parent.is_dir():
            raise InputError(
                message("cli", "{output}: there is no folder {parent}; create it first").fill(
                    output=output, parent=output.parent
                )
            )
        others = [*written[:number], *read]
        if any(output.absolute() == other.absolute() for other in others):
            raise InputError(
                message("cli", "{output} is named twice; give each file its own name").fill(
                    output=output
                )
            )


def _inverse(options: argparse.Namespace) -> Any:
    """Load the inverse at the loop's rate; the loop's own lead stands in for its lag stage."""
    if options.inverse is None:
        return None
    from rotemina.sim.compensate.file import read_trained
    from rotemina.sim.compensate.inverse import Inverse

    trained, _ = read_trained(options.inverse)
    model = trained.models[trained.chosen]
    if model.axis != options.axis:
        raise InputError(
            message(
                "cli",
                "{inverse} is an inverse of axis {axis}, but {options_axis} is to be tuned; "
                "name one that was trained on this axis",
            ).fill(inverse=options.inverse, axis=model.axis, options_axis=options.axis)
        )
    return Inverse(model, 1.0 / options.rate, preview=True)


def _tell(tuning: Any, options: argparse.Namespace) -> None:
    from rotemina.sim.tuning.tuning_result import document_of

    text = json_text(_finite(document_of(tuning)))
    if options.json == "-":
        print(text)
        return
    if options.json is not None:
        write_text(Path(options.json), text + "\n")
    said = message("cli", "{output}: axis {axis}, loop at {rate}").fill(
        output=options.output, axis=tuning.axis, rate=exact(tuning.rate_hz, "Hz")
    )
    tell(options, said)
    rows: list[tuple[str, ...]] = [_HEAD]
    for number, point in enumerate(tuning.points):
        own = point.figures
        rows.append(
            (
                str(number),
                fixed(100.0 * own.tracking_rms, 4),
                fixed(1e3 * own.settling_s, 2),
                fixed(100.0 * own.overshoot, 3),
                fixed(own.peak_sensitivity, 3),
                fixed(own.effort, 3),
                rounded(point.gains.integral, 5),
                message("cli", "chosen") if number == tuning.chosen else "",
                message("cli", "recommended") if number == tuning.recommended else "",
            )
        )
    print(aligned([[options.wording.shown(cell) for cell in row] for row in rows]))


def _finite(value: Any) -> Any:
    """Return a document with null for what is not finite."""
    if isinstance(value, dict):
        return {key: _finite(own) for key, own in value.items()}
    if isinstance(value, list):
        return [_finite(own) for own in value]
    return None if isinstance(value, float) and not isfinite(value) else value
