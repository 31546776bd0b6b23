"""Requirements of checks. Each function raises if a driver does not meet its requirement."""

from collections.abc import Callable

from rotemina.drivers.contract import DriverError
from rotemina.sim.errors import InputError
from rotemina.sim.units import format_exact


class RequirementNotMet(AssertionError):  # noqa: N818 - it is a finding about a driver, not an error in the check
    """The driver does not meet a requirement. The message states actual and expected behaviour."""


class CheckNotApplicable(Exception):  # noqa: N818 - it is not an error either
    """The requirement does not apply to this driver or robot; the message says why."""


def require_that(is_met: bool, actual: str, expected: str) -> None:
    """Raise :class:`RequirementNotMet` unless a requirement is met."""
    if not is_met:
        raise RequirementNotMet(f"{actual}; expected: {expected}")


def require_within(
    finding: str, actual: float, expected: float, tolerance: float, unit: str
) -> None:
    """Raise :class:`RequirementNotMet` unless a value is within the tolerance.

    The values are in ``unit``. In the message ``finding`` precedes the actual value.
    """
    require_that(
        abs(actual - expected) <= tolerance,
        f"{finding} {format_exact(actual, unit)}",
        f"{format_exact(expected, unit)} ± {format_exact(tolerance, unit)}",
    )


def require_at_most(finding: str, actual: float, bound: float, unit: str) -> None:
    """Raise :class:`RequirementNotMet` if a value is greater than a bound.

    The values are in ``unit``. In the message ``finding`` precedes the actual value.
    """
    require_that(
        actual <= bound,
        f"{finding} {format_exact(actual, unit)}",
        f"at most {format_exact(bound, unit)}",
    )


def require_refusal(
    request: str, call: Callable[[], object], error: type[Exception] | tuple[type[Exception], ...]
) -> None:
    """Raise :class:`RequirementNotMet` unless a call raises one of these errors.

    In the message ``request`` describes the call.
    """
    error_types = error if isinstance(error, tuple) else (error,)
    expected = " or ".join(error_type.__name__ for error_type in error_types)
    try:
        call()
    except error_types:
        return
    except (DriverError, InputError) as other:
        raise RequirementNotMet(
            f"{request}: {type(other).__name__} ({other}); expected: {expected}"
        ) from other
    raise RequirementNotMet(f"{request} was accepted; expected: {expected}")
