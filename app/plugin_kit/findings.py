"""Run the checks of plugins other than drivers and effects."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from typing import TypeVar

from rotemina.drivers.conformance import (
    CheckNotApplicable,
    CheckVerdict,
    DriverCheckResult,
    RequirementNotMet,
)

Bench = TypeVar("Bench")


def run_plugin_checks(
    checks: Sequence[Callable[[Bench], None]],
    bench: Callable[[], AbstractContextManager[Bench]],
) -> tuple[DriverCheckResult, ...]:
    """Run each check on a new bench.

    A check is a function. Its name becomes the name of the result, and its docstring the
    requirement. It raises :class:`RequirementNotMet` if the requirement is not met, and
    :class:`CheckNotApplicable` if it does not apply. Any other exception is a failure as well.
    """
    return tuple(_run_check(check, bench) for check in checks)


def _run_check(
    check: Callable[[Bench], None], bench: Callable[[], AbstractContextManager[Bench]]
) -> DriverCheckResult:
    name = check.__name__.replace("_", "-")
    requirement = " ".join((check.__doc__ or "").split())
    try:
        with bench() as open_bench:
            check(open_bench)
    except CheckNotApplicable as reason:
        return DriverCheckResult(name, requirement, CheckVerdict.SKIPPED, str(reason))
    except RequirementNotMet as failure:
        return DriverCheckResult(name, requirement, CheckVerdict.FAILED, str(failure))
    # A plugin under test may raise anything.
    except (Exception, SystemExit) as error:
        return DriverCheckResult(
            name, requirement, CheckVerdict.FAILED, f"it raised {type(error).__name__}: {error}"
        )
    return DriverCheckResult(name, requirement, CheckVerdict.PASSED)
