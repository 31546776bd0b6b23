"""Units of files and screens, and their conversion to and from SI.

Every factor is kept as "units per SI unit", a number that float64 holds exactly for the decimal
units: a value becomes SI by one division, which is rounded once, so ``581.7 um`` becomes the
float64 nearest to 581.7e-6 m. Multiplying by 1e-6 would round twice. There and back again a value
moves by 2 ulp at most, and an SI unit leaves it as it is, bit by bit.
"""

from math import pi
from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError

_PER_SI = MappingProxyType(
    {
        "m": MappingProxyType({"m": 1.0, "mm": 1e3, "um": 1e6, "nm": 1e9}),
        "rad": MappingProxyType(
            {
                "rad": 1.0,
                "mrad": 1e3,
                "urad": 1e6,
                "arcsec": 648000.0 / pi,
                "deg": 180.0 / pi,
            }
        ),
        "V": MappingProxyType({"V": 1.0}),
        "s": MappingProxyType({"s": 1.0, "ms": 1e3, "us": 1e6}),
    }
)
_QUANTITIES = {unit: si for si, table in _PER_SI.items() for unit in table}
_MICRO_SIGNS = ("\N{MICRO SIGN}", "\N{GREEK SMALL LETTER MU}")


class UnitError(InputError):
    """A unit that does not exist, or that is of the wrong kind."""


def canonical(unit: str) -> str:
    """Return a unit as files spell it: ``"µm"``, with either sign for micro, is ``"um"``.

    Raises
    ------
    UnitError
        If there is no such unit.
    """
    plain = unit
    for sign in _MICRO_SIGNS:
        plain = plain.replace(sign, "u")
    if plain not in _QUANTITIES:
        known = " · ".join(" ".join(table) for table in _PER_SI.values())
        from rotemina.sim.messages import message  # it knows the units itself

        raise UnitError(
            message("engine", "unknown unit {unit}; use one of {known}").fill(
                unit=repr(unit[:20]), known=known
            )
        )
    return plain


def symbol(unit: str) -> str:
    """Return a unit as screens show it: ``"um"`` is ``"µm"``."""
    plain = canonical(unit)
    return _MICRO_SIGNS[0] + plain[1:] if plain.startswith("u") else plain


def quantity(unit: str) -> str:
    """Return the SI unit of a unit's quantity: ``"m"``, ``"rad"``, ``"V"`` or ``"s"``."""
    return _QUANTITIES[canonical(unit)]


def units_of(si_unit: str) -> tuple[str, ...]:
    """Return the units of a quantity, the SI unit first: what a menu offers.

    Raises
    ------
    UnitError
        If ``si_unit`` is not ``"m"``, ``"rad"``, ``"V"`` or ``"s"``.
    """
    if si_unit not in _PER_SI:
        from rotemina.sim.messages import message

        raise UnitError(
            message("engine", "{si_unit} is no SI unit of a record; use one of {names}").fill(
                si_unit=repr(si_unit), names=" ".join(_PER_SI)
            )
        )
    return tuple(_PER_SI[si_unit])


def per_si(unit: str) -> float:
    """Return how many of a unit make one SI unit: 1e6 for ``"um"``."""
    return _PER_SI[quantity(unit)][canonical(unit)]


def from_unit(values: FloatArray | float, unit: str) -> FloatArray:
    """Convert values of any shape from a unit to SI."""
    return np.asarray(np.true_divide(values, per_si(unit)), dtype=np.float64)


def to_unit(values: FloatArray | float, unit: str) -> FloatArray:
    """Convert values of any shape from SI to a unit."""
    return np.asarray(np.multiply(values, per_si(unit)), dtype=np.float64)
