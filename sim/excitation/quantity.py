"""Amounts as typed by users: ``200urad``, ``5 um``, ``1 mm/s`` or ``30%`` of an axis."""

import re
from dataclasses import dataclass
from math import isfinite

from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.units import UnitError, from_unit, quantity

_AMOUNT = re.compile(
    r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\s\d/]*)(/s3|/s³|/s)?\s*"
)


class ExcitationError(InputError):
    """An excitation that makes no sense, or that the machine's limits do not allow as asked."""


@dataclass(frozen=True, slots=True)
class Share:
    """A share of an axis' capability: ``Share(0.3)`` is 30 % of its range, or of its top speed."""

    of_whole: float


Amount = float | Share


@dataclass(frozen=True, slots=True)
class Stated:
    """A number with its SI unit, as it was read: ``5um`` is ``Stated(5e-6, "m")``."""

    value: float
    unit: str


def parse_amount(text: str) -> Stated | Share:
    """Read an amount with its unit; ``1 mm/s`` is ``Stated(1e-3, "m/s")``.

    Raises
    ------
    ExcitationError
        If it is no number, has no unit or one that does not exist.
    """
    match = _AMOUNT.fullmatch(text)
    if match is None:
        raise ExcitationError(
            message(
                "engine", "{text} is not an amount; enter one such as 200urad, 5um or 30%"
            ).fill(text=repr(text[:40]))
        )
    number, unit, per = float(match[1]), match[2], (match[3] or "").replace("³", "3")
    if not isfinite(number):
        raise ExcitationError(
            message("engine", "{text} is not a finite number").fill(text=repr(text[:40]))
        )
    if unit == "%" and not per:
        return Share(number / 100.0)
    if not unit:
        raise ExcitationError(
            message("engine", "{text} has no unit; write it like 200urad, 5um or 30%").fill(
                text=repr(text[:40])
            )
        )
    try:
        return Stated(float(from_unit(number, unit)), quantity(unit) + per)
    except UnitError as error:
        raise ExcitationError(
            message("engine", "{text}: {error}").fill(text=repr(text[:40]), error=str(error))
        ) from error


def amount_of(text: str, axis: str, unit: str) -> Amount:
    """Read an amount for an axis whose own unit is ``unit``: SI value or share.

    Raises
    ------
    ExcitationError
        As :func:`parse_amount`, or if the unit is not of the axis' quantity.
    """
    amount = parse_amount(text)
    if isinstance(amount, Share):
        return amount
    if amount.unit != unit:
        raise ExcitationError(
            message("engine", "axis {axis}: {text} is in {unit}, not in {wanted}").fill(
                axis=axis, text=repr(text[:40]), unit=amount.unit, wanted=unit
            )
        )
    return amount.value


def check_positive(**values: float | None) -> None:
    """Refuse a stated value that is not finite and above zero; None stands for a default.

    Raises
    ------
    ExcitationError
        Naming the parameter, its value and the bound.
    """
    for name, value in values.items():
        if value is not None and not (isfinite(value) and value > 0):
            raise ExcitationError(
                message("engine", "{name} = {value}: must be a finite number above 0").fill(
                    name=name, value=rounded(value, 6)
                )
            )


def check_count(least: int, most: int, **values: int | None) -> None:
    """Refuse a stated count outside ``least`` to ``most``.

    Raises
    ------
    ExcitationError
        Naming the parameter, its value and the bounds.
    """
    for name, value in values.items():
        if value is not None and not least <= value <= most:
            raise ExcitationError(
                message("engine", "{name} = {value}: must lie between {least} and {most}").fill(
                    name=name, value=value, least=least, most=most
                )
            )
