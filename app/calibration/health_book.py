"""Health cards over time: one append-only file per axis, with one line per card."""

import json
from datetime import datetime
from math import isfinite
from pathlib import Path
from typing import NamedTuple

from rotemina.app.errors import HealthBookError
from rotemina.app.settings import make_plain_name
from rotemina.sim.calibration import SensorFigureEstimate
from rotemina.sim.errors import (
    FileWriteError,
)
from rotemina.sim.files import (
    parse_json,
    read_bytes,
)

FOLDER = "health"
VERSION = 1
_MAX_BYTES = 4_000_000


class HealthCard(NamedTuple):
    """The health figures of an axis on one day, and the name of their source record."""

    date: str
    record: str
    figures: tuple[SensorFigureEstimate, ...]


class HealthBook:
    """The health cards of all axes of one robot.

    Parameters
    ----------
    folder : Path
        The user's folder.
    robot : str
        Name of the robot.
    """

    def __init__(self, folder: Path, robot: str) -> None:
        self._folder = folder / FOLDER
        self._robot = robot

    def make_path(self, axis: str) -> Path:
        """Return the path of the file with the cards of an axis."""
        return self._folder / f"{make_plain_name(self._robot)}--{make_plain_name(axis)}.jsonl"

    def read_cards(self, axis: str) -> tuple[HealthCard, ...]:
        """Return the cards of an axis, oldest first; unreadable lines are skipped.

        Raises
        ------
        HealthBookError
            If the file cannot be read.
        """
        path = self.make_path(axis)
        if not path.exists():
            return ()
        data = read_bytes(path, HealthBookError, _MAX_BYTES, advice="move it away")
        lines = data.decode("utf-8", errors="replace").splitlines()
        return tuple(card for line in lines if (card := _parse_card(line)) is not None)

    def add(
        self, axis: str, figures: tuple[SensorFigureEstimate, ...], record: str, date: datetime
    ) -> None:
        """Append a card to the file of an axis.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        path = self.make_path(axis)
        line = json.dumps(
            {
                "version": VERSION,
                "date": date.isoformat(timespec="seconds"),
                "record": record,
                "figures": [list(figure) for figure in figures],
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
                "{path}: the card cannot be stored ({strerror}); free disk space",
                path=path,
                strerror=str(error.strerror),
            ) from error


def _parse_card(line: str) -> HealthCard | None:
    """Return the card of a line; None if the line is cut off, or written by a newer program."""
    try:
        entry = parse_json(line, "card", HealthBookError)
        if entry["version"] != VERSION:
            return None
        figures = tuple(
            SensorFigureEstimate(str(name), float(number), float(half_width), str(unit))
            for name, number, half_width, unit in entry["figures"]
        )
        if not all(isfinite(figure.value) and figure.half_width >= 0.0 for figure in figures):
            return None
        return HealthCard(str(entry["date"]), str(entry["record"]), figures)
    except (ValueError, KeyError, TypeError):
        return None
