"""A share of the cases, for a test split over several sessions or machines."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Shard:
    """Every ``number``-th case from the ``index``-th (counted from 1)."""

    index: int = 1
    number: int = 1

    def of(self, names: Sequence[str]) -> list[str]:
        """Return the names of this shard's cases."""
        return list(names[self.index - 1 :: self.number])
