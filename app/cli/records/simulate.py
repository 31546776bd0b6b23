"""``rotemina simulate``: simulate the record of a machine with its effects for given commands."""

import argparse
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from itertools import chain
from pathlib import Path

import numpy as np

from rotemina.app.cli.terminal import (
    CHOOSE_MODEL_ADVICE,
    add_columns,
    add_robot,
    check_output_files,
    find_robot_file,
    load_robot_with_effects,
    print_model,
    print_written_file,
)
from rotemina.app.errors import CommandError
from rotemina.sim.messages import (
    Field,
    Message,
    MessageWording,
    NumberText,
    format_fixed,
    format_rounded,
    message,
)
from rotemina.sim.plant import RunningLoads, assemble
from rotemina.sim.records import Record, Tap, read_pieces, read_record, write_pieces
from rotemina.sim.robot import Robot
from rotemina.sim.simulation import (
    LoadsTable,
    SimulatedMachine,
    needs_all_commands,
    open_loads_table,
)
from rotemina.sim.trajectory import check_commands_fit_model
from rotemina.sim.units import make_scale

# Prefix of the metadata keys that describe how a record was simulated.
_METADATA_PREFIX = "simulated "
# Because of rounding, a command may exceed the range by this share without a warning.
_RANGE_SLACK_RATIO = 1e-9


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "simulate",
        help="simulate the robot with its effects for the commands of a file",
        description="Drive the model, with the effects and the noise of its robot file, with the "
        "commands of a trajectory or record, and write what the machine would record:"
        " cmd, u, ref and meas. Memory use does not grow with the length of the file.",
    )
    parser.add_argument("commands", type=Path, metavar="COMMANDS", help="a trajectory or record")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="RECORD")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--effects",
        metavar="FILE",
        help="use the effects of this robot file instead of those of --robot",
    )
    noise_options = parser.add_mutually_exclusive_group()
    noise_options.add_argument(
        "--seed",
        type=int,
        default=0,
        metavar="N",
        help="seed of noise and random effects (default: 0)",
    )
    noise_options.add_argument(
        "--no-noise", action="store_true", help="no noise, no rounding, no random effects"
    )
    parser.add_argument(
        "--loads", type=Path, metavar="FILE", help="write accelerations and joint forces as CSV"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Simulate piece by piece, and write the record."""
    check_output_files(
        [options.output, options.loads],
        [options.commands, find_robot_file(options.robot), find_robot_file(options.effects)],
    )
    if options.seed < 0:
        raise CommandError("--seed {seed}: must be 0 or more", seed=options.seed)
    robot = load_robot_with_effects(options)
    commands = _read_commands(options, robot)
    first_piece = next(commands)
    rng = None if options.no_noise else np.random.default_rng(options.seed)
    simulation = SimulatedMachine(robot, None, first_piece, rng)
    simulation_run = _SimulationRun(
        simulation, _RangeCheck(robot), wording=options.wording if sys.stderr.isatty() else None
    )
    # Both files are replaced together or not at all, even if writing one of them fails.
    with ExitStack() as files:
        if options.loads is not None:
            units = _find_axis_units(robot, first_piece)
            table = open_loads_table(options.loads, simulation.plant, units)
            simulation_run.write_loads(files.enter_context(table))
        pieces = _print_model_first(options, robot, chain([first_piece], commands))
        write_pieces(simulation_run.records(pieces), options.output)
    for warning in chain(
        _find_idle_effects(robot, simulation), simulation_run.range_check.make_warnings()
    ):
        print(
            f"rotemina: {options.commands}: {options.wording.format_message(warning)}",
            file=sys.stderr,
        )
    print_written_file(options, options.output, simulation_run.rows, simulation_run.duration_s)
    return 0


def _print_model_first(
    options: argparse.Namespace, robot: Robot, pieces: Iterator[Record]
) -> Iterator[Record]:
    """Print the model after the files are opened and before any progress is shown."""
    print_model(options, robot.name)
    yield from pieces


def _find_idle_effects(robot: Robot, simulation: SimulatedMachine) -> Iterator[Message]:
    """Yield a warning for each enabled effect whose axis is not simulated."""
    for effect in robot.effects:
        if effect.enabled and effect.axis not in simulation.axes:
            yield message(
                "cli",
                "effect {effect} on axis {axis} does not act: the commands name neither this axis "
                "nor one coupled to it",
            ).fill(effect=effect.id, axis=effect.axis)


def _read_commands(options: argparse.Namespace, robot: Robot) -> Iterator[Record]:
    pieces = read_pieces(options.commands, columns=options.columns, robot=robot)
    first_piece = next(pieces)
    if needs_all_commands(robot, None, first_piece):
        # The steady state of a periodic record needs later commands, and so does an effect whose
        # clock runs ahead. Only in these cases does the memory use grow with the file.
        pieces.close()
        first_piece = read_record(options.commands, columns=options.columns, robot=robot)
        pieces = iter(())
    metadata = _make_metadata(options, robot, first_piece)
    rows = 0
    for piece in chain([first_piece], pieces):
        check_commands_fit_model(robot, piece, options.commands, CHOOSE_MODEL_ADVICE, rows + 1)
        rows += len(piece.time_s)
        yield replace(piece, metadata=metadata)


def _make_metadata(options: argparse.Namespace, robot: Robot, commands: Record) -> dict[str, str]:
    """Return the metadata of the record, without those of an earlier simulation."""
    metadata = {
        key: value
        for key, value in commands.metadata.items()
        if not key.startswith(_METADATA_PREFIX)
    }
    if commands.history == "unknown":
        # The simulation begins at rest, so the history is known.
        del metadata["history"]
    simulation_metadata = {
        "robot": " ".join(robot.name.split()),
        "seed": "none" if options.no_noise else str(options.seed),
    }
    effects = assemble(robot, commands.axes).effects
    for number, effect in enumerate(effects, start=1):
        simulation_metadata[f"effect {number}"] = str(effect)
    return metadata | {
        f"{_METADATA_PREFIX}{key}": value for key, value in simulation_metadata.items()
    }


def _find_axis_units(robot: Robot, commands: Record) -> dict[str, str]:
    units = {name: robot.unit(name) for name in robot.axes}
    return {name: unit for name, unit in units.items() if unit is not None} | dict(commands.units)


class _SimulationRun:
    """A simulation from file to file; it prints its progress if ``wording`` is given."""

    def __init__(
        self,
        simulation: SimulatedMachine,
        range_check: "_RangeCheck",
        *,
        wording: MessageWording | None,
    ) -> None:
        self._simulation = simulation
        self._wording = wording
        self._loads_output: tuple[RunningLoads, LoadsTable] | None = None
        self._start_s: float | None = None
        self.range_check = range_check
        self.rows = 0
        self.duration_s = 0.0

    def write_loads(self, table: LoadsTable) -> None:
        """Write the loads to a table as well."""
        self._loads_output = RunningLoads(self._simulation.plant), table

    def records(self, commands: Iterator[Record]) -> Iterator[Record]:
        """Yield the record of each piece of the commands."""
        for piece in commands:
            self.range_check.check_piece(piece, self.rows)
            response = self._simulation.respond(piece)
            if self._loads_output is not None:
                running, table = self._loads_output
                table.add(running.follow(piece.time_s, response.motion))
            self._count_rows(piece)
            yield response.record
        if self._loads_output is not None:
            running, table = self._loads_output
            table.add(running.compute_last())
        if self._wording:
            print(file=sys.stderr)

    def _count_rows(self, piece: Record) -> None:
        self._start_s = piece.time_s[0] if self._start_s is None else self._start_s
        self.rows += len(piece.time_s)
        self.duration_s = float(piece.time_s[-1] - self._start_s)
        if self._wording:
            text = message("cli", "simulated {seconds} s").fill(
                seconds=format_fixed(self.duration_s, 1)
            )
            print(f"\r{self._wording.format_message(text)}", end="", file=sys.stderr, flush=True)


class _RangeCheck:
    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._first_violations: dict[str, dict[str, Field]] = {}
        self._row_counts: dict[str, int] = {}

    def check_piece(self, piece: Record, rows_before: int) -> None:
        """Check the next rows, which follow ``rows_before`` earlier ones."""
        for name in piece.axes:
            axis, command = self._robot.axes[name], piece.signal(name, Tap.CMD)
            slack = _RANGE_SLACK_RATIO * axis.span
            is_outside = (command < axis.range[0] - slack) | (command > axis.range[1] + slack)
            if not is_outside.any():
                continue
            row = int(np.argmax(is_outside))
            low, high = axis.range
            unit = self._robot.unit(name) or ""
            self._first_violations.setdefault(
                name,
                {
                    "value": format_rounded(command[row], 9),
                    "row": rows_before + row + 1,
                    "time": make_scale("s", digits=9).format_with_unit(piece.time_s[row]),
                    "low": format_rounded(low, 6),
                    "high": NumberText(f"{format_rounded(high, 6)} {unit}".rstrip()),
                },
            )
            self._row_counts[name] = self._row_counts.get(name, 0) + int(is_outside.sum())

    def make_warnings(self) -> list[Message]:
        """Return a warning for each axis with commands outside its range."""
        warning = message(
            "cli",
            "{axis}.cmd = {value} at row {row} (t = {time}) is outside {low} … {high}; {rows} such "
            "rows",
        )
        return [
            warning.fill(axis=name, **violation, rows=self._row_counts[name])
            for name, violation in self._first_violations.items()
        ]
