"""``rotemina compensate train``: train the inverses of an axis with records or the simulator."""

import argparse
import hashlib
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from rotemina.app.cli.control.compensate_table import format_table, make_document
from rotemina.app.cli.terminal import (
    TerminalProgressLine,
    add_columns,
    add_robot,
    check_output_files,
    find_json_file,
    find_robot_file,
    load_selected_robot,
    print_message,
    print_model,
    read_records_of_model,
)
from rotemina.app.errors import CommandError
from rotemina.app.settings import format_json, write_text
from rotemina.sim.errors import InputError
from rotemina.sim.files import open_file
from rotemina.sim.gap.result import Progress
from rotemina.sim.messages import message
from rotemina.sim.robot import PiezoAxis, Robot
from rotemina.sim.robot_files import load_robot

if TYPE_CHECKING:
    from rotemina.sim.compensate import TrainingSamples

_RECORDED_PACKAGES = ("rotemina", "numpy", "scipy", "numba")


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = verbs.add_parser(
        "train",
        help="train the inverses of an axis with records, or with the simulator",
        description="Train inverses of all kinds with records that have cmd and meas (or ref), "
        "compare them on rows that were not used for training, and recommend one, with "
        "the reason.",
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
    """Train the inverses, write the file, and print the errors of each kind."""
    # These imports are slow, and other subcommands do not need them.
    from rotemina.sim.compensate import (
        InverseProvenance,
        InverseSource,
        train,
        write_trained,
    )

    _check_options(options)
    robot = load_selected_robot(options)
    seed = None
    if options.simulate:
        seed = 0 if options.seed is None else options.seed
        runs, held_out = [_simulate_samples(options, robot, seed)], []
    else:
        runs, held_out = _read_samples(options, robot)

    def describe_sources(
        samples: Sequence["TrainingSamples"], paths: Sequence[Path]
    ) -> list[InverseSource]:
        return [
            InverseSource(name=path.name, sha256=_digest_file(path), rows=len(sample.command))
            for sample, path in zip(samples, paths, strict=bool(paths))
        ]

    print_model(options, robot.name)
    with TerminalProgressLine(sys.stderr, options.wording) as show_progress:
        training_result = train(
            robot,
            runs,
            held_out,
            listener=lambda stage, share: show_progress(Progress(stage, runs[0].axis, None, share)),
        )
    provenance = InverseProvenance(
        robot=robot.name,
        trained_on=describe_sources(runs, options.records),
        held_out=describe_sources(held_out, options.held_out),
        seed=seed,
        versions={name: version(name) for name in _RECORDED_PACKAGES},
    )
    write_trained(options.output, training_result, provenance)
    document = make_document(
        training_result.models[training_result.recommended_kind],
        training_result.residuals,
        training_result,
    )
    if options.json not in (None, "-"):
        write_text(Path(options.json), format_json(document))
    if options.json == "-":
        print(format_json(document))
        return 0
    print(
        format_table(
            training_result.models[training_result.recommended_kind],
            training_result.residuals,
            options.wording,
        )
    )
    for remark in training_result.remarks:
        print(f"rotemina: {options.wording.format_field(remark)}", file=sys.stderr)
    print_message(
        options,
        message("cli", "recommended: {why}").fill(why=training_result.recommendation_reason),
    )
    text = message("cli", "{output}: {count} inverses")
    print_message(options, text.fill(output=options.output, count=len(training_result.models)))
    return 0


def _check_options(options: argparse.Namespace) -> None:
    if options.simulate and (options.records or options.held_out):
        raise CommandError("--simulate takes no records; leave out one or the other")
    if not options.simulate and not options.records:
        raise CommandError("no record is named; name one, or use --simulate")
    if not options.simulate and (options.effects is not None or options.seed is not None):
        raise CommandError("--effects and --seed belong to --simulate; leave them out, or add it")
    if options.simulate and options.axis is None:
        raise CommandError("--simulate needs --axis NAME")
    if options.seed is not None and options.seed < 0:
        raise CommandError("--seed {seed}: must be 0 or more", seed=options.seed)
    check_output_files(
        [options.output, find_json_file(options.json)],
        [
            *options.records,
            *options.held_out,
            find_robot_file(options.robot),
            find_robot_file(options.effects),
        ],
    )


def _read_samples(
    options: argparse.Namespace, robot: Robot
) -> tuple[list["TrainingSamples"], list["TrainingSamples"]]:
    from rotemina.sim.compensate import read_samples

    paths = [*options.records, *options.held_out]
    records = read_records_of_model(options, robot, paths)
    axis = options.axis or _require_one_axis(
        [name for name in records[0].axes if _is_piezo(robot, name)], paths[0]
    )
    samples = [
        read_samples(robot, axis, record, str(path))
        for record, path in zip(records, paths, strict=True)
    ]
    return samples[: len(options.records)], samples[len(options.records) :]


def _is_piezo(robot: Robot, name: str) -> bool:
    return isinstance(robot.axes.get(name), PiezoAxis)


def _require_one_axis(names: Sequence[str], path: Path) -> str:
    if len(names) != 1:
        piezo_names = ", ".join(names) or "none"
        raise CommandError(
            "{path}: its piezo axes are {found}; name one by --axis", path=path, found=piezo_names
        )
    return names[0]


def _simulate_samples(options: argparse.Namespace, robot: Robot, seed: int) -> "TrainingSamples":
    import numpy as np

    from rotemina.sim.compensate import make_excitation, read_samples
    from rotemina.sim.simulation import simulate

    effects = None if options.effects is None else load_robot(options.effects).effects
    rng = np.random.default_rng(seed)
    commands = make_excitation(robot, options.axis, rng)
    return read_samples(robot, options.axis, simulate(robot, effects, commands, rng), "simulation")


def _digest_file(path: Path) -> str:
    with open_file(path, InputError) as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
