"""Records of a simulated machine: what a real one with these effects would have recorded."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.assembly import assemble
from rotemina.sim.plant.perturbation import Perturbation
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.plant.response import check_axes, run_of
from rotemina.sim.plant.run import Run
from rotemina.sim.plant.run_start import steady_start
from rotemina.sim.plant.state import Motion, PlantState
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.record_pieces import PIECE_ROWS, join_records
from rotemina.sim.robot.model import AxisEffect, Robot, StepperAxis


def simulate(
    robot: Robot,
    effects: Sequence[AxisEffect] | None,
    commands: Record,
    rng: np.random.Generator | None = None,
    *,
    perturbation: Perturbation | None = None,
) -> Record:
    """Return what a machine with such effects records when it is driven by ``commands``.

    Parameters
    ----------
    robot : Robot
    effects : sequence of AxisEffect, optional
        In place of those that the robot's file gives it; None leaves these, () takes all away.
    commands : Record
        Its ``cmd`` (and ``add``; ``u`` of axes that a force moves) drive the machine, under its
        controllers if its mode is ``closed_loop``. What else it holds is left aside.
    rng : Generator, optional
        Noise and random effects come from it. Without, there are none and nothing is rounded.
    perturbation : Perturbation, optional
        Q of Eq. (1), a row for each of the record and a column for each axis that is simulated:
        those of the record and those joined to them, in the robot's order.

    Returns
    -------
    Record
        ``cmd``, ``u`` (not of steppers), ``ref`` and ``meas`` of the axes of ``commands``.

    Raises
    ------
    EffectError
        If an effect cannot be used, with axis, effect, parameter, value and bound.
    PlantError
        If the commands do not fit the robot, or the response diverges, with the time.
    """
    simulation = Simulation(robot, effects, commands, rng)
    return simulation.follow(commands, perturbation=perturbation)


def needs_whole(robot: Robot, effects: Sequence[AxisEffect] | None, commands: Record) -> bool:
    """Return whether a simulation must have all commands at once, of which some are ``commands``.

    A periodic record must, because its start is the steady state of a whole period, and a machine
    some of whose clocks lead, because their readings are of what comes later.
    """
    leads = any(rate < 0.0 for rate in assemble(_with(robot, effects)).skews.values())
    return leads or commands.history == "periodic"


class Response(NamedTuple):
    """A record, and the motion of all axes that were simulated for it."""

    record: Record
    motion: Motion


class Simulation:
    """A simulated machine that is driven piece by piece, in bounded memory.

    It starts at rest at the first command of ``commands``, or in the steady state of a periodic
    one. Parameters and errors as of :func:`simulate`. Long commands are followed in pieces of
    ``PIECE_ROWS`` rows, so that a run that comes in such pieces is the same to the last bit.
    """

    def __init__(
        self,
        robot: Robot,
        effects: Sequence[AxisEffect] | None,
        commands: Record,
        rng: np.random.Generator | None = None,
    ) -> None:
        robot = _with(robot, effects)
        check_axes(robot, commands)
        self._plant = Plant.of(robot, closed_loop=commands.closed_loop, only=commands.axes)
        self._chance = Chance(rng) if rng is not None else None
        # A stream for each axis, so that pieces draw from it what the whole would.
        self._reference = rng.spawn(len(commands.axes)) if rng is not None else []
        run = run_of(self._plant, commands)
        self._state = self._start(commands, run)

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes that are simulated, in the robot's order."""
        return self._plant.axes

    @property
    def plant(self) -> Plant:
        """What is simulated."""
        return self._plant

    def follow(self, commands: Record, *, perturbation: Perturbation | None = None) -> Record:
        """Return the record of the next commands, whose times go on where the last ones ended."""
        return self.respond(commands, perturbation=perturbation).record

    def respond(self, commands: Record, *, perturbation: Perturbation | None = None) -> Response:
        """Return the record of the next commands, and the motion behind it."""
        leads = any(rate < 0.0 for rate in self._plant.assembly.skews.values())
        if leads or len(commands.time_s) <= PIECE_ROWS:
            return self._advance(commands, perturbation)
        if perturbation is not None:
            perturbation.check(len(commands.time_s), self._plant.axes)
        responses = []
        for first in range(0, len(commands.time_s), PIECE_ROWS):
            rows = slice(first, first + PIECE_ROWS)
            shaken = perturbation.part(rows) if perturbation is not None else None
            responses.append(self._advance(commands.part(rows), shaken))
        return Response(
            join_records([one.record for one in responses]),
            Motion(*map(np.concatenate, zip(*(one.motion for one in responses), strict=True))),
        )

    def _advance(self, commands: Record, perturbation: Perturbation | None) -> Response:
        run = run_of(self._plant, commands)
        motion, self._state = self._plant.advance(
            self._state,
            run.time_s,
            run.command,
            add=run.add,
            inputs=run.inputs,
            perturbation=perturbation,
            chance=self._chance,
        )
        return Response(self._record(commands, motion), motion)

    def _start(self, commands: Record, run: Run) -> PlantState:
        if commands.history == "periodic":
            return steady_start(self._plant, run, commands.period_samples)
        return self._plant.at_rest(run.time_s[0], run.command[0])

    def _record(self, commands: Record, motion: Motion) -> Record:
        signals: dict[tuple[str, Tap], FloatArray] = {}
        for number, name in enumerate(commands.axes):
            column = self._plant.axes.index(name)
            signals[name, Tap.CMD] = commands.signal(name, Tap.CMD)
            if commands.has(name, Tap.ADD):
                signals[name, Tap.ADD] = commands.signal(name, Tap.ADD)
            if not isinstance(self._plant.robot.axes[name], StepperAxis):
                signals[name, Tap.U] = motion.inputs[:, column]
            seen = motion.position[:, column]
            noise = self._reference_noise(number, commands.units[name], len(seen))
            signals[name, Tap.REF] = seen + noise
            signals[name, Tap.MEAS] = motion.reading[:, column]
        return Record.from_signals(commands.time_s, signals, commands.units, commands.metadata)

    def _reference_noise(self, number: int, unit: str, rows: int) -> FloatArray | float:
        """Return the noise (rows,) of the reference on an axis of the record."""
        rms = self._plant.robot.reference.noise_rms.of(unit)
        if not self._reference or rms is None:
            return 0.0
        return np.asarray(rms * self._reference[number].standard_normal(rows))


def _with(robot: Robot, effects: Sequence[AxisEffect] | None) -> Robot:
    return robot if effects is None else replace(robot, effects=tuple(effects))
