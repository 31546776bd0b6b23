"""A naive contestant: the nearest known residuals by numerical descriptors."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Self

import numpy as np

from rotemina.app.blind.cases import BlindError
from rotemina.app.blind.features import features
from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.case import draw_case
from rotemina.sim.blind.files import kinds, write_case
from rotemina.sim.input_files import open_file
from rotemina.sim.records.reading import read_record
from rotemina.sim.robot.model import Robot
from rotemina.sim.whole_files import replaced

_MOST_BYTES = 64_000_000
_NEIGHBOURS = 5
_OTHER_SEED = 987_654  # that no test is run with
_CASES = 240


@dataclass(frozen=True, slots=True)
class Classifier:
    """Known residuals: ``known`` (n, f) standardised features, and what each one was."""

    middle: FloatArray
    spread: FloatArray
    known: FloatArray
    names: tuple[str, ...]

    @classmethod
    def of(cls, rows: FloatArray, names: Sequence[str]) -> Self:
        """Make a classifier of features (n, f) and what each row was."""
        middle, spread = rows.mean(axis=0), rows.std(axis=0) + 1e-9
        return cls(middle, spread, (rows - middle) / spread, tuple(names))

    def classify(self, residual: FloatArray) -> tuple[str, float]:
        """Return what most of the nearest known residuals were, and their share of the votes."""
        distance = np.linalg.norm(self.known - (residual - self.middle) / self.spread, axis=1)
        votes: dict[str, float] = {}
        for index in np.argsort(distance, kind="stable")[:_NEIGHBOURS]:
            name = self.names[index]
            votes[name] = votes.get(name, 0.0) + 1.0 / (float(distance[index]) + 1e-9)
        name = max(votes, key=lambda one: votes[one])
        return name, votes[name] / sum(votes.values())


def classifier_for(robot: Robot, file: Path, number: int = _CASES) -> Classifier:
    """Return the classifier that a file holds; without one, it learns first and writes it."""
    if file.exists():
        return _read(file)
    rows, names = learned(robot, number)
    with replaced(file) as written:
        np.savez(written, rows=rows, names=np.array(names))
    return Classifier.of(rows, names)


def _read(file: Path) -> Classifier:
    with open_file(file, BlindError, most_bytes=_MOST_BYTES, advice="remove it") as opened:
        try:
            with np.load(opened, allow_pickle=False) as kept:
                rows, names = np.asarray(kept["rows"], np.float64), list(map(str, kept["names"]))
        except Exception as cause:  # numpy, zipfile and zlib have many
            raise BlindError(f"{file}: it is no classifier ({cause}); remove it") from cause
    if rows.ndim != 2 or len(rows) != len(names) or not np.isfinite(rows).all():
        raise BlindError(f"{file}: it is no classifier; remove it")
    return Classifier.of(rows, names)


def learned(robot: Robot, number: int) -> tuple[FloatArray, list[str]]:
    """Return features (n, f) and names of the residuals of cases that no test holds."""
    rows: list[FloatArray] = []
    names: list[str] = []
    for kind, effect, case_seed in kinds(number, _OTHER_SEED):
        if kind in ("single", "parameter", "healthy", "unknown", "poor"):
            case = draw_case(robot, kind, case_seed, effect)
            label = case.label()
            with TemporaryDirectory() as folder:
                write_case(Path(folder), case, robot)
                records = [read_record(p, robot=robot) for p in sorted(Path(folder).glob("train*"))]
            for axis, name in _told(label, case.names):
                rows.append(features(robot, records, axis))
                names.append(name)
    return np.array(rows), names


def _told(label: Mapping[str, Any], axes: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield the axis that a label speaks of, and what is there; of a healthy machine the first."""
    effects = label["effects"] or label["hidden"]
    if not effects:
        yield axes[0], "none"
    for effect in effects:
        explained = label["verdict"] == "explained"
        yield effect["axis"], effect["effect"] if explained else label["verdict"]
