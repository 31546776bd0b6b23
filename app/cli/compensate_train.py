"""``rotemina compensate train``: train the inverses of an axis on records or the simulator."""

import argparse
import hashlib
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from rotemina.app.cli.compensate_table import document, table
from rotemina.app.cli.options import (
    add_columns,
    add_robot,
    records_of_model,
    robot_of,
    tell,
    tell_model,
)
from rotemina.app.cli.progress import ProgressLine
from rotemina.app.files import json_text, write_text
from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare.diagnosis_progress import Progress
from rotemina.sim.input_files import open_file
from rotemina.sim.messages import message
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import PiezoAxis, Robot

if TYPE_CHECKING:
    from rotemina.sim.compensate.samples import Samples

_PROGRAMS = ("rotemina", "numpy", "scipy", "numba")


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the verb."""
    parser = verbs.add_parser(
        "train",
        help="train the inverses of an axis with records, or with the simulator",
        description="Train inverses of all kinds with records that have cmd and meas (or ref), "
        "compare them on rows that none was trained with, and recommend one with the "
        "reason.",
    )
    parser.add_argument("records", type=Path, nargs="*", metavar="RECORD")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--axis",
        metavar="NAME",
        help="axis to be compensated (default: the only piezo axis of the record)",
    )
    parser.add_argument(
        "--held-out",
        type=Path,
        nargs="+",
        default=[],
        metavar="RECORD",
        help="compare on these records (default: the last quarter of each record)",
    )
    parser.add_argument(
        "--simulate", action="store_true", help="use no records: move the axis on the simulator"
    )
    parser.add_argument(
        "--effects", metavar="FILE", help="simulate with the effects of this robot file instead"
    )
    parser.add_argument(
        "--seed", type=int, metavar="N", help="seed of the simulated motion and noise (default: 0)"
    )
    parser.add_argument("--json", metavar="OUT", help="write the figures as JSON ('-' prints them)")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Train, write the file, and print how far each kind is off."""
    from rotemina.sim.compensate.file import Provenance, Source, write_trained  # heavy to import
    from rotemina.sim.compensate.training import train

    _check(options)
    robot = robot_of(options)
    seed = None
    if options.simulate:
        seed = 0 if options.seed is None else options.seed
        runs, held_out = [_simulated(options, robot, seed)], []
    else:
        runs, held_out = _recorded(options, robot)

    def sources(samples: Sequence["Samples"], paths: Sequence[Path]) -> list[Source]:
        return [
            Source(name=path.name, sha256=_digest(path), rows=len(each.command))
            for each, path in zip(samples, paths, strict=bool(paths))
        ]

    tell_model(options, robot.name)
    with ProgressLine(sys.stderr, options.wording) as line:
        trained = train(
            robot,
            runs,
            held_out,
            listener=lambda what, share: line(Progress(what, runs[0].axis, None, share)),
        )
    provenance = Provenance(
        robot=robot.name,
        trained_on=sources(runs, options.records),
        held_out=sources(held_out, options.held_out),
        seed=seed,
        versions={name: version(name) for name in _PROGRAMS},
    )
    write_trained(options.output, trained, provenance)
    figures = document(trained.models[trained.chosen], trained.residuals, trained)
    if options.json not in (None, "-"):
        write_text(Path(options.json), json_text(figures))
    if options.json == "-":
        print(json_text(figures))
        return 0
    print(table(trained.models[trained.chosen], trained.residuals, options.wording))
    for remark in trained.remarks:
        print(f"rotemina: {options.wording.shown(remark)}", file=sys.stderr)
    tell(options, message("cli", "recommended: {why}").fill(why=trained.why))
    said = message("cli", "{output}: {count} inverses")
    tell(options, said.fill(output=options.output, count=len(trained.models)))
    return 0


def _check(options: argparse.Namespace) -> None:
    if options.simulate and (options.records or options.held_out):
        raise InputError(message("cli", "--simulate takes no records; leave out one or the other"))
    if not options.simulate and not options.records:
        raise InputError(message("cli", "no record is named; name one, or use --simulate"))
    if not options.simulate and (options.effects is not None or options.seed is not None):
        raise InputError(
            message("cli", "--effects and --seed belong to --simulate; leave them out, or add it")
        )
    if options.simulate and options.axis is None:
        raise InputError(message("cli", "--simulate needs --axis NAME"))
    if options.seed is not None and options.seed < 0:
        raise InputError(message("cli", "--seed {seed}: must be 0 or more").fill(seed=options.seed))
    if not options.output.parent.is_dir():  # told before the work, not after it
        raise InputError(
            message("cli", "{output}: there is no folder {parent}; create it").fill(
                output=options.output, parent=options.output.parent
            )
        )
    for path in (*options.records, *options.held_out):
        if path.absolute() == options.output.absolute():
            raise InputError(
                message("cli", "{path} is named twice; give each file its own name").fill(path=path)
            )


def _recorded(options: argparse.Namespace, robot: Robot) -> tuple[list["Samples"], list["Samples"]]:
    from rotemina.sim.compensate.samples import samples_of

    paths = [*options.records, *options.held_out]
    records = records_of_model(options, robot, paths)
    axis = options.axis or _only([n for n in records[0].axes if _is_piezo(robot, n)], paths[0])
    samples = [
        samples_of(robot, axis, record, str(path))
        for record, path in zip(records, paths, strict=True)
    ]
    return samples[: len(options.records)], samples[len(options.records) :]


def _is_piezo(robot: Robot, name: str) -> bool:
    return isinstance(robot.axes.get(name), PiezoAxis)


def _only(names: Sequence[str], path: Path) -> str:
    if len(names) != 1:
        found = ", ".join(names) or "none"
        raise InputError(
            message("cli", "{path}: its piezo axes are {found}; name one by --axis").fill(
                path=path, found=found
            )
        )
    return names[0]


def _simulated(options: argparse.Namespace, robot: Robot, seed: int) -> "Samples":
    import numpy as np

    from rotemina.sim.compensate.excitation import excitation
    from rotemina.sim.compensate.samples import samples_of
    from rotemina.sim.simulation.simulation import simulate

    effects = None if options.effects is None else load_robot(options.effects).effects
    rng = np.random.default_rng(seed)
    commands = excitation(robot, options.axis, rng)
    return samples_of(robot, options.axis, simulate(robot, effects, commands, rng), "simulation")


def _digest(path: Path) -> str:
    with open_file(path, InputError) as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
