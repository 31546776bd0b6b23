"""What a blind test has brought: figures beside their levels, the confusion matrix; no widgets."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from rotemina.plugins.gap import mark, tr
from rotemina.sim.blind.figures_table import ROWS, shown
from rotemina.sim.blind.intervals import Figure
from rotemina.sim.errors import InputError
from rotemina.sim.input_files import parse_json, read_text

_MOST_BYTES = 64_000_000

_LEVEL = re.compile(r"([≥≤]?)\s*([\d.]+)\s*(%?)")
_STEP = re.compile(r"^(\S+): done \((\d+) of (\d+)\)")
HEAD = (mark("figure"), mark("level"), mark("reached, 95 %"), mark("cases"))


@dataclass(frozen=True, slots=True)
class Row:
    """A figure as it is shown; ``reached`` is None where there is no level, or no case."""

    cells: tuple[str, str, str, str]
    reached: bool | None


@dataclass(frozen=True, slots=True)
class BlindResult:
    """The score of the cases that are done, of how many.

    ``counts`` maps (what is there, what was named first) to the number of such cases.
    """

    done: int
    asked: int
    rows: tuple[Row, ...]
    counts: Mapping[tuple[str, str], int]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read what the blind test has written.

        Raises
        ------
        InputError
            If it cannot be read.
        """
        try:
            text = read_text(path, InputError, _MOST_BYTES)
            return cls._of(parse_json(text, str(path), InputError))
        except (ValueError, KeyError, TypeError) as error:
            raise InputError(
                tr(
                    "{path}: the result of the blind test cannot be read ({reason}); run it again"
                ).format(path=path, reason=error)
            ) from error

    @classmethod
    def _of(cls, document: Mapping[str, Any]) -> Self:
        rows = [
            _row(key, Figure(one["value"], *one["interval"], one["n"]))
            for key, one in document["figures"].items()
            if key in ROWS
        ]
        counts = {(one["truth"], one["named"]): one["number"] for one in document["confusion"]}
        return cls(document["done"], document["asked"], tuple(rows), counts)

    @property
    def names(self) -> tuple[str, ...]:
        """All that is there or was named, in the order of the matrix."""
        return tuple(sorted({name for pair in self.counts for name in pair}))

    def share(self, truth: str, told: str) -> float:
        """Return how often what is there was named so, of all cases where it is there."""
        total = sum(number for (there, _), number in self.counts.items() if there == truth)
        return self.counts.get((truth, told), 0) / max(total, 1)


def _row(key: str, figure: Figure) -> Row:
    text, level, form = ROWS[key]
    cells = text, level or "–", shown(figure, form), str(figure.number)
    return Row(cells, _reached(level, figure.value))


def _reached(level: str, value: float | None) -> bool | None:
    match = _LEVEL.fullmatch(level.removesuffix(" s"))
    if match is None or value is None:
        return None
    bound = float(match[2]) / (100.0 if match[3] else 1.0)
    return value >= bound if match[1] == "≥" else value <= bound


def step(line: str) -> tuple[int, int] | None:
    """Return how many cases are done, of how many, if a line of the blind test tells."""
    match = _STEP.match(line)
    return (int(match[2]), int(match[3])) if match else None
