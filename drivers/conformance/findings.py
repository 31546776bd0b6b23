"""How a check ends early: a failed demand, or one that does not apply."""

from collections.abc import Callable

from rotemina.drivers.errors import DriverError
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import exact


class Unmet(AssertionError):  # noqa: N818 - a finding about a driver, not an error of the check
    """The driver did not do what was demanded; the message says what was seen and expected."""


class Inapplicable(Exception):  # noqa: N818 - no error either
    """The demand does not apply to this driver or robot; the message says why."""


def demand(met: bool, seen: str, expected: str) -> None:
    """Raise :class:`Unmet` unless a demand is met."""
    if not met:
        raise Unmet(f"{seen}; expected: {expected}")


def within(what: str, seen: float, expected: float, tolerance: float, unit: str) -> None:
    """Raise :class:`Unmet` unless a value is what it should be; all in ``unit``."""
    demand(
        abs(seen - expected) <= tolerance,
        f"{what} {exact(seen, unit)}",
        f"{exact(expected, unit)} ± {exact(tolerance, unit)}",
    )


def at_most(what: str, seen: float, bound: float, unit: str) -> None:
    """Raise :class:`Unmet` unless a value is no greater than a bound; both in ``unit``."""
    demand(seen <= bound, f"{what} {exact(seen, unit)}", f"at most {exact(bound, unit)}")


def refused(
    what: str, call: Callable[[], object], error: type[Exception] | tuple[type[Exception], ...]
) -> None:
    """Raise :class:`Unmet` unless a call is refused with this error."""
    kinds = error if isinstance(error, tuple) else (error,)
    wanted = " or ".join(kind.__name__ for kind in kinds)
    try:
        call()
    except kinds:
        return
    except (DriverError, InputError) as other:
        raise Unmet(f"{what}: {type(other).__name__} ({other}); expected: {wanted}") from other
    raise Unmet(f"{what} was accepted; expected: {wanted}")
