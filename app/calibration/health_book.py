"""Health cards over time: one append-only file per axis, one line per card."""

import json
from datetime import datetime
from math import isfinite
from pathlib import Path
from typing import NamedTuple

from rotemina.app.files import plain_name
from rotemina.sim.calibration.sensor_calibration import Figure
from rotemina.sim.errors import InputError
from rotemina.sim.input_files import parse_json, read_bytes
from rotemina.sim.messages import message
from rotemina.sim.whole_files import FileWriteError

FOLDER = "health"
VERSION = 1
_MOST_BYTES = 4_000_000


class HealthBookError(InputError):
    """A file of health cards that cannot be read."""


class Card(NamedTuple):
    """The figures of one day, and their source record."""

    date: str
    record: str
    figures: tuple[Figure, ...]


class HealthBook:
    """The cards of one robot's axes.

    Parameters
    ----------
    folder : Path
        The user's.
    robot : str
        Its name.
    """

    def __init__(self, folder: Path, robot: str) -> None:
        self._folder = folder / FOLDER
        self._robot = robot

    def path(self, axis: str) -> Path:
        """Return where the cards of an axis are."""
        return self._folder / f"{plain_name(self._robot)}--{plain_name(axis)}.jsonl"

    def cards(self, axis: str) -> tuple[Card, ...]:
        """Return the cards of an axis, the oldest first; a line that is none is passed over.

        Raises
        ------
        HealthBookError
            If the file cannot be read.
        """
        path = self.path(axis)
        if not path.exists():
            return ()
        data = read_bytes(path, HealthBookError, _MOST_BYTES, advice="move it away")
        lines = data.decode("utf-8", errors="replace").splitlines()
        return tuple(card for line in lines if (card := _card(line)) is not None)

    def add(self, axis: str, figures: tuple[Figure, ...], record: str, date: datetime) -> None:
        """Write a card behind the others.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        path = self.path(axis)
        line = json.dumps(
            {
                "version": VERSION,
                "date": date.isoformat(timespec="seconds"),
                "record": record,
                "figures": [list(each) for each in figures],
            },
            ensure_ascii=False,
            allow_nan=False,
        )
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("a", encoding="utf-8") as file:
                file.write(line + "\n")
        except OSError as error:
            raise FileWriteError(
                message(
                    "engine", "{path}: the card cannot be stored ({strerror}); free disk space"
                ).fill(path=path, strerror=str(error.strerror))
            ) from error


def _card(line: str) -> Card | None:
    """Return the card of a line; None where it is cut off, or of a later program."""
    try:
        value = parse_json(line, "card", HealthBookError)
        if value["version"] != VERSION:
            return None
        figures = tuple(
            Figure(str(name), float(number), float(half), str(unit))
            for name, number, half, unit in value["figures"]
        )
        if not all(isfinite(each.value) and each.half_width >= 0.0 for each in figures):
            return None
        return Card(str(value["date"]), str(value["record"]), figures)
    except (ValueError, KeyError, TypeError):
        return None
