"""Amounts as users type them: ``200urad``, ``5 um``, ``1 mm/s`` or ``30%`` of an axis."""

import re
from dataclasses import dataclass
from math import isfinite

from rotemina.sim.errors import ExcitationRequestError, UnitError
from rotemina.sim.messages import format_rounded
from rotemina.sim.units import from_unit, si_unit_of

_AMOUNT_PATTERN = re.compile(
    r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\s\d/]*)(/s3|/s³|/s)?\s*"
)


@dataclass(frozen=True, slots=True)
class CapabilityShare:
    """A fraction of the range or top speed of an axis: ``CapabilityShare(0.3)`` is 30 %."""

    of_whole: float


Amount = float | CapabilityShare


@dataclass(frozen=True, slots=True)
class StatedAmount:
    """A number with its SI unit: ``5um`` is read as ``StatedAmount(5e-6, "m")``."""

    value: float
    unit: str


def parse_amount(text: str) -> StatedAmount | CapabilityShare:
    """Read an amount with its unit; ``1 mm/s`` is ``StatedAmount(1e-3, "m/s")``.

    Raises
    ------
    ExcitationRequestError
        If the text is not a finite number, or its unit is missing or unknown.
    """
    match = _AMOUNT_PATTERN.fullmatch(text)
    if match is None:
        raise ExcitationRequestError(
            "{text} is not an amount; enter one such as 200urad, 5um or 30%", text=repr(text[:40])
        )
    number, unit, per_time = float(match[1]), match[2], (match[3] or "").replace("³", "3")
    if not isfinite(number):
        raise ExcitationRequestError("{text} is not a finite number", text=repr(text[:40]))
    if unit == "%" and not per_time:
        return CapabilityShare(number / 100.0)
    if not unit:
        raise ExcitationRequestError(
            "{text} has no unit; write it like 200urad, 5um or 30%", text=repr(text[:40])
        )
    try:
        return StatedAmount(float(from_unit(number, unit)), si_unit_of(unit) + per_time)
    except UnitError as error:
        raise ExcitationRequestError(
            "{text}: {error}", text=repr(text[:40]), error=str(error)
        ) from error


def parse_axis_amount(text: str, axis: str, unit: str) -> Amount:
    """Read an amount for an axis with the SI unit ``unit``; return an SI value or a fraction.

    Raises
    ------
    ExcitationRequestError
        As in :func:`parse_amount`, or if the unit does not match that of the axis.
    """
    amount = parse_amount(text)
    if isinstance(amount, CapabilityShare):
        return amount
    if amount.unit != unit:
        raise ExcitationRequestError(
            "axis {axis}: {text} is in {unit}, not in {wanted}",
            axis=axis,
            text=repr(text[:40]),
            unit=amount.unit,
            wanted=unit,
        )
    return amount.value


def check_positive(**values: float | None) -> None:
    """Raise an error if a value is not finite and above zero; None is accepted as a default.

    Raises
    ------
    ExcitationRequestError
        If a value is invalid. The message names the parameter, its value and the bound.
    """
    for name, value in values.items():
        if value is not None and not (isfinite(value) and value > 0):
            raise ExcitationRequestError(
                "{name} = {value}: must be a finite number above 0",
                name=name,
                value=format_rounded(value, 6),
            )


def check_count(min_count: int, max_count: int, **values: int | None) -> None:
    """Raise an error if a count is out of bounds; None is accepted as a default.

    Raises
    ------
    ExcitationRequestError
        If a count is invalid. The message names the parameter, its value and the bounds.
    """
    for name, value in values.items():
        if value is not None and not min_count <= value <= max_count:
            raise ExcitationRequestError(
                "{name} = {value}: must lie between {least} and {most}",
                name=name,
                value=value,
                least=min_count,
                most=max_count,
            )
