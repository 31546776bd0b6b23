"""What a check of an effect finds: one measured value against its bound, and all of them."""

from dataclasses import dataclass
from math import inf, isfinite


@dataclass(frozen=True, slots=True)
class Check:
    """One thing that was checked.

    Attributes
    ----------
    name : str
    passed : bool or None
        None: it does not apply here.
    value, bound : float
        What was measured, and what it must not exceed; nan where there is nothing to measure.
    note : str
        What is wrong, or why it does not apply.
    formulation, place : str
        Which formulation on which axis; empty where neither matters.
    """

    name: str
    passed: bool | None
    value: float = float("nan")
    bound: float = float("nan")
    note: str = ""
    formulation: str = ""
    place: str = ""


@dataclass(frozen=True, slots=True)
class Report:
    """All checks of one effect."""

    effect_id: str
    checks: tuple[Check, ...]

    @property
    def passed(self) -> bool:
        """Whether nothing failed and something was checked."""
        return not self.failures and any(check.passed for check in self.checks)

    @property
    def simulated(self) -> bool:
        """Whether any formulation found an axis to be simulated on."""
        return any(check.place and check.passed is not None for check in self.checks)

    @property
    def failures(self) -> tuple[Check, ...]:
        """The checks that failed."""
        return tuple(check for check in self.checks if check.passed is False)


def measured(name: str, value: float, bound: float, note: str = "") -> Check:
    """Return the check that a value does not exceed its bound."""
    passed = isfinite(value) and value <= bound
    return Check(name, passed, value, bound, "" if passed else note)


def exceeds(name: str, value: float, bound: float, note: str) -> Check:
    """Return the check that a value is above a bound."""
    passed = isfinite(value) and value > bound
    return Check(name, passed, value, bound, "" if passed else note)


def stated(name: str, faults: list[str]) -> Check:
    """Return the check that there are no faults, each said in words."""
    return Check(name, not faults, float(len(faults)), 0.0, "; ".join(faults))


def left_out(name: str, why: str) -> Check:
    """Return a check that does not apply."""
    return Check(name, None, bound=inf, note=why)
