"""Bounds of the present positions of the axes."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from rotemina.sim.arrays import FloatArray


class PositionEnvelope(NamedTuple):
    """Possible present positions of the axes: bounds (axes,) of all commands that may act.

    ``deviation`` (axes,) is by how much readings differ from commands, less what is noise: the tip
    is judged where it is told to be, and that much beside it, where it is read to be.
    """

    low: FloatArray
    high: FloatArray
    deviation: FloatArray

    def widened(self, columns: Mapping[int, float]) -> "PositionEnvelope":
        """Return the bounds with more values of some axes in them."""
        low, high = self.low.copy(), self.high.copy()
        for column, value in columns.items():
            low[column], high[column] = min(low[column], value), max(high[column], value)
        return PositionEnvelope(low, high, self.deviation)

    def seen(self) -> Iterator[tuple[FloatArray, FloatArray]]:
        """Yield the bounds about commands, and about readings where these are elsewhere."""
        yield self.low, self.high
        if self.deviation.any():
            yield self.low + self.deviation, self.high + self.deviation
