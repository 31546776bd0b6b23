"""Units of files and screens, and their conversion to and from SI.

A value is converted to SI by one division, which rounds once, so ``581.7 um`` becomes the float64
nearest to 581.7e-6 m. Multiplying by 1e-6 would round twice. A conversion to SI and back changes a
value by 2 ulp at most; with an SI unit it changes no bit.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import UnitError
from rotemina.sim.units.unit_table import (
    PER_SI,
    SI_UNIT,
    get_units_per_si,
    normalize_unit,
    symbol_of,
)


def parse_unit(unit: str) -> str:
    """Return a unit as files spell it: ``"µm"``, with either Unicode micro sign, is ``"um"``.

    Raises
    ------
    UnitError
        If there is no such unit.
    """
    plain = normalize_unit(unit)
    if plain not in SI_UNIT:
        known_units = " · ".join(" ".join(table) for table in PER_SI.values())
        raise UnitError(
            "unknown unit {unit}; use one of {known}", unit=repr(unit[:20]), known=known_units
        )
    return plain


def display_symbol_of(unit: str) -> str:
    """Return the symbol of a unit on screens: ``"µm"`` for ``"um"``."""
    return symbol_of(parse_unit(unit))


def si_unit_of(unit: str) -> str:
    """Return the SI unit of a unit's quantity: ``"m"``, ``"rad"``, ``"V"`` or ``"s"``."""
    return SI_UNIT[parse_unit(unit)]


def units_of(si_unit: str) -> tuple[str, ...]:
    """Return the units of a quantity for a menu, the SI unit first.

    Raises
    ------
    UnitError
        If ``si_unit`` is not ``"m"``, ``"rad"``, ``"V"`` or ``"s"``.
    """
    if si_unit not in PER_SI:
        raise UnitError(
            "{si_unit} is not an SI unit of a record; use one of {names}",
            si_unit=repr(si_unit),
            names=" ".join(PER_SI),
        )
    return tuple(PER_SI[si_unit])


def per_si(unit: str) -> float:
    """Return the number of units per SI unit: 1e6 for ``"um"``."""
    return get_units_per_si(parse_unit(unit))


def from_unit(values: FloatArray | float, unit: str) -> FloatArray:
    """Convert values of any shape from a unit to SI."""
    return np.asarray(np.true_divide(values, per_si(unit)), dtype=np.float64)


def to_unit(values: FloatArray | float, unit: str) -> FloatArray:
    """Convert values of any shape from SI to a unit."""
    return np.asarray(np.multiply(values, per_si(unit)), dtype=np.float64)
