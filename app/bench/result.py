"""The diagnosis of a machine, and the requirements that it does not meet."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from rotemina.app.bench.machine import BenchMachine
from rotemina.app.bench.residual import ModelResidual

# The error of the corrected model may be at most this multiple of the error of a plain fit.
MAX_RATIO_TO_BEST_FIT = 1.1
# A cause counts as named if its set of indistinguishable effects is at most this large. A larger
# set counts only if all its effects are known to be indistinguishable.
MAX_AMBIGUITY_SET_SIZE = 3
MAX_DIAGNOSIS_S = 60.0


@dataclass(frozen=True, slots=True)
class NamedCause:
    """A diagnosed cause: axis, effect, and the effects that cannot be distinguished from it."""

    axis: str
    effect: str
    probability: float
    ambiguous_with: tuple[str, ...]

    @property
    def possible_effects(self) -> set[str]:
        """The effect, and those that cannot be distinguished from it."""
        return {self.effect, *self.ambiguous_with}


@dataclass(frozen=True, slots=True)
class BenchResult:
    """The diagnosis of a machine; ``not_run`` is the reason if there is none.

    ``residual_before`` and ``residual_after`` are the residuals of the original and the corrected
    model on the test records. ``answer`` is the diagnosis in one line, and ``processor_s`` the time
    that processors worked on it.
    """

    machine: BenchMachine
    title: str = ""
    verdict: str = ""
    causes: tuple[NamedCause, ...] = ()
    residual_before: ModelResidual | None = None
    residual_after: ModelResidual | None = None
    seconds: float = 0.0
    unit: str = ""
    not_run: str = ""
    answer: str = "not run"
    processor_s: float = 0.0

    @property
    def is_relative(self) -> bool:
        """Whether the errors are relative; otherwise they are in SI units."""
        return self.machine.truth is not None and self.machine.truth.is_relative

    @property
    def is_first_cause_known(self) -> bool | None:
        """Whether the first cause is a known one; None if no causes are known."""
        truth = self.machine.truth
        if truth is None or not truth.causes:
            return None
        correct_effects = {effect for effects in truth.causes for effect in effects} | set(
            truth.optional_effects
        )
        return bool(self.causes) and self.causes[0].effect in correct_effects

    @property
    def missed_causes(self) -> list[tuple[str, ...]]:
        """The known causes that are neither named nor in a small enough set."""
        truth = self.machine.truth
        known = truth.causes if truth is not None else ()
        return [
            effects
            for effects in known
            if not any(_has_named(cause, effects) for cause in self.causes)
        ]

    @property
    def corrected_error(self) -> float | None:
        """Error of the corrected model, relative or in SI units like ``to_beat``."""
        return self._choose_error(self.residual_after)

    @property
    def initial_error(self) -> float | None:
        """Error of the original model, in the same unit."""
        return self._choose_error(self.residual_before)

    def _choose_error(self, residual: ModelResidual | None) -> float | None:
        if residual is None:
            return None
        return residual.relative if self.is_relative else residual.gap

    @property
    def to_beat(self) -> float | None:
        """Error of a plain fit, if it is known."""
        return self.machine.truth.to_beat if self.machine.truth is not None else None

    @property
    def closed_share(self) -> float | None:
        """The share of the gap's power above the floor that the correction removes, 0 to 1."""
        if self.residual_before is None or self.residual_after is None:
            return None
        gap = self.residual_before.gap**2 - self.residual_before.floor**2
        if gap <= 0.0:
            return None
        return float(
            np.clip(
                1.0 - (self.residual_after.gap**2 - self.residual_after.floor**2) / gap, 0.0, 1.0
            )
        )

    @property
    def unmet_requirements(self) -> list[str]:
        """The requirements that are not met, as text."""
        return list(self._list_unmet_requirements())

    def _list_unmet_requirements(self) -> Iterator[str]:
        if self.not_run:
            yield f"not run: {self.not_run}"
            return
        if self.is_first_cause_known is False:
            first = self.causes[0].effect if self.causes else "none"
            yield f"the first cause is {first}, which is not a known cause"
        for effects in self.missed_causes:
            yield f"{' or '.join(effects)} is not named"
        if self.corrected_error is not None and self.to_beat is not None:
            ratio = self.corrected_error / self.to_beat
            if ratio > MAX_RATIO_TO_BEST_FIT:
                yield f"it leaves {ratio:.3g} × the figure to beat"
        if (
            self.initial_error is not None
            and self.corrected_error is not None
            and self.corrected_error > self.initial_error
        ):
            yield "the corrected model is worse than the original one"
        if self.seconds > MAX_DIAGNOSIS_S:
            yield f"the diagnosis takes {self.seconds:.0f} s, more than {MAX_DIAGNOSIS_S:.0f} s"

    def as_json(self) -> dict[str, Any]:
        """Return the result as JSON."""
        truth = self.machine.truth
        return {
            "machine": self.machine.name,
            "title": self.title,
            "not_run": self.not_run or None,
            "verdict": self.verdict or None,
            "causes": [asdict(cause) for cause in self.causes],
            "known": [list(effects) for effects in truth.causes] if truth is not None else None,
            "first_is_right": self.is_first_cause_known if not self.not_run else None,
            "missed": [list(effects) for effects in self.missed_causes]
            if not self.not_run
            else None,
            "tap": str(truth.tap) if truth is not None else "meas",
            "relative": self.is_relative,
            "unit": "" if self.is_relative else self.unit,
            "raw": self.initial_error,
            "left": self.corrected_error,
            "to_beat": self.to_beat,
            "closed": self.closed_share,
            "seconds": round(self.seconds, 1),
            "processor_s": round(self.processor_s, 1),
            "not_reached": self.unmet_requirements,
        }


def _has_named(cause: NamedCause, known: tuple[str, ...]) -> bool:
    """Whether a diagnosed cause covers a known one.

    All its possible effects must be in the known set, or its set must be small and contain an
    effect of the known set.
    """
    possible = cause.possible_effects
    if cause.effect in known and possible <= set(known):
        return True
    return bool(possible & set(known)) and len(possible) <= MAX_AMBIGUITY_SET_SIZE
