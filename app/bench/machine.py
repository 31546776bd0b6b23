"""A machine of the benchmark: a folder with its robot file, records and known causes."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rotemina.app.errors import BenchError
from rotemina.sim.files import parse_toml, read_text
from rotemina.sim.records import DEFAULT_LIMITS, Tap, open_blocks, parse_comment

_ROBOT_FILE = "robot.toml"
_MAX_FILE_BYTES = 1_000_000
_TRUTH_FILE = "truth.toml"
_RECORD_SUFFIXES = (".csv", ".csv.gz", ".txt", ".txt.gz")


@dataclass(frozen=True, slots=True)
class KnownCauses:
    """Known causes of a machine.

    Attributes
    ----------
    causes : tuple of tuple of str
        One set of effects for each cause. The records cannot distinguish the effects of a set.
    optional_effects : tuple of str
        Effects that a correct diagnosis may name, but need not.
    tap : Tap
        The signal at which model and machine are compared.
    is_relative : bool
        Whether ``to_beat`` is a relative error; otherwise it is an rms in SI units.
    to_beat : float, optional
        The error of a plain fit on the test records.
    """

    causes: tuple[tuple[str, ...], ...] = ()
    optional_effects: tuple[str, ...] = ()
    tap: Tap = Tap.MEAS
    is_relative: bool = False
    to_beat: float | None = None


@dataclass(frozen=True, slots=True)
class BenchMachine:
    """A folder with ``robot.toml``, ``train_*`` and ``test_*`` records, and ``truth.toml``."""

    name: str
    robot: Path
    train: tuple[Path, ...]
    test: tuple[Path, ...]
    truth: KnownCauses | None

    @classmethod
    def from_folder(cls, folder: Path) -> "BenchMachine":
        """Read the contents of a machine's folder.

        Raises
        ------
        BenchError
            If it has no train records, or its ``truth.toml`` is invalid.
        """
        train, test = (_find_records(folder, prefix) for prefix in ("train", "test"))
        if not train:
            raise BenchError(f"{folder}: has no record train_*.csv or train_*.csv.gz; add one")
        truth_path = folder / _TRUTH_FILE
        truth = _read_truth(truth_path) if truth_path.is_file() else None
        return cls(folder.resolve().name, folder / _ROBOT_FILE, train, test, truth)

    @property
    def is_inverse(self) -> bool:
        """Whether a record was driven by an unknown controller (``# mode: inverse``)."""
        return any(_read_mode(path) == "inverse" for path in (*self.train, *self.test))


def find_machines(folders: Iterable[Path]) -> list[BenchMachine]:
    """Find the machines in folders.

    Each folder is the folder of one machine, or has a subfolder for each machine.

    Raises
    ------
    BenchError
        If there is no machine in a folder or its subfolders.
    """
    result = []
    for folder in folders:
        machine_folders = (
            [folder]
            if _is_machine(folder)
            else sorted(filter(_is_machine, _list_subfolders(folder)))
        )
        if not machine_folders:
            raise BenchError(
                f"{folder}: no {_ROBOT_FILE} in it or in its subfolders; name the folder of a "
                "machine, with robot.toml, train_*.csv and test_*.csv"
            )
        result += map(BenchMachine.from_folder, machine_folders)
    return result


def _list_subfolders(folder: Path) -> list[Path]:
    return [path for path in folder.iterdir() if path.is_dir()] if folder.is_dir() else []


def _is_machine(folder: Path) -> bool:
    return (folder / _ROBOT_FILE).is_file()


def _find_records(folder: Path, prefix: str) -> tuple[Path, ...]:
    paths = folder.glob(f"{prefix}_*")
    return tuple(sorted(path for path in paths if path.name.endswith(_RECORD_SUFFIXES)))


def _read_mode(path: Path) -> str | None:
    with open_blocks(path, DEFAULT_LIMITS) as blocks:
        lines = next(iter(blocks)).data.splitlines()
    for line in lines:
        if not line.lstrip().startswith(b"#"):
            return None
        entry = parse_comment(line.decode("utf-8", "replace").strip())
        if entry is not None and entry[0] == "mode":
            return entry[1]
    return None


def _read_truth(path: Path) -> KnownCauses:
    table = parse_toml(read_text(path, BenchError, _MAX_FILE_BYTES), str(path), BenchError)
    for key, value in table.items():
        is_allowed, advice = _TRUTH_KEYS.get(
            key, (lambda _: False, f"use {', '.join(_TRUTH_KEYS)}")
        )
        if not is_allowed(value):
            raise BenchError(f"{path}: {key} = {value!r}: {advice}")
    return KnownCauses(
        causes=tuple(map(tuple, table.get("causes", []))),
        optional_effects=tuple(table.get("also", [])),
        tap=Tap(table.get("tap", "meas")),
        is_relative=table.get("relative", False),
        to_beat=table.get("to_beat"),
    )


def _are_names(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(name, str) for name in value)


_TRUTH_KEYS: Mapping[str, Any] = {
    "causes": (
        lambda value: (
            isinstance(value, list) and all(names and _are_names(names) for names in value)
        ),
        "must be a list of sets, such as [['friction', 'backlash']]",
    ),
    "also": (_are_names, "must be a list of effects, such as ['gain_error']"),
    "tap": (lambda value: value in ("u", "ref", "meas"), "must be u, ref or meas"),
    "relative": (lambda value: isinstance(value, bool), "must be true or false"),
    "to_beat": (
        lambda value: isinstance(value, int | float) and not isinstance(value, bool) and value > 0,
        "must be a number above 0, in SI units or relative",
    ),
}
