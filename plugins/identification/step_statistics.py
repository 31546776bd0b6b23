"""Statistics of many steps or cycles on one sheet: median and extremes."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.findings import NONE, Column
from rotemina.sim.quantities import Scale

HEAD = (mark("figure"), mark("median"), mark("model"), mark("lowest"), mark("highest"))


class Figure(NamedTuple):
    """One figure of every step or cycle, SI; None where the record does not show it.

    ``model`` are those of the nominal model, over the same input.
    """

    name: str
    scale: Scale
    values: Sequence[float | None]
    model: Sequence[float | None] = ()

    def row(self) -> tuple[str, ...]:
        """Return the figure's row of the sheet."""
        known = [value for value in self.values if value is not None]
        beside = [value for value in self.model if value is not None]
        model = float(np.median(beside)) if beside else None
        if not known:
            return (self.name, NONE, self.scale.text(model), NONE, NONE)
        figures = (float(np.median(known)), model, min(known), max(known))
        return (self.name, *map(self.scale.text, figures))

    def column(self) -> Column:
        """Return the figure's column of the file."""
        values = (None if v is None else v * self.scale.per_si for v in self.values)
        return Column(f"{self.name} [{self.scale.symbol or '1'}]", tuple(values))


def largest(values: Sequence[float | None]) -> float:
    """Return the largest size among values, 0 without any."""
    return max((abs(value) for value in values if value is not None), default=0.0)
