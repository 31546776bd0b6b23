"""A first look at every candidate, ranked as it grows, while the diagnosis is under way. No Qt.

Each candidate alone is asked how much of an axis' gap it would take away, by the beginning of
each record only. It shows whoever waits where the diagnosis will probably end; what that says in
the end rests on whole fits, and on data that they did not see.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import sqrt

from rotemina.sim.errors import InputError
from rotemina.sim.gap.candidates import candidates, scouts
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.models import untouched
from rotemina.sim.gap.screening import screen
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

_ROWS = 4000  # of each record: it must not take long


@dataclass(frozen=True, slots=True)
class Seen:
    """A candidate, and what it would leave at most of the gap: rms in noise floors."""

    effect: str
    from_axis: str | None
    left: float


@dataclass(frozen=True, slots=True)
class Look:
    """The candidates that were looked at so far on an axis, the likeliest first.

    ``whole`` is the gap before, rms in noise floors; ``done`` of ``count`` looks are taken.
    """

    axis: str
    whole: float
    seen: tuple[Seen, ...]
    done: int
    count: int


def first_look(
    robot: Robot, axis: str, records: Sequence[Record], told: Callable[[Look], None]
) -> None:
    """Look at the candidates of an axis one by one; ``told`` hears after each.

    Records of which too little is left say nothing; what ``told`` raises ends the look.
    """
    try:
        beginnings = [record.part(slice(0, _ROWS)) for record in records]
        evidence = Evidence.of(robot, axis, beginnings)
        bare = untouched(evidence)
        looked_at = scouts(evidence, candidates(evidence))
    except InputError:
        return
    whole = sqrt(bare.fit.cost)
    best: dict[tuple[str, str | None], Seen] = {}
    for number, one in enumerate(looked_at, start=1):
        try:
            left = sqrt(screen(evidence, bare.fit, one, briefly=True).cost)
        except InputError:
            continue  # a start that cannot be simulated says nothing of the candidate
        key = one.id, one.from_axis
        if key not in best or left < best[key].left:
            best[key] = Seen(*key, left)
        ranked = sorted(best.values(), key=lambda seen: seen.left)
        told(Look(axis, whole, tuple(ranked), number, len(looked_at)))
