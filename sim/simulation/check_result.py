"""Results of the checks of an effect: of one check, and of all checks."""

from dataclasses import dataclass
from math import inf, isfinite


@dataclass(frozen=True, slots=True)
class CheckResult:
    """Result of one check.

    Attributes
    ----------
    name : str
    passed : bool or None
        None if the check does not apply.
    value, bound : float
        Measured value and its bound; nan if nothing is measured.
    note : str
        The fault, or the reason why the check does not apply.
    formulation, place : str
        Which formulation on which axis; empty if neither matters.
    """

    name: str
    passed: bool | None
    value: float = float("nan")
    bound: float = float("nan")
    note: str = ""
    formulation: str = ""
    place: str = ""


@dataclass(frozen=True, slots=True)
class EffectReport:
    """Results of all checks of one effect."""

    effect_id: str
    checks: tuple[CheckResult, ...]

    @property
    def passed(self) -> bool:
        """Whether no check failed and at least one passed."""
        return not self.failures and any(check.passed for check in self.checks)

    @property
    def simulated(self) -> bool:
        """Whether any formulation was simulated on an axis."""
        return any(check.place and check.passed is not None for check in self.checks)

    @property
    def failures(self) -> tuple[CheckResult, ...]:
        """The checks that failed."""
        return tuple(check for check in self.checks if check.passed is False)


def check_at_most(name: str, value: float, bound: float, note: str = "") -> CheckResult:
    """Check that a value does not exceed its bound."""
    passed = isfinite(value) and value <= bound
    return CheckResult(name, passed, value, bound, "" if passed else note)


def check_above(name: str, value: float, bound: float, note: str) -> CheckResult:
    """Check that a value is above a bound."""
    passed = isfinite(value) and value > bound
    return CheckResult(name, passed, value, bound, "" if passed else note)


def check_no_faults(name: str, faults: list[str]) -> CheckResult:
    """Check that there are no faults, each described in words."""
    return CheckResult(name, not faults, float(len(faults)), 0.0, "; ".join(faults))


def skip_check(name: str, reason: str) -> CheckResult:
    """Return the result of a check that does not apply."""
    return CheckResult(name, None, bound=inf, note=reason)
