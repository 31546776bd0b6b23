"""Training of inverses for the panel, on records or the simulated axis; free of widgets."""

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import version

import numpy as np

from rotemina.plugins.compensation import mark
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.excitation import excitation
from rotemina.sim.compensate.file import Provenance, Source
from rotemina.sim.compensate.inverse import Inverse
from rotemina.sim.compensate.inverse_parameters import Kind
from rotemina.sim.compensate.samples import Samples, samples_of
from rotemina.sim.compensate.training import Trained, train
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import AxisEffect, Robot
from rotemina.sim.simulation.simulation import simulate

_PROGRAMS = ("rotemina", "numpy", "scipy", "numba")
_DRAWN = 4000  # points of a loop
_JUDGED = 0.25  # of the rows, the last ones

Listener = Callable[[str, float], None]


@dataclass(frozen=True, slots=True, eq=False)
class Loop:
    """Commands and resulting positions, (n,) SI, and the inverse's commands for these."""

    command: FloatArray
    position: FloatArray
    inverted: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Learned:
    """Inverses of one axis, where they come from, and the loop of unseen rows by kind."""

    trained: Trained
    provenance: Provenance
    loops: dict[Kind, Loop]

    @property
    def axis(self) -> str:
        """Whose inverses they are."""
        return self.trained.models[self.trained.chosen].axis


def learned_from(
    robot: Robot, axis: str, records: Sequence[tuple[str, Record]], listener: Listener
) -> Learned:
    """Learn from records; the last quarter of each judges.

    Raises
    ------
    CompensationError
        If they hold too little, or nothing converges.
    """
    runs = [samples_of(robot, axis, record, name) for name, record in records]
    sources = [
        Source(name=name, sha256=_digest(record), rows=len(record.time_s))
        for name, record in records
    ]
    return _learned(robot, runs, sources, None, listener)


def learned_simulated(
    robot: Robot, effects: Sequence[AxisEffect], axis: str, seed: int, listener: Listener
) -> Learned:
    """Learn from the simulated axis, moved over its range with these effects.

    Raises
    ------
    CompensationError, EffectError
        As :func:`learned_from`, or if an effect cannot be used.
    """
    listener(mark("moving the simulated axis"), 0.0)
    rng = np.random.default_rng(seed)
    record = simulate(robot, effects, excitation(robot, axis, rng), rng)
    run = samples_of(robot, axis, record, "simulation")
    return _learned(robot, [run], [], seed, listener)


def _learned(
    robot: Robot, runs: list[Samples], sources: list[Source], seed: int | None, listener: Listener
) -> Learned:
    trained = train(robot, runs, listener=listener)
    provenance = Provenance(
        robot=robot.name,
        trained_on=sources,
        held_out=[],
        seed=seed,
        versions={program: version(program) for program in _PROGRAMS},
    )
    loops = {kind: _loop(trained, kind, runs[0]) for kind in trained.models}
    return Learned(trained, provenance, loops)


def _loop(trained: Trained, kind: Kind, run: Samples) -> Loop:
    model = trained.models[kind]
    inverted = Inverse(model, run.sample_s, preview=True).run(run.position)
    first = max(run.first, round((1.0 - _JUDGED) * len(run.command)))
    rows = np.linspace(first, len(run.command) - 1, _DRAWN).astype(int)
    return Loop(run.command[rows], run.position[rows], inverted[rows])


def _digest(record: Record) -> str:
    """Return the SHA-256 of a record's numbers; it may come from no file."""
    digest = hashlib.sha256(np.ascontiguousarray(record.time_s).tobytes())
    digest.update(np.ascontiguousarray(record.values).tobytes())
    return digest.hexdigest()
