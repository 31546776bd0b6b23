"""The ranking of candidates during the examination of an axis."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

from rotemina.sim.robot import AxisEffect

Causes = tuple[tuple[str, str | None], ...]
"""Effects that are tried together, each with the axis that it comes from."""


class Grade(IntEnum):
    """How far a candidate was examined; results of a higher grade replace those of a lower one."""

    LOOK = 0  # a first look: a step downhill from its best start
    FIT = 1  # fitted, on the records that it is judged by
    UNSEEN = 2  # fitted, and judged by records that its fit has not seen


@dataclass(frozen=True, slots=True)
class Standing:
    """What a set of causes leaves of a gap, as far as it was tried.

    Attributes
    ----------
    causes : Causes
        None of them is the model, its own parameters re-tuned.
    left : float
        Mean square over the floor.
    closed : float
        Share of the gap's power beyond the floor that is gone, within 0 and 1.
    grade : Grade
    """

    causes: Causes
    left: float
    closed: float
    grade: Grade


@dataclass(frozen=True, slots=True)
class Ranking:
    """The candidates of an axis so far, best first.

    Attributes
    ----------
    axis : str
    whole : float
        Mean square over the floor of the gap before.
    tried : int
        Sets of causes that were tried so far, never falling.
    standings : tuple of Standing
        Those that were tried on what is looked at now: once disturbances are set aside anew, all
        is tried again.
    """

    axis: str
    whole: float
    tried: int
    standings: tuple[Standing, ...]


class Standings:
    """Collects the ranking of the candidates of an axis."""

    def __init__(self, axis: str) -> None:
        self._axis = axis
        self._whole = 0.0
        self._known: set[Causes] = set()
        self._best: dict[Causes, Standing] = {}

    def begin(self, whole: float) -> None:
        """Forget what candidates left of another gap; ``whole`` is the mean square of this."""
        self._whole = whole
        self._best.clear()

    def add(self, causes: Sequence[AxisEffect], left: float, grade: Grade) -> None:
        """Note what causes leave; of several formulations the best counts."""
        key = tuple(sorted((one.id, one.from_axis) for one in causes))
        self._known.add(key)
        now = Standing(key, left, closed(self._whole, left), grade)
        before = self._best.get(key)
        if before is None or (-grade, left) < (-before.grade, before.left):
            self._best[key] = now

    def ranking(self) -> Ranking:
        """Return the present ranking; on a tie, the further examined candidate is first."""
        ranked = sorted(self._best.values(), key=lambda one: (one.left, -one.grade))
        return Ranking(self._axis, self._whole, len(self._known), tuple(ranked))


def closed(before: float, after: float) -> float:
    """Return the share, within 0 and 1, of a gap that is closed; both mean squares over the floor.

    A gap within the floor counts as closed.
    """
    if before <= 1.0:
        return 1.0
    return min(max(1.0 - (after - 1.0) / (before - 1.0), 0.0), 1.0)
