"""Cases of the blind test: from the generator, or withheld ones supplied by the user."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rotemina.sim.blind.case import Case, draw_case
from rotemina.sim.blind.files import kinds, write_case
from rotemina.sim.blind.force import ForceCase, draw_force_case
from rotemina.sim.blind.sealing import Seal, digest, seal
from rotemina.sim.blind_second.case import draw_second
from rotemina.sim.errors import InputError
from rotemina.sim.input_files import parse_json, read_bytes
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import ForceAxis, PiezoAxis, Robot, StepperAxis

VERDICTS = ("explained", "none", "unknown", "insufficient_excitation")

_MOST_BYTES = 64_000_000
_FORCE_ROBOT = "emps"

Label = Mapping[str, Any]


class BlindError(InputError):
    """A blind test that cannot be run: its folder, cases or labels."""


@dataclass(frozen=True, slots=True)
class SealedCase:
    """A case whose label is sealed.

    ``records`` are given to the diagnosis; ``commands`` and ``measured`` (None where there are
    none) are withheld from its fit; ``robot`` is what ``--robot`` takes.
    """

    name: str
    robot: str
    records: tuple[Path, ...]
    commands: Path | None
    measured: Path | None
    seal: Seal


class Cases(ABC):
    """Where cases come from.

    ``key`` tells them from others, whose results are not mixed in; ``names`` in their order.
    ``one_file``: all labels lie in one file, which is opened when all answers are hashed.
    """

    one_file = False

    def __init__(self, key: Mapping[str, Any], names: tuple[str, ...]) -> None:
        self.key = key
        self.names = names

    @abstractmethod
    def sealed(self, name: str, salt: str) -> AbstractContextManager[SealedCase]:
        """Return a context in which the case's files are there and its label is sealed."""

    @abstractmethod
    def label(self, name: str, salt: str, sealed: Seal) -> Label:
        """Open a label that was sealed; asked for once the answer is hashed."""


class GeneratedCases(Cases):
    """Cases that a generator draws from a seed; more of them begin with the same ones.

    ``second``: by the second generator, whose equations are others again.
    """

    def __init__(self, robot: str, number: int, seed: int, *, second: bool = False) -> None:
        self._robot_name, self._robot = robot, load_robot(robot)
        check_robot(self._robot, robot)
        if second and _moved_by_force(self._robot):
            raise BlindError(
                f"--robot {robot}: the second generator makes no axes under force; leave "
                "--generator out, or name a robot with stages"
            )
        self._force = _moved_by_force(self._robot)
        self._plan = {f"case_{k:04d}": drawn for k, drawn in enumerate(kinds(number, seed))}
        self._labels: dict[str, Label] = {}
        self._second = second
        key: dict[str, Any] = {"seed": seed, "robot": robot}
        super().__init__(key | ({"generator": "second"} if second else {}), tuple(self._plan))

    @contextmanager
    def sealed(self, name: str, salt: str) -> Iterator[SealedCase]:
        """Draw the case and write its files for as long as the context lasts."""
        kind, effect, seed = self._plan[name]
        robot_name, robot = self._robot_name, self._robot
        if self._second:
            with self._sealed_second(name, salt, seed) as sealed:
                yield sealed
            return
        case: Case | ForceCase
        if kind == "force" or self._force:
            if not self._force:
                robot_name, robot = _FORCE_ROBOT, load_robot(_FORCE_ROBOT)
            case = draw_force_case(robot, seed)
        else:
            case = draw_case(robot, kind, seed, effect)
        self._labels[name] = case.label()
        with TemporaryDirectory(prefix="rotemina-") as folder:
            place = Path(folder)
            write_case(place, case, robot)
            yield _laid_out(name, place, robot_name, seal(self._labels[name], salt))

    @contextmanager
    def _sealed_second(self, name: str, salt: str, seed: int) -> Iterator[SealedCase]:
        made = draw_second(self._robot, seed)
        self._labels[name] = made.label()
        with TemporaryDirectory(prefix="rotemina-") as folder:
            made.write(Path(folder), self._robot)
            yield _laid_out(name, Path(folder), self._robot_name, seal(self._labels[name], salt))

    def label(self, name: str, salt: str, sealed: Seal) -> Label:
        """Open the label, which must be the one that was sealed."""
        label = self._labels[name]
        sealed.check(label, salt, name)
        return label


def _moved_by_force(robot: Robot) -> bool:
    return any(isinstance(a, ForceAxis) and a.controller for a in robot.axes.values())


def check_robot(robot: Robot, name: str) -> None:
    """Raise where the generator has no cases for a robot."""
    staged = [robot.axes[axis] for stage in robot.stages.values() for axis in stage]
    whole = [a for a in staged if isinstance(a, PiezoAxis | StepperAxis) and a.sensor and a.inertia]
    if not _moved_by_force(robot) and not (staged and len(whole) == len(staged)):
        raise BlindError(
            f"--robot {name}: no cases can be made of it; the generator needs stages of piezo or "
            "stepper axes with mass and sensor, or a force axis with a controller"
        )


class FolderCases(Cases):
    """Cases of one's own: a folder each with ``train_*`` records, and labels in a JSON file.

    The file maps the name of each folder to its answer: ``{"verdict": …, "effects": [{"axis": …,
    "effect": …, "from_axis": …}]}``. It is hashed first, and understood when all answers are
    hashed. A ``robot.toml`` in a case's folder is that case's robot.
    """

    one_file = True

    def __init__(self, folder: Path, labels: Path, robot: str) -> None:
        if not folder.is_dir():
            raise BlindError(f"{folder}: there is no such folder; --from names a folder of cases")
        names = tuple(sorted(place.name for place in folder.iterdir() if _records(place)))
        if not names:
            raise BlindError(
                f"{folder}: no folder in it holds records; each case needs a folder with "
                "train_1.csv or train_1.csv.gz, …"
            )
        self._folder, self._labels, self._robot = folder, labels, robot
        self._bytes = self._read()
        super().__init__({"labels": digest(self._bytes), "robot": robot}, names)

    @contextmanager
    def sealed(self, name: str, salt: str) -> Iterator[SealedCase]:
        """Name the case's files; the seal is on the whole file of labels."""
        place = self._folder / name
        own = place / "robot.toml"
        robot = str(own.resolve()) if own.is_file() else self._robot
        yield _laid_out(name, place, robot, seal(self._bytes, salt))

    def label(self, name: str, salt: str, sealed: Seal) -> Label:
        """Open the labels, which must not have changed since they were sealed."""
        content = self._read()
        sealed.check(content, salt, str(self._labels))
        labels = parse_json(content, str(self._labels), BlindError)
        return _checked(labels, name, self._labels)

    def _read(self) -> bytes:
        return read_bytes(
            self._labels, BlindError, _MOST_BYTES, advice="--labels names a JSON file"
        )


def _checked(labels: object, name: str, file: Path) -> Label:
    if not isinstance(labels, dict) or name not in labels:
        raise BlindError(f"{file}: it has no label of {name}; it maps every case to its answer")
    label = labels[name]
    verdict = label.get("verdict") if isinstance(label, dict) else None
    if verdict not in VERDICTS:
        raise BlindError(
            f"{file}: {name}: verdict is {verdict!r}; it must be one of {', '.join(VERDICTS)}"
        )
    effects = label.get("effects", [])
    whole = isinstance(effects, list) and all(
        isinstance(e, dict) and all(isinstance(e.get(key), str) for key in ("axis", "effect"))
        for e in effects
    )
    if not whole or ((verdict == "explained") != bool(effects) and verdict != "unknown"):
        raise BlindError(
            f"{file}: {name}: effects must be a list of objects with axis and effect, "
            "empty unless the verdict is explained or unknown"
        )
    floors = label.get("floors", 0.0)
    if isinstance(floors, bool) or not isinstance(floors, int | float):
        raise BlindError(f"{file}: {name}: floors is {floors!r}; it must be a number")
    return {**label, "effects": effects}


def _records(place: Path) -> list[Path]:
    names = place.glob("train_*") if place.is_dir() else []
    return sorted(path for path in names if path.name.endswith((".csv", ".csv.gz")))


def _laid_out(name: str, place: Path, robot: str, sealed: Seal) -> SealedCase:
    withheld = [
        next((p for p in (place / f"{stem}.csv.gz", place / f"{stem}.csv") if p.is_file()), None)
        for stem in ("test_commands", "test_measured")
    ]
    return SealedCase(name, robot, tuple(_records(place)), withheld[0], withheld[1], sealed)
