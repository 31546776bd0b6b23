"""Statistics of a figure over many steps or cycles: median and extremes."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.findings import NO_VALUE, ExportColumn
from rotemina.sim.units import DisplayScale

STATISTIC_HEADINGS = (
    mark("figure"),
    mark("median"),
    mark("model"),
    mark("lowest"),
    mark("highest"),
)


class FigureStatistics(NamedTuple):
    """Values of one figure for all steps or cycles, SI. A value is None if it cannot be measured.

    ``model`` contains the values of the nominal model for the same input.
    """

    name: str
    scale: DisplayScale
    values: Sequence[float | None]
    model: Sequence[float | None] = ()

    def make_row(self) -> tuple[str, ...]:
        """Return the row of the table."""
        values = [value for value in self.values if value is not None]
        model_values = [value for value in self.model if value is not None]
        model_median = float(np.median(model_values)) if model_values else None
        if not values:
            return (
                self.name,
                NO_VALUE,
                self.scale.format_with_unit(model_median),
                NO_VALUE,
                NO_VALUE,
            )
        figures = (float(np.median(values)), model_median, min(values), max(values))
        return (self.name, *map(self.scale.format_with_unit, figures))

    def make_column(self) -> ExportColumn:
        """Return the column of the exported file."""
        values = (None if value is None else value * self.scale.per_si for value in self.values)
        return ExportColumn(f"{self.name} [{self.scale.symbol or '1'}]", tuple(values))


def find_largest(values: Sequence[float | None]) -> float:
    """Return the largest absolute value, or 0 without values."""
    return max((abs(value) for value in values if value is not None), default=0.0)
