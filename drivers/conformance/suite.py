"""All checks of the contract, in the order of the report: that in which the modules have them."""

from collections.abc import Iterator, Sequence

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
from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import Check, Result, Verdict
from rotemina.sim.errors import InputError

_MODULES = (
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
    each for module in _MODULES for each in vars(module).values() if isinstance(each, Check)
)


def checks_named(names: Sequence[str]) -> tuple[Check, ...]:
    """Return the checks of these names, in their usual order; all of them for none.

    Raises
    ------
    InputError
        If there is no check of a name.
    """
    known = [check.name for check in CHECKS]
    for name in names:
        if name not in known:
            raise InputError(f"there is no check {name!r}; there are {', '.join(known)}")
    return tuple(check for check in CHECKS if not names or check.name in names)


def run_checks(
    bench: Bench, checks: Sequence[Check] = CHECKS, *, may_move: bool = True
) -> Iterator[Result]:
    """Put a bench's driver to checks, each with a driver of its own; yield what each found.

    Those that move axes are skipped unless these ``may_move``.
    """
    for check in checks:
        if check.moves and not may_move:
            yield Result(check.name, check.demand, Verdict.SKIPPED, "it moves axes")
        else:
            yield check.run(bench)
