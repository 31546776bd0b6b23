"""A machine in a folder: its robot file, its records, and its known causes."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rotemina.sim.errors import InputError
from rotemina.sim.input_files import parse_toml, read_text
from rotemina.sim.records.file_blocks import LIMITS, open_blocks
from rotemina.sim.records.metadata import parse_comment
from rotemina.sim.records.record import Tap

_ROBOT = "robot.toml"
_MOST_BYTES = 1_000_000
_TRUTH = "truth.toml"
_ENDINGS = (".csv", ".csv.gz", ".txt", ".txt.gz")


class BenchError(InputError):
    """A folder that is no machine's."""


@dataclass(frozen=True, slots=True)
class Truth:
    """Known causes of a machine.

    Attributes
    ----------
    causes : tuple of tuple of str
        Sets of effects that stand for each other in these records.
    also : tuple of str
        Effects that are right wherever they stand, and are not demanded.
    tap : Tap
        Where the machine is compared.
    relative : bool
        Whether ``to_beat`` is a relative error, and no rms in SI.
    to_beat : float, optional
        What a plain fit leaves of the test records.
    """

    causes: tuple[tuple[str, ...], ...] = ()
    also: tuple[str, ...] = ()
    tap: Tap = Tap.MEAS
    relative: bool = False
    to_beat: float | None = None


@dataclass(frozen=True, slots=True)
class Machine:
    """A folder with ``robot.toml``, ``train_*`` and ``test_*`` records, and ``truth.toml``."""

    name: str
    robot: Path
    train: tuple[Path, ...]
    test: tuple[Path, ...]
    truth: Truth | None

    @classmethod
    def of(cls, folder: Path) -> "Machine":
        """Look into a folder.

        Raises
        ------
        BenchError
            If something is missing in it, or its ``truth.toml`` cannot be understood.
        """
        train, test = (_records(folder, part) for part in ("train", "test"))
        if not train:
            raise BenchError(f"{folder}: no record train_*.csv or train_*.csv.gz is in it; add one")
        truth = folder / _TRUTH
        known = _truth(truth) if truth.is_file() else None
        return cls(folder.resolve().name, folder / _ROBOT, train, test, known)

    @property
    def is_inverse(self) -> bool:
        """Whether a record was driven by an unknown controller (``# mode: inverse``)."""
        return any(_mode(path) == "inverse" for path in (*self.train, *self.test))


def machines(folders: Iterable[Path]) -> list[Machine]:
    """Return the machines in folders: each is one, or holds one in each of its own folders.

    Raises
    ------
    BenchError
        If a folder neither is nor holds a machine's.
    """
    found = []
    for folder in folders:
        own = [folder] if _is_machine(folder) else sorted(filter(_is_machine, _folders(folder)))
        if not own:
            raise BenchError(
                f"{folder}: neither it nor a folder in it holds {_ROBOT}; name a machine's folder, "
                "with robot.toml, train_*.csv and test_*.csv"
            )
        found += map(Machine.of, own)
    return found


def _folders(folder: Path) -> list[Path]:
    return [each for each in folder.iterdir() if each.is_dir()] if folder.is_dir() else []


def _is_machine(folder: Path) -> bool:
    return (folder / _ROBOT).is_file()


def _records(folder: Path, part: str) -> tuple[Path, ...]:
    paths = folder.glob(f"{part}_*")
    return tuple(sorted(path for path in paths if path.name.endswith(_ENDINGS)))


def _mode(path: Path) -> str | None:
    """Return the mode that a record's first lines name."""
    with open_blocks(path, LIMITS) as blocks:
        lines = next(iter(blocks)).data.splitlines()
    for line in lines:
        if not line.lstrip().startswith(b"#"):
            return None
        entry = parse_comment(line.decode("utf-8", "replace").strip())
        if entry is not None and entry[0] == "mode":
            return entry[1]
    return None


def _truth(path: Path) -> Truth:
    read = parse_toml(read_text(path, BenchError, _MOST_BYTES), str(path), BenchError)
    for key, value in read.items():
        allowed, advice = _KEYS.get(key, (lambda _: False, f"use {', '.join(_KEYS)}"))
        if not allowed(value):
            raise BenchError(f"{path}: {key} = {value!r}: {advice}")
    return Truth(
        causes=tuple(map(tuple, read.get("causes", []))),
        also=tuple(read.get("also", [])),
        tap=Tap(read.get("tap", "meas")),
        relative=read.get("relative", False),
        to_beat=read.get("to_beat"),
    )


def _are_names(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(one, str) for one in value)


_KEYS: Mapping[str, Any] = {
    "causes": (
        lambda value: isinstance(value, list) and all(one and _are_names(one) for one in value),
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
