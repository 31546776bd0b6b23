"""A naive method for comparison: nearest neighbours among the features of known residuals."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Self

import numpy as np

from rotemina.app.blind.features import compute_features
from rotemina.app.errors import BlindError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import draw_case, draw_kinds, write_case
from rotemina.sim.files import open_file, replace_file
from rotemina.sim.records import read_record
from rotemina.sim.robot import Robot

_MAX_FILE_BYTES = 64_000_000
_NEIGHBOUR_COUNT = 5
# No test uses this seed, so the training cases differ from all test cases.
_TRAINING_SEED = 987_654
_TRAINING_CASES = 240


@dataclass(frozen=True, slots=True)
class ResidualClassifier:
    """Nearest-neighbour classifier of residuals.

    ``known_features`` (n, f) are standardised with ``mean`` and ``spread`` (f,). ``names`` are the
    causes of the n known residuals.
    """

    mean: FloatArray
    spread: FloatArray
    known_features: FloatArray
    names: tuple[str, ...]

    @classmethod
    def from_features(cls, rows: FloatArray, names: Sequence[str]) -> Self:
        """Make a classifier from features (n, f) and the cause of each row."""
        mean, spread = rows.mean(axis=0), rows.std(axis=0) + 1e-9
        return cls(mean, spread, (rows - mean) / spread, tuple(names))

    def classify(self, features: FloatArray) -> tuple[str, float]:
        """Return the cause with the most votes of the nearest neighbours, and its vote share."""
        distances = np.linalg.norm(
            self.known_features - (features - self.mean) / self.spread, axis=1
        )
        votes: dict[str, float] = {}
        for index in np.argsort(distances, kind="stable")[:_NEIGHBOUR_COUNT]:
            name = self.names[index]
            votes[name] = votes.get(name, 0.0) + 1.0 / (float(distances[index]) + 1e-9)
        name = max(votes, key=lambda candidate: votes[candidate])
        return name, votes[name] / sum(votes.values())


def load_or_train_classifier(
    robot: Robot, file: Path, number: int = _TRAINING_CASES
) -> ResidualClassifier:
    """Load the classifier from a file, or train it and write the file if it does not exist."""
    if file.exists():
        return _read_classifier(file)
    rows, names = make_training_set(robot, number)
    with replace_file(file) as stream:
        np.savez(stream, rows=rows, names=np.array(names))
    return ResidualClassifier.from_features(rows, names)


def _read_classifier(file: Path) -> ResidualClassifier:
    with open_file(file, BlindError, max_bytes=_MAX_FILE_BYTES, advice="remove it") as stream:
        try:
            with np.load(stream, allow_pickle=False) as arrays:
                rows, names = (
                    np.asarray(arrays["rows"], np.float64),
                    list(map(str, arrays["names"])),
                )
        # numpy, zipfile and zlib raise many kinds of exceptions for a damaged file.
        except Exception as cause:
            raise BlindError(f"{file}: not a classifier ({cause}); remove it") from cause
    if rows.ndim != 2 or len(rows) != len(names) or not np.isfinite(rows).all():
        raise BlindError(f"{file}: not a classifier; remove it")
    return ResidualClassifier.from_features(rows, names)


def make_training_set(robot: Robot, number: int) -> tuple[FloatArray, list[str]]:
    """Return the features (n, f) and causes (n) of residuals, from cases that no test uses."""
    rows: list[FloatArray] = []
    names: list[str] = []
    for kind, effect, case_seed in draw_kinds(number, _TRAINING_SEED):
        if kind in ("single", "parameter", "healthy", "unknown", "poor"):
            case = draw_case(robot, kind, case_seed, effect)
            label = case.label()
            with TemporaryDirectory() as folder:
                write_case(Path(folder), case, robot)
                records = [read_record(p, robot=robot) for p in sorted(Path(folder).glob("train*"))]
            for axis, name in _list_axis_labels(label, case.axis_names):
                rows.append(compute_features(robot, records, axis))
                names.append(name)
    return np.array(rows), names


def _list_axis_labels(label: Mapping[str, Any], axes: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield each axis with an effect, and its class; for a healthy machine, the first axis."""
    effects = label["effects"] or label["hidden"]
    if not effects:
        yield axes[0], "none"
    for effect in effects:
        is_explained = label["verdict"] == "explained"
        yield effect["axis"], effect["effect"] if is_explained else label["verdict"]
