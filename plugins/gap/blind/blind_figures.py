"""Result of a blind test: scores with their targets, and the confusion matrix.

This module does not use Qt.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from rotemina.plugins.gap import mark, tr
from rotemina.sim.blind import FIGURE_ROWS, IntervalEstimate, format_figure
from rotemina.sim.errors import InputError
from rotemina.sim.files import parse_json, read_text

_MAX_FILE_BYTES = 64_000_000
# A target is a display text such as "≥ 90 %" or "≤ 2 s". Without an operator, "≤" is meant.
_TARGET_PATTERN = re.compile(r"([≥≤]?)\s*([\d.]+)\s*(%?)")
_PROGRESS_PATTERN = re.compile(r"^(\S+): done \((\d+) of (\d+)\)")
FIGURE_HEADINGS = (mark("figure"), mark("level"), mark("reached, 95 %"), mark("cases"))


@dataclass(frozen=True, slots=True)
class FigureRow:
    """Score as shown in the table.

    ``reached`` says whether the target is met. It is None without a target or without cases.
    """

    cells: tuple[str, str, str, str]
    reached: bool | None


@dataclass(frozen=True, slots=True)
class BlindResult:
    """Scores of a blind test, of whose ``total`` cases ``done`` are completed.

    ``counts`` maps (true cause, top-ranked diagnosed cause) to the number of such cases.
    """

    done: int
    total: int
    rows: tuple[FigureRow, ...]
    counts: Mapping[tuple[str, str], int]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read the score file of a blind test.

        Raises
        ------
        InputError
            If the file cannot be read.
        """
        try:
            text = read_text(path, InputError, _MAX_FILE_BYTES)
            return cls._from_document(parse_json(text, str(path), InputError))
        except (ValueError, KeyError, TypeError) as error:
            raise InputError(
                tr(
                    "{path}: the result of the blind test cannot be read ({reason}); run it again"
                ).format(path=path, reason=error)
            ) from error

    @classmethod
    def _from_document(cls, document: Mapping[str, Any]) -> Self:
        rows = [
            _make_row(key, IntervalEstimate(entry["value"], *entry["interval"], entry["n"]))
            for key, entry in document["figures"].items()
            if key in FIGURE_ROWS
        ]
        counts = {
            (entry["truth"], entry["named"]): entry["number"] for entry in document["confusion"]
        }
        return cls(document["done"], document["asked"], tuple(rows), counts)

    @property
    def names(self) -> tuple[str, ...]:
        """All true and diagnosed causes, in the order of the confusion matrix."""
        return tuple(sorted({name for pair in self.counts for name in pair}))

    def compute_share(self, truth: str, named: str) -> float:
        """Return the fraction of the cases with true cause ``truth`` diagnosed as ``named``."""
        total = sum(
            case_count for (true_cause, _), case_count in self.counts.items() if true_cause == truth
        )
        return self.counts.get((truth, named), 0) / max(total, 1)


def _make_row(key: str, figure: IntervalEstimate) -> FigureRow:
    label, target, number_format = FIGURE_ROWS[key]
    cells = label, target or "–", format_figure(figure, number_format), str(figure.case_count)
    return FigureRow(cells, _is_target_met(target, figure.value))


def _is_target_met(target: str, value: float | None) -> bool | None:
    match = _TARGET_PATTERN.fullmatch(target.removesuffix(" s"))
    if match is None or value is None:
        return None
    bound = float(match[2]) / (100.0 if match[3] else 1.0)
    return value >= bound if match[1] == "≥" else value <= bound


def parse_progress(line: str) -> tuple[int, int] | None:
    """Return the numbers of completed and of all cases if a line of output reports them."""
    match = _PROGRESS_PATTERN.match(line)
    return (int(match[2]), int(match[3])) if match else None
