"""Training of inverse models from records or from the simulated axis, without widgets."""

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import version

import numpy as np

from rotemina.plugins.compensation import mark
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate import (
    Inverse,
    InverseKind,
    InverseProvenance,
    InverseSource,
    TrainingResult,
    TrainingSamples,
    make_excitation,
    read_samples,
    train,
)
from rotemina.sim.records import Record
from rotemina.sim.robot import AxisEffect, Robot
from rotemina.sim.simulation import simulate

_VERSIONED_PACKAGES = ("rotemina", "numpy", "scipy", "numba")

_DRAWN_LOOP_POINT_COUNT = 4000

# This fraction of each record, at its end, is the validation data.
_VALIDATION_FRACTION = 0.25

ProgressListener = Callable[[str, float], None]


@dataclass(frozen=True, slots=True, eq=False)
class ValidationLoop:
    """Hysteresis loop of the validation data, each (n,) in SI units.

    ``inverted`` is the command that the inverse computes for the measured ``position``.
    """

    command: FloatArray
    position: FloatArray
    inverted: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class TrainedInverses:
    """Inverses of one axis, their provenance, and the validation loop of each kind."""

    trained: TrainingResult
    provenance: InverseProvenance
    loops: dict[InverseKind, ValidationLoop]

    @property
    def axis(self) -> str:
        """Axis of the inverses."""
        return self.trained.models[self.trained.recommended_kind].axis


def train_from_records(
    robot: Robot, axis: str, records: Sequence[tuple[str, Record]], listener: ProgressListener
) -> TrainedInverses:
    """Train inverses with records. The last quarter of each record is validation data.

    Raises
    ------
    CompensationError
        If the records have too little data, or no inverse converges.
    """
    runs = [read_samples(robot, axis, record, name) for name, record in records]
    sources = [
        InverseSource(name=name, sha256=_compute_digest(record), rows=len(record.time_s))
        for name, record in records
    ]
    return _train_inverses(robot, runs, sources, None, listener)


def train_in_simulation(
    robot: Robot, effects: Sequence[AxisEffect], axis: str, seed: int, listener: ProgressListener
) -> TrainedInverses:
    """Simulate a motion over the range of the axis with these effects, and train inverses with it.

    Raises
    ------
    CompensationError, EffectError
        For the reasons given in :func:`train_from_records`, or if an effect cannot be used.
    """
    listener(mark("moving the simulated axis"), 0.0)
    rng = np.random.default_rng(seed)
    record = simulate(robot, effects, make_excitation(robot, axis, rng), rng)
    run = read_samples(robot, axis, record, "simulation")
    return _train_inverses(robot, [run], [], seed, listener)


def _train_inverses(
    robot: Robot,
    runs: list[TrainingSamples],
    sources: list[InverseSource],
    seed: int | None,
    listener: ProgressListener,
) -> TrainedInverses:
    trained = train(robot, runs, listener=listener)
    provenance = InverseProvenance(
        robot=robot.name,
        trained_on=sources,
        held_out=[],
        seed=seed,
        versions={program: version(program) for program in _VERSIONED_PACKAGES},
    )
    loops = {kind: _make_validation_loop(trained, kind, runs[0]) for kind in trained.models}
    return TrainedInverses(trained, provenance, loops)


def _make_validation_loop(
    trained: TrainingResult, kind: InverseKind, run: TrainingSamples
) -> ValidationLoop:
    model = trained.models[kind]
    inverted = Inverse(model, run.sample_s, preview=True).run(run.position)
    first_row = max(run.first, round((1.0 - _VALIDATION_FRACTION) * len(run.command)))
    rows = np.linspace(first_row, len(run.command) - 1, _DRAWN_LOOP_POINT_COUNT).astype(int)
    return ValidationLoop(run.command[rows], run.position[rows], inverted[rows])


def _compute_digest(record: Record) -> str:
    """Return the SHA-256 of the numbers of a record, because not every record has a file."""
    digest = hashlib.sha256(np.ascontiguousarray(record.time_s).tobytes())
    digest.update(np.ascontiguousarray(record.values).tobytes())
    return digest.hexdigest()
