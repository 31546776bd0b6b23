"""The outcome of one machine's diagnosis, and the levels it reaches."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from rotemina.app.bench.machine import Machine
from rotemina.app.bench.residual import Residual

MOST_OVER = 1.1  # of the figure to beat
LARGEST_SET = 3  # of effects that are not told apart, but for a larger one that is known itself
LONGEST_S = 60.0


@dataclass(frozen=True, slots=True)
class NamedCause:
    """A cause: effect and axis, with the effects that cannot be distinguished from it."""

    axis: str
    effect: str
    probability: float
    ambiguous_with: tuple[str, ...]

    @property
    def among(self) -> set[str]:
        """The effects of which it is one."""
        return {self.effect, *self.ambiguous_with}


@dataclass(frozen=True, slots=True)
class Result:
    """The diagnosis of a machine; ``not_run`` gives the reason for a missing one.

    ``before`` and ``after``: what the model leaves of the test records as it was, and corrected.
    """

    machine: Machine
    title: str = ""
    verdict: str = ""
    causes: tuple[NamedCause, ...] = ()
    before: Residual | None = None
    after: Residual | None = None
    seconds: float = 0.0
    unit: str = ""
    not_run: str = ""

    @property
    def is_relative(self) -> bool:
        """Whether figures are relative errors."""
        return self.machine.truth is not None and self.machine.truth.relative

    @property
    def first_is_right(self) -> bool | None:
        """Whether the first cause is a known one; None where nothing is known."""
        truth = self.machine.truth
        if truth is None or not truth.causes:
            return None
        right = {effect for known in truth.causes for effect in known} | set(truth.also)
        return bool(self.causes) and self.causes[0].effect in right

    @property
    def missed(self) -> list[tuple[str, ...]]:
        """The known causes that are neither named nor in a set that is small enough."""
        truth = self.machine.truth
        known = truth.causes if truth is not None else ()
        return [one for one in known if not any(_covers(cause, one) for cause in self.causes)]

    @property
    def left(self) -> float | None:
        """What the corrected model leaves, in terms of the figure to beat."""
        return self._figure(self.after)

    @property
    def raw(self) -> float | None:
        """What the model leaves as it was, in the same terms."""
        return self._figure(self.before)

    def _figure(self, residual: Residual | None) -> float | None:
        if residual is None:
            return None
        return residual.relative if self.is_relative else residual.gap

    @property
    def to_beat(self) -> float | None:
        """What a plain fit leaves, where that is known."""
        return self.machine.truth.to_beat if self.machine.truth is not None else None

    @property
    def closed(self) -> float | None:
        """The share of the gap's power above the floor that the corrected model closes."""
        if self.before is None or self.after is None:
            return None
        gap = self.before.gap**2 - self.before.floor**2
        if gap <= 0.0:
            return None
        return float(np.clip(1.0 - (self.after.gap**2 - self.after.floor**2) / gap, 0.0, 1.0))

    @property
    def not_reached(self) -> list[str]:
        """The levels that are not reached, as text."""
        return list(self._not_reached())

    def _not_reached(self) -> Iterator[str]:
        if self.not_run:
            yield f"not run: {self.not_run}"
            return
        if self.first_is_right is False:
            first = self.causes[0].effect if self.causes else "none"
            yield f"the first cause is {first}, which is not known of it"
        for known in self.missed:
            yield f"{' or '.join(known)} is not named"
        if self.left is not None and self.to_beat is not None:
            over = self.left / self.to_beat
            if over > MOST_OVER:
                yield f"it leaves {over:.3g} × the figure to beat"
        if self.raw is not None and self.left is not None and self.left > self.raw:
            yield "the corrected model is worse than the model as it was"
        if self.seconds > LONGEST_S:
            yield f"it takes {self.seconds:.0f} s, more than {LONGEST_S:.0f} s"

    def as_json(self) -> dict[str, Any]:
        """Return the result as JSON."""
        truth = self.machine.truth
        return {
            "machine": self.machine.name,
            "title": self.title,
            "not_run": self.not_run or None,
            "verdict": self.verdict or None,
            "causes": [asdict(one) for one in self.causes],
            "known": [list(one) for one in truth.causes] if truth is not None else None,
            "first_is_right": self.first_is_right if not self.not_run else None,
            "missed": [list(one) for one in self.missed] if not self.not_run else None,
            "tap": str(truth.tap) if truth is not None else "meas",
            "relative": self.is_relative,
            "unit": "" if self.is_relative else self.unit,
            "raw": self.raw,
            "left": self.left,
            "to_beat": self.to_beat,
            "closed": self.closed,
            "seconds": round(self.seconds, 1),
            "not_reached": self.not_reached,
        }


def _covers(cause: NamedCause, known: tuple[str, ...]) -> bool:
    """Whether a cause is one of those that are known to stand for each other, or has one in it."""
    among = cause.among
    if cause.effect in known and among <= set(known):
        return True
    return bool(among & set(known)) and len(among) <= LARGEST_SET
