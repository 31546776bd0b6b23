"""``rotemina simulate``: what a machine with its effects would record for given commands."""

import argparse
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from itertools import chain
from pathlib import Path

import numpy as np

from rotemina.app.cli.options import (
    ANOTHER_MODEL,
    add_columns,
    add_robot,
    robot_with_effects,
    tell_model,
    tell_written,
)
from rotemina.sim.errors import InputError
from rotemina.sim.messages import Field, Message, Wording, message
from rotemina.sim.plant.assembly import assemble
from rotemina.sim.plant.joint_loads import RunningLoads
from rotemina.sim.quantities import Number, fixed, rounded, scale_in
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.record_pieces import read_pieces
from rotemina.sim.records.writing import write_pieces
from rotemina.sim.robot.model import Robot
from rotemina.sim.simulation.loads_table import LoadsTable, loads_table
from rotemina.sim.simulation.simulation import Simulation, needs_whole
from rotemina.sim.trajectory.axis_limits import check_commands_of_model

_PREFIX = "simulated "  # of the metadata that say how a record came about
_SLACK = 1e-9  # share of its range by which a command may lie outside unnoticed


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "simulate",
        help="simulate the robot with its effects for the commands of a file",
        description="Drive the model, with the effects and the noise of its robot file, with the "
        "commands of a trajectory or record, and write what the machine would record:"
        " cmd, u, ref and meas. Long files need no more memory than short ones.",
    )
    parser.add_argument("commands", type=Path, metavar="COMMANDS", help="a trajectory or record")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="RECORD")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--effects", metavar="FILE", help="take the effects of this robot file instead"
    )
    chance = parser.add_mutually_exclusive_group()
    chance.add_argument(
        "--seed",
        type=int,
        default=0,
        metavar="N",
        help="seed of noise and random effects (default: 0)",
    )
    chance.add_argument(
        "--no-noise", action="store_true", help="no noise, no rounding, no random effects"
    )
    parser.add_argument(
        "--loads", type=Path, metavar="FILE", help="write accelerations and joint forces as CSV"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Simulate piece by piece, and write the record."""
    _check_files(options)
    if options.seed < 0:
        raise InputError(message("cli", "--seed {seed}: must be 0 or more").fill(seed=options.seed))
    robot = robot_with_effects(options)
    commands = _commands(options, robot)
    first = next(commands)
    rng = None if options.no_noise else np.random.default_rng(options.seed)
    simulation = Simulation(robot, None, first, rng)
    run_ = _Run(
        simulation, _Outside(robot), wording=options.wording if sys.stderr.isatty() else None
    )
    # Both files appear together or neither: a failure at one leaves the other's place alone.
    with ExitStack() as files:
        if options.loads is not None:
            units = _units(robot, first)
            table = loads_table(options.loads, simulation.plant, units)
            run_.write_loads(files.enter_context(table))
        pieces = _named(options, robot, chain([first], commands))
        write_pieces(run_.records(pieces), options.output)
    for warning in chain(_idle(robot, simulation), run_.outside.warnings()):
        print(f"rotemina: {options.commands}: {options.wording.of(warning)}", file=sys.stderr)
    tell_written(options, options.output, run_.rows, run_.duration_s)
    return 0


def _named(options: argparse.Namespace, robot: Robot, pieces: Iterator[Record]) -> Iterator[Record]:
    """Name the model once the files are open, before any progress is shown."""
    tell_model(options, robot.name)
    yield from pieces


def _idle(robot: Robot, simulation: Simulation) -> Iterator[Message]:
    """Say which effects have no part, because their axis has none."""
    for asked in robot.effects:
        if asked.enabled and asked.axis not in simulation.axes:
            yield message(
                "cli",
                "effect {effect} on axis {axis} does not act: the commands name neither this axis "
                "nor one coupled to it",
            ).fill(effect=asked.id, axis=asked.axis)


def _check_files(options: argparse.Namespace) -> None:
    sources = [options.commands]
    for output in (options.output, options.loads):
        if output is None:
            continue
        if not output.parent.is_dir():  # told before the work, not after it
            raise InputError(
                message(
                    "cli",
                    "{output} cannot be written: there is no folder {parent}; create it, or "
                    "choose another",
                ).fill(output=output, parent=output.parent)
            )
        if any(output.absolute() == source.absolute() for source in sources) or (
            output.exists() and any(s.exists() and output.samefile(s) for s in sources)
        ):
            raise InputError(
                message("cli", "{output} is named twice; give each file its own name").fill(
                    output=output
                )
            )
        sources.append(output)


def _commands(options: argparse.Namespace, robot: Robot) -> Iterator[Record]:
    """Give the commands piece by piece, or at once where the simulation must have them all."""
    pieces = read_pieces(options.commands, columns=options.columns, robot=robot)
    first = next(pieces)
    if needs_whole(robot, None, first):
        # The steady state of a periodic record, and a clock that leads, look ahead: this alone
        # takes memory that grows with the file.
        pieces.close()
        first = read_record(options.commands, columns=options.columns, robot=robot)
        pieces = iter(())
    metadata = _metadata(options, robot, first)
    rows = 0
    for piece in chain([first], pieces):
        check_commands_of_model(robot, piece, options.commands, ANOTHER_MODEL, rows + 1)
        rows += len(piece.time_s)
        yield replace(piece, metadata=metadata)


def _metadata(options: argparse.Namespace, robot: Robot, commands: Record) -> dict[str, str]:
    """Return what the record says of itself, in place of what the commands say of such things."""
    kept = {k: v for k, v in commands.metadata.items() if not k.startswith(_PREFIX)}
    if commands.history == "unknown":
        del kept["history"]  # the simulation begins at rest
    said = {
        "robot": " ".join(robot.name.split()),
        "seed": "none" if options.no_noise else str(options.seed),
    }
    acting = assemble(robot, commands.axes).effects
    for number, one in enumerate(acting, start=1):
        said[f"effect {number}"] = str(one)
    return kept | {f"{_PREFIX}{key}": value for key, value in said.items()}


def _units(robot: Robot, commands: Record) -> dict[str, str]:
    """Return the unit of each axis' position, as far as robot or commands tell."""
    stated = {name: robot.unit(name) for name in robot.axes}
    return {name: unit for name, unit in stated.items() if unit is not None} | dict(commands.units)


class _Run:
    """A simulation from file to file; progress is printed in ``wording``, if any."""

    def __init__(
        self, simulation: Simulation, outside: "_Outside", *, wording: Wording | None
    ) -> None:
        self._simulation = simulation
        self._wording = wording
        self._loads: tuple[RunningLoads, LoadsTable] | None = None
        self._since_s: float | None = None
        self.outside = outside
        self.rows = 0
        self.duration_s = 0.0

    def write_loads(self, table: LoadsTable) -> None:
        """Let the loads go to a table as well."""
        self._loads = RunningLoads(self._simulation.plant), table

    def records(self, commands: Iterator[Record]) -> Iterator[Record]:
        """Give the record of each piece of the commands."""
        for piece in commands:
            self.outside.look_at(piece, self.rows)
            response = self._simulation.respond(piece)
            if self._loads is not None:
                running, table = self._loads
                table.add(running.follow(piece.time_s, response.motion))
            self._count(piece)
            yield response.record
        if self._loads is not None:
            running, table = self._loads
            table.add(running.last())
        if self._wording:
            print(file=sys.stderr)

    def _count(self, piece: Record) -> None:
        self._since_s = piece.time_s[0] if self._since_s is None else self._since_s
        self.rows += len(piece.time_s)
        self.duration_s = float(piece.time_s[-1] - self._since_s)
        if self._wording:
            said = message("cli", "simulated {seconds} s").fill(seconds=fixed(self.duration_s, 1))
            print(f"\r{self._wording.of(said)}", end="", file=sys.stderr, flush=True)


class _Outside:
    """Commands outside the range of their axis: they are simulated, and said."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._first: dict[str, dict[str, Field]] = {}
        self._rows: dict[str, int] = {}

    def look_at(self, piece: Record, before: int) -> None:
        """Look at the next rows, which come after ``before`` others."""
        for name in piece.axes:
            axis, command = self._robot.axes[name], piece.signal(name, Tap.CMD)
            slack = _SLACK * axis.span
            beyond = (command < axis.range[0] - slack) | (command > axis.range[1] + slack)
            if not beyond.any():
                continue
            row = int(np.argmax(beyond))
            low, high = axis.range
            unit = self._robot.unit(name) or ""
            self._first.setdefault(
                name,
                {
                    "value": rounded(command[row], 9),
                    "row": before + row + 1,
                    "time": scale_in("s", digits=9).text(piece.time_s[row]),
                    "low": rounded(low, 6),
                    "high": Number(f"{rounded(high, 6)} {unit}".rstrip()),
                },
            )
            self._rows[name] = self._rows.get(name, 0) + int(beyond.sum())

    def warnings(self) -> list[Message]:
        """Return a line for each axis that was commanded outside."""
        warning = message(
            "cli",
            "{axis}.cmd = {value} at row {row} (t = {time}) is outside {low} … {high}; {rows} such "
            "rows",
        )
        return [
            warning.fill(axis=name, **first, rows=self._rows[name])
            for name, first in self._first.items()
        ]
