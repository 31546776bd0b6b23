"""A check of the driver contract, and its result."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.findings import CheckNotApplicable, RequirementNotMet
from rotemina.drivers.contract import Driver
from rotemina.sim.compatibility import FormerMember, serve_former_names


class CheckVerdict(StrEnum):
    """Outcome of a check."""

    PASSED = "passed"
    FAILED = "failed"
    SKIPPED = "skipped"


@dataclass(frozen=True, slots=True)
class DriverCheckResult:
    """Result of one check.

    ``note`` states the actual and the expected behaviour, or why the check was skipped.
    """

    name: str
    requirement: str
    verdict: CheckVerdict
    note: str = ""


@dataclass(frozen=True, slots=True)
class DriverCheck:
    """A check of one requirement of the contract.

    Attributes
    ----------
    name : str
    requirement : str
        The requirement, in a sentence.
    needs : type or None
        Ability that the driver must have. Without it the check is skipped.
    moves : bool
        Whether axes move.
    hooks : tuple of str
        Fields of :class:`DriverBench` that must be set. Without them the check is skipped.
    body : callable
        Runs the check on a bench; raises :class:`RequirementNotMet` on failure.
    """

    name: str
    requirement: str
    needs: type[Driver] | None
    moves: bool
    hooks: tuple[str, ...]
    body: Callable[[DriverBench], None]

    def run(self, bench: DriverBench) -> DriverCheckResult:
        """Run the check on the bench's driver; every exception becomes a result."""
        try:
            reason = self._find_skip_reason(bench)
            if reason:
                return self._make_result(CheckVerdict.SKIPPED, reason)
            self.body(bench)
        except CheckNotApplicable as inapplicable:
            return self._make_result(CheckVerdict.SKIPPED, str(inapplicable))
        except RequirementNotMet as failure:
            return self._make_result(CheckVerdict.FAILED, str(failure))
        # A driver under test may raise any exception.
        except Exception as error:
            return self._make_result(
                CheckVerdict.FAILED, f"it raised {type(error).__name__}: {error}"
            )
        return self._make_result(CheckVerdict.PASSED, "")

    def _find_skip_reason(self, bench: DriverBench) -> str:
        if self.needs is not None and not isinstance(bench.make({}), self.needs):
            return f"it is no {self.needs.__name__}"
        missing = [hook for hook in self.hooks if getattr(bench, hook) is None]
        return f"this bench cannot {missing[0].replace('_', ' ')}" if missing else ""

    def _make_result(self, verdict: CheckVerdict, note: str) -> DriverCheckResult:
        return DriverCheckResult(self.name, self.requirement, verdict, note)


def check(
    *, needs: type[Driver] | None = None, moves: bool = True, hooks: tuple[str, ...] = ()
) -> Callable[[Callable[[DriverBench], None]], DriverCheck]:
    """Make a decorator that turns a function into a check.

    The function's name becomes the name of the check, and its docstring becomes the requirement.
    """

    def decorate(body: Callable[[DriverBench], None]) -> DriverCheck:
        requirement = " ".join((body.__doc__ or "").split())
        return DriverCheck(body.__name__.replace("_", "-"), requirement, needs, moves, hooks, body)

    return decorate


if not TYPE_CHECKING:
    DriverCheck.demand = FormerMember("requirement")
    DriverCheckResult.demand = FormerMember("requirement")
    __getattr__ = serve_former_names(
        __name__,
        Check="DriverCheck",
        Result="DriverCheckResult",
        Verdict="CheckVerdict",
    )
