"""Units of files and screens, and their conversion to and from SI.

A value becomes SI by one division, which is rounded once, so ``581.7 um`` becomes the float64
nearest to 581.7e-6 m. Multiplying by 1e-6 would round twice. There and back again a value moves by
2 ulp at most, and an SI unit leaves it as it is, bit by bit.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.unit_table import PER_SI, SI_UNIT, factor_of, spelled, symbol_of


class UnitError(InputError):
    """A unit that does not exist, or that is of the wrong kind."""


def canonical(unit: str) -> str:
    """Return a unit as files spell it: ``"µm"``, with either sign for micro, is ``"um"``.

    Raises
    ------
    UnitError
        If there is no such unit.
    """
    plain = spelled(unit)
    if plain not in SI_UNIT:
        known = " · ".join(" ".join(table) for table in PER_SI.values())
        raise UnitError(
            message("engine", "unknown unit {unit}; use one of {known}").fill(
                unit=repr(unit[:20]), known=known
            )
        )
    return plain


def symbol(unit: str) -> str:
    """Return a unit as screens show it: ``"um"`` is ``"µm"``."""
    return symbol_of(canonical(unit))


def quantity(unit: str) -> str:
    """Return the SI unit of a unit's quantity: ``"m"``, ``"rad"``, ``"V"`` or ``"s"``."""
    return SI_UNIT[canonical(unit)]


def units_of(si_unit: str) -> tuple[str, ...]:
    """Return the units of a quantity, the SI unit first: what a menu offers.

    Raises
    ------
    UnitError
        If ``si_unit`` is not ``"m"``, ``"rad"``, ``"V"`` or ``"s"``.
    """
    if si_unit not in PER_SI:
        raise UnitError(
            message("engine", "{si_unit} is not an SI unit of a record; use one of {names}").fill(
                si_unit=repr(si_unit), names=" ".join(PER_SI)
            )
        )
    return tuple(PER_SI[si_unit])


def per_si(unit: str) -> float:
    """Return how many of a unit make one SI unit: 1e6 for ``"um"``."""
    return factor_of(canonical(unit))


def from_unit(values: FloatArray | float, unit: str) -> FloatArray:
    """Convert values of any shape from a unit to SI."""
    return np.asarray(np.true_divide(values, per_si(unit)), dtype=np.float64)


def to_unit(values: FloatArray | float, unit: str) -> FloatArray:
    """Convert values of any shape from SI to a unit."""
    return np.asarray(np.multiply(values, per_si(unit)), dtype=np.float64)
