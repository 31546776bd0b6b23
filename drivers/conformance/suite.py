"""All checks of the driver contract, in the order in which they run and are reported."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from rotemina.drivers.conformance import (
    captures,
    first_contact,
    links,
    moves,
    opening,
    playing,
    sampling,
    service_checks,
    speeds,
)
from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import CheckVerdict, DriverCheck, DriverCheckResult
from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.errors import InputError

_CHECK_MODULES = (
    opening,
    sampling,
    moves,
    speeds,
    playing,
    service_checks,
    captures,
    links,
    first_contact,
)
CHECKS = tuple(
    member
    for module in _CHECK_MODULES
    for member in vars(module).values()
    if isinstance(member, DriverCheck)
)


def find_checks(names: Sequence[str]) -> tuple[DriverCheck, ...]:
    """Return the checks with these names, in their usual order; all checks if there are no names.

    Raises
    ------
    InputError
        If there is no check with one of the names.
    """
    existing = [check.name for check in CHECKS]
    for name in names:
        if name not in existing:
            raise InputError(f"there is no check {name!r}; there are {', '.join(existing)}")
    return tuple(check for check in CHECKS if not names or check.name in names)


def run_checks(
    bench: DriverBench, checks: Sequence[DriverCheck] = CHECKS, *, may_move: bool = True
) -> Iterator[DriverCheckResult]:
    """Run checks, each with a new driver from the bench; yield their results.

    Checks that move axes are skipped unless ``may_move`` is true.
    """
    for check in checks:
        if check.moves and not may_move:
            yield DriverCheckResult(
                check.name, check.requirement, CheckVerdict.SKIPPED, "it moves axes"
            )
        else:
            yield check.run(bench)


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        checks_named="find_checks",
    )
