"""Table of the units and of their symbols on screens.

Every factor is stored as "units per SI unit". For the decimal units, float64 holds this number
exactly.
"""

from math import pi
from types import MappingProxyType

PER_SI = MappingProxyType(
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
SI_UNIT = MappingProxyType({unit: si for si, table in PER_SI.items() for unit in table})
_MICRO_SIGNS = ("\N{MICRO SIGN}", "\N{GREEK SMALL LETTER MU}")


def normalize_unit(unit: str) -> str:
    """Return a unit as files spell it: ``"µm"``, with either Unicode micro sign, is ``"um"``."""
    for sign in _MICRO_SIGNS:
        unit = unit.replace(sign, "u")
    return unit


def get_units_per_si(unit: str) -> float:
    """Return the number of units per SI unit: 1e6 for ``"um"``."""
    return PER_SI[SI_UNIT[unit]][unit]


def symbol_of(unit: str) -> str:
    """Return the symbol of a unit of the table on screens: ``"µm"`` for ``"um"``."""
    return _MICRO_SIGNS[0] + unit[1:] if unit.startswith("u") else unit
