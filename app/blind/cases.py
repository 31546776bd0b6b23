"""Cases of the blind test, from a generator or from the user's folders."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rotemina.app.errors import BlindError
from rotemina.sim.blind import (
    BlindCase,
    ForceCase,
    LabelSeal,
    compute_digest,
    draw_case,
    draw_force_case,
    draw_kinds,
    seal_label,
    write_case,
)
from rotemina.sim.blind_second import draw_second_case
from rotemina.sim.files import parse_json, read_bytes
from rotemina.sim.robot import (
    ForceAxis,
    PiezoAxis,
    Robot,
    StepperAxis,
)
from rotemina.sim.robot_files import load_robot

VERDICTS = ("explained", "none", "unknown", "insufficient_excitation")

_MAX_LABELS_BYTES = 64_000_000
_FORCE_ROBOT = "emps"

CaseLabel = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class SealedCase:
    """A case whose label is sealed.

    The diagnosis receives ``records``. ``commands`` and ``measured`` are records that are
    withheld from its fit, and None if the case has none. ``robot`` is a name or file for
    ``--robot``.
    """

    name: str
    robot: str
    records: tuple[Path, ...]
    commands: Path | None
    measured: Path | None
    seal: LabelSeal


class CaseSource(ABC):
    """Source of the cases of a blind test.

    Attributes
    ----------
    key : mapping
        Identifies the cases; results of cases with different keys are not mixed.
    names : tuple of str
        Names of the cases, in the order in which they are run.
    has_one_label_file : bool
        Whether one file holds all labels. It is then opened only after all answers are hashed.
    """

    has_one_label_file = False

    def __init__(self, key: Mapping[str, Any], names: tuple[str, ...]) -> None:
        self.key = key
        self.names = names

    @abstractmethod
    def open_case(self, name: str, salt: str) -> AbstractContextManager[SealedCase]:
        """Return a context manager; inside it, the case's files exist and its label is sealed."""

    @abstractmethod
    def open_label(self, name: str, salt: str, case_seal: LabelSeal) -> CaseLabel:
        """Open a sealed label; must be called only after the answer was hashed."""


class GeneratedCaseSource(CaseSource):
    """Cases that a generator draws from a seed.

    The first cases are the same for any number of cases. ``second`` selects the second generator,
    whose equations differ from those of the first.
    """

    def __init__(self, robot: str, number: int, seed: int, *, second: bool = False) -> None:
        self._robot_name, self._robot = robot, load_robot(robot)
        check_robot(self._robot, robot)
        if second and _has_force_axis(self._robot):
            raise BlindError(
                f"--robot {robot}: the second generator has no axes with force commands; leave "
                "--generator out, or name a robot with stages"
            )
        self._is_force_robot = _has_force_axis(self._robot)
        self._plan = {f"case_{k:04d}": plan for k, plan in enumerate(draw_kinds(number, seed))}
        self._labels: dict[str, CaseLabel] = {}
        self._uses_second_generator = second
        key: dict[str, Any] = {"seed": seed, "robot": robot}
        super().__init__(key | ({"generator": "second"} if second else {}), tuple(self._plan))

    @contextmanager
    def open_case(self, name: str, salt: str) -> Iterator[SealedCase]:
        """Draw the case, and write its files for the duration of the context."""
        kind, effect, seed = self._plan[name]
        robot_name, robot = self._robot_name, self._robot
        if self._uses_second_generator:
            with self._open_second_case(name, salt, seed) as sealed:
                yield sealed
            return
        case: BlindCase | ForceCase
        if kind == "force" or self._is_force_robot:
            if not self._is_force_robot:
                robot_name, robot = _FORCE_ROBOT, load_robot(_FORCE_ROBOT)
            case = draw_force_case(robot, seed)
        else:
            case = draw_case(robot, kind, seed, effect)
        self._labels[name] = case.label()
        with TemporaryDirectory(prefix="rotemina-") as folder:
            case_folder = Path(folder)
            write_case(case_folder, case, robot)
            yield _make_sealed_case(
                name, case_folder, robot_name, seal_label(self._labels[name], salt)
            )

    @contextmanager
    def _open_second_case(self, name: str, salt: str, seed: int) -> Iterator[SealedCase]:
        case = draw_second_case(self._robot, seed)
        self._labels[name] = case.label()
        with TemporaryDirectory(prefix="rotemina-") as folder:
            case.write(Path(folder), self._robot)
            yield _make_sealed_case(
                name, Path(folder), self._robot_name, seal_label(self._labels[name], salt)
            )

    def open_label(self, name: str, salt: str, case_seal: LabelSeal) -> CaseLabel:
        """Open the label, and check that it matches the seal."""
        label = self._labels[name]
        case_seal.check(label, salt, name)
        return label


def _has_force_axis(robot: Robot) -> bool:
    return any(isinstance(axis, ForceAxis) and axis.controller for axis in robot.axes.values())


def check_robot(robot: Robot, name: str) -> None:
    """Raise BlindError if the generator cannot make cases for a robot."""
    stage_axes = [robot.axes[name] for stage in robot.stages.values() for name in stage]
    suitable_axes = [
        axis
        for axis in stage_axes
        if isinstance(axis, PiezoAxis | StepperAxis) and axis.sensor and axis.inertia
    ]
    if not _has_force_axis(robot) and not (stage_axes and len(suitable_axes) == len(stage_axes)):
        raise BlindError(
            f"--robot {name}: cannot make cases of this robot; the generator needs stages of piezo "
            "or stepper axes with mass and sensor, or a force axis with a controller"
        )


class FolderCaseSource(CaseSource):
    """The user's own cases: a folder of ``train_*`` records for each, and labels in a JSON file.

    The file maps the name of each folder to its answer: ``{"verdict": …, "effects": [{"axis": …,
    "effect": …, "from_axis": …}]}``. It is hashed at the start, and parsed only after all
    answers are hashed. A ``robot.toml`` in the folder of a case replaces ``robot`` for that case.
    """

    has_one_label_file = True

    def __init__(self, folder: Path, labels: Path, robot: str) -> None:
        if not folder.is_dir():
            raise BlindError(f"{folder}: folder not found; name a folder of cases by --from")
        names = tuple(
            sorted(
                case_folder.name for case_folder in folder.iterdir() if _find_records(case_folder)
            )
        )
        if not names:
            raise BlindError(
                f"{folder}: no subfolder has records; each case needs a folder with "
                "train_1.csv or train_1.csv.gz, …"
            )
        self._folder, self._labels, self._robot = folder, labels, robot
        self._label_bytes = self._read_labels()
        super().__init__({"labels": compute_digest(self._label_bytes), "robot": robot}, names)

    @contextmanager
    def open_case(self, name: str, salt: str) -> Iterator[SealedCase]:
        """Return the files of the case; its seal covers the whole label file."""
        case_folder = self._folder / name
        robot_file = case_folder / "robot.toml"
        robot = str(robot_file.resolve()) if robot_file.is_file() else self._robot
        yield _make_sealed_case(name, case_folder, robot, seal_label(self._label_bytes, salt))

    def open_label(self, name: str, salt: str, case_seal: LabelSeal) -> CaseLabel:
        """Open the labels, and check that they have not changed since they were sealed."""
        content = self._read_labels()
        case_seal.check(content, salt, str(self._labels))
        labels = parse_json(content, str(self._labels), BlindError)
        return _check_label(labels, name, self._labels)

    def _read_labels(self) -> bytes:
        return read_bytes(
            self._labels, BlindError, _MAX_LABELS_BYTES, advice="--labels names a JSON file"
        )


def _check_label(labels: object, name: str, file: Path) -> CaseLabel:
    if not isinstance(labels, dict) or name not in labels:
        raise BlindError(f"{file}: has no label for {name}; it must map every case to its answer")
    label = labels[name]
    verdict = label.get("verdict") if isinstance(label, dict) else None
    if verdict not in VERDICTS:
        raise BlindError(
            f"{file}: {name}: verdict is {verdict!r}; it must be one of {', '.join(VERDICTS)}"
        )
    effects = label.get("effects", [])
    is_valid = isinstance(effects, list) and all(
        isinstance(e, dict) and all(isinstance(e.get(key), str) for key in ("axis", "effect"))
        for e in effects
    )
    if not is_valid or ((verdict == "explained") != bool(effects) and verdict != "unknown"):
        raise BlindError(
            f"{file}: {name}: effects must be a list of objects with axis and effect, "
            "empty unless the verdict is explained or unknown"
        )
    floors = label.get("floors", 0.0)
    if isinstance(floors, bool) or not isinstance(floors, int | float):
        raise BlindError(f"{file}: {name}: floors is {floors!r}; it must be a number")
    return {**label, "effects": effects}


def _find_records(case_folder: Path) -> list[Path]:
    paths = case_folder.glob("train_*") if case_folder.is_dir() else []
    return sorted(path for path in paths if path.name.endswith((".csv", ".csv.gz")))


def _make_sealed_case(name: str, case_folder: Path, robot: str, case_seal: LabelSeal) -> SealedCase:
    withheld = [
        next(
            (
                p
                for p in (case_folder / f"{stem}.csv.gz", case_folder / f"{stem}.csv")
                if p.is_file()
            ),
            None,
        )
        for stem in ("test_commands", "test_measured")
    ]
    return SealedCase(
        name, robot, tuple(_find_records(case_folder)), withheld[0], withheld[1], case_seal
    )
