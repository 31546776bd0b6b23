"""Records of a simulated machine, as a real machine with the same effects would write them."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.plant import (
    Perturbation,
    Plant,
    PlantMotion,
    PlantState,
    RandomStreams,
    RunCommands,
    assemble,
    check_axes,
    find_steady_start,
    make_run,
)
from rotemina.sim.records import PIECE_ROWS, Record, Tap, join_records
from rotemina.sim.robot import (
    AxisEffect,
    Robot,
    StepperAxis,
)


def simulate(
    robot: Robot,
    effects: Sequence[AxisEffect] | None,
    commands: Record,
    rng: np.random.Generator | None = None,
    *,
    perturbation: Perturbation | None = None,
) -> Record:
    """Return the record of a machine with these effects, driven by ``commands``.

    Parameters
    ----------
    robot : Robot
    effects : sequence of AxisEffect, optional
        Effects instead of those in the robot file. None keeps those of the file, () removes all.
    commands : Record
        Its ``cmd`` (and ``add``; ``u`` of axes that a force moves) drive the machine, under its
        controllers if its mode is ``closed_loop``. Its other signals are ignored.
    rng : Generator, optional
        Source of noise and random effects. Without it, there is no noise and nothing is rounded.
    perturbation : Perturbation, optional
        Q of Eq. (1), with a row for each row of the record and a column for each simulated axis:
        those of the record and those joined to them, in the robot's order.

    Returns
    -------
    Record
        ``cmd``, ``u`` (not of steppers), ``ref`` and ``meas`` of the axes of ``commands``.

    Raises
    ------
    EffectError
        If an effect cannot be used. The message gives axis, effect, parameter, value and bound.
    PlantError
        If the commands do not fit the robot, or the response diverges; the message gives the time.
    """
    simulation = SimulatedMachine(robot, effects, commands, rng)
    return simulation.follow(commands, perturbation=perturbation)


def needs_all_commands(
    robot: Robot, effects: Sequence[AxisEffect] | None, commands: Record
) -> bool:
    """Return whether a simulation needs all commands at once, judging by a part of them.

    A periodic record does, because it starts in the steady state of a whole period. So does a
    machine with a leading clock, because its readings show later motion.
    """
    has_leading_clock = any(
        rate < 0.0 for rate in assemble(_with_effects(robot, effects)).skews.values()
    )
    return has_leading_clock or commands.history == "periodic"


class SimulatedResponse(NamedTuple):
    """Record, and the motion of all axes that were simulated for it."""

    record: Record
    motion: PlantMotion


class SimulatedMachine:
    """Simulated machine that is driven piece by piece, in bounded memory.

    It starts at rest at the first command of ``commands``, or in the steady state of a periodic
    record. Parameters and errors are as in :func:`simulate`. Long commands are simulated in pieces
    of ``PIECE_ROWS`` rows, so a run that arrives in such pieces gives the same result to the
    last bit.
    """

    def __init__(
        self,
        robot: Robot,
        effects: Sequence[AxisEffect] | None,
        commands: Record,
        rng: np.random.Generator | None = None,
    ) -> None:
        robot = _with_effects(robot, effects)
        check_axes(robot, commands)
        self._plant = Plant.of(robot, closed_loop=commands.closed_loop, only=commands.axes)
        self._random_streams = RandomStreams(rng) if rng is not None else None
        # A separate stream for each axis, so that pieces draw the same noise as a whole run.
        self._reference_rngs = rng.spawn(len(commands.axes)) if rng is not None else []
        run = make_run(self._plant, commands)
        self._state = self._find_start(commands, run)

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes that are simulated, in the robot's order."""
        return self._plant.axes

    @property
    def plant(self) -> Plant:
        """The simulated plant."""
        return self._plant

    def follow(self, commands: Record, *, perturbation: Perturbation | None = None) -> Record:
        """Return the record of the next commands, whose times continue those of the last ones."""
        return self.respond(commands, perturbation=perturbation).record

    def respond(
        self, commands: Record, *, perturbation: Perturbation | None = None
    ) -> SimulatedResponse:
        """Return the record of the next commands, and the underlying motion."""
        has_leading_clock = any(rate < 0.0 for rate in self._plant.assembly.skews.values())
        # A leading clock reads later motion, which a piece would not contain.
        if has_leading_clock or len(commands.time_s) <= PIECE_ROWS:
            return self._advance(commands, perturbation)
        if perturbation is not None:
            perturbation.check(len(commands.time_s), self._plant.axes)
        responses = []
        for first_row in range(0, len(commands.time_s), PIECE_ROWS):
            rows = slice(first_row, first_row + PIECE_ROWS)
            piece_perturbation = perturbation.part(rows) if perturbation is not None else None
            responses.append(self._advance(commands.select_rows(rows), piece_perturbation))
        return SimulatedResponse(
            join_records([response.record for response in responses]),
            PlantMotion(
                *map(np.concatenate, zip(*(response.motion for response in responses), strict=True))
            ),
        )

    def _advance(self, commands: Record, perturbation: Perturbation | None) -> SimulatedResponse:
        run = make_run(self._plant, commands)
        motion, self._state = self._plant.advance(
            self._state,
            run.time_s,
            run.command,
            add=run.add,
            inputs=run.inputs,
            perturbation=perturbation,
            random_streams=self._random_streams,
        )
        return SimulatedResponse(self._make_record(commands, motion), motion)

    def _find_start(self, commands: Record, run: RunCommands) -> PlantState:
        if commands.history == "periodic":
            return find_steady_start(self._plant, run, commands.period_samples)
        return self._plant.find_rest_state(run.time_s[0], run.command[0])

    def _make_record(self, commands: Record, motion: PlantMotion) -> Record:
        signals: dict[tuple[str, Tap], FloatArray] = {}
        for number, name in enumerate(commands.axes):
            column = self._plant.axes.index(name)
            signals[name, Tap.CMD] = commands.signal(name, Tap.CMD)
            if commands.has(name, Tap.ADD):
                signals[name, Tap.ADD] = commands.signal(name, Tap.ADD)
            if not isinstance(self._plant.robot.axes[name], StepperAxis):
                signals[name, Tap.U] = motion.inputs[:, column]
            position = motion.position[:, column]
            noise = self._draw_reference_noise(number, commands.units[name], len(position))
            signals[name, Tap.REF] = position + noise
            signals[name, Tap.MEAS] = motion.reading[:, column]
        return Record.from_signals(commands.time_s, signals, commands.units, commands.metadata)

    def _draw_reference_noise(self, number: int, unit: str, rows: int) -> FloatArray | float:
        rms = self._plant.robot.reference.noise_rms.of(unit)
        if not self._reference_rngs or rms is None:
            return 0.0
        return np.asarray(rms * self._reference_rngs[number].standard_normal(rows))


def _with_effects(robot: Robot, effects: Sequence[AxisEffect] | None) -> Robot:
    return robot if effects is None else replace(robot, effects=tuple(effects))


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Response="SimulatedResponse",
        Simulation="SimulatedMachine",
        needs_whole="needs_all_commands",
    )
