"""A check of the contract, its findings, and its failure messages."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.findings import Inapplicable, Unmet
from rotemina.drivers.driver import Driver


class Verdict(StrEnum):
    """The verdict of a check."""

    PASSED = "passed"
    FAILED = "failed"
    SKIPPED = "skipped"


@dataclass(frozen=True, slots=True)
class Result:
    """What one check found; ``note`` says what was seen and expected, or why it was skipped."""

    name: str
    demand: str
    verdict: Verdict
    note: str = ""


@dataclass(frozen=True, slots=True)
class Check:
    """One demand of the contract.

    Attributes
    ----------
    name : str
    demand : str
        What it demands, in a sentence.
    needs : type or None
        The ability without which it does not apply.
    moves : bool
        Whether axes move.
    hooks : tuple of str
        What the bench must be able to do for it.
    body : callable
        Puts a driver on the bench; raises :class:`Unmet` where the demand is not met.
    """

    name: str
    demand: str
    needs: type[Driver] | None
    moves: bool
    hooks: tuple[str, ...]
    body: Callable[[Bench], None]

    def run(self, bench: Bench) -> Result:
        """Put the bench's driver to it; whatever the driver raises becomes a result."""
        try:
            why = self._why_not(bench)
            if why:
                return self._result(Verdict.SKIPPED, why)
            self.body(bench)
        except Inapplicable as reason:
            return self._result(Verdict.SKIPPED, str(reason))
        except Unmet as found:
            return self._result(Verdict.FAILED, str(found))
        except Exception as error:  # a driver under test may raise anything
            return self._result(Verdict.FAILED, f"it raised {type(error).__name__}: {error}")
        return self._result(Verdict.PASSED, "")

    def _why_not(self, bench: Bench) -> str:
        if self.needs is not None and not isinstance(bench.make({}), self.needs):
            return f"it is no {self.needs.__name__}"
        lacking = [hook for hook in self.hooks if getattr(bench, hook) is None]
        return f"this bench cannot {lacking[0].replace('_', ' ')}" if lacking else ""

    def _result(self, verdict: Verdict, note: str) -> Result:
        return Result(self.name, self.demand, verdict, note)


def check(
    *, needs: type[Driver] | None = None, moves: bool = True, hooks: tuple[str, ...] = ()
) -> Callable[[Callable[[Bench], None]], Check]:
    """Make a check of a function: its name is the check's, its docstring what it demands."""

    def made(body: Callable[[Bench], None]) -> Check:
        demand = " ".join((body.__doc__ or "").split())
        return Check(body.__name__.replace("_", "-"), demand, needs, moves, hooks, body)

    return made
