"""Checks of plugins other than drivers and effects: their demands and findings."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from typing import TypeVar

from rotemina.drivers.conformance.check import Result, Verdict
from rotemina.drivers.conformance.findings import Inapplicable, Unmet

Bench = TypeVar("Bench")


def results(
    demands: Sequence[Callable[[Bench], None]],
    bench: Callable[[], AbstractContextManager[Bench]],
) -> tuple[Result, ...]:
    """Put what is checked to each demand, on a bench of its own.

    A demand is a function, named and described by its name and docstring, that raises
    :class:`Unmet` where it is not met and :class:`Inapplicable` where it makes no sense. Whatever
    else the plugin raises is a failure.
    """
    return tuple(_result(demand, bench) for demand in demands)


def _result(
    demand: Callable[[Bench], None], bench: Callable[[], AbstractContextManager[Bench]]
) -> Result:
    name = demand.__name__.replace("_", "-")
    text = " ".join((demand.__doc__ or "").split())
    try:
        with bench() as made:
            demand(made)
    except Inapplicable as reason:
        return Result(name, text, Verdict.SKIPPED, str(reason))
    except Unmet as found:
        return Result(name, text, Verdict.FAILED, str(found))
    except (Exception, SystemExit) as error:  # a plugin under test may raise anything
        return Result(name, text, Verdict.FAILED, f"it raised {type(error).__name__}: {error}")
    return Result(name, text, Verdict.PASSED)
