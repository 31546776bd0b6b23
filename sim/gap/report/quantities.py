"""Numbers as the report writes them, in units that suit their size."""

from collections.abc import Sequence
from math import isfinite
from typing import NamedTuple

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.units import drawing_unit, per_si, symbol

NOTHING = "–"  # in place of what is not known

_LEAST_SHARE = 1e-4  # that is told in digits
_TIMES = (("s", 0.1), ("ms", 1e-4), ("us", 0.0))  # least size, s, from which each reads well


class Scale(NamedTuple):
    """A unit as it is shown, and how many of it make one SI unit."""

    symbol: str
    per_si: float

    @classmethod
    def of(cls, unit: str, size: float) -> "Scale":
        """Choose the unit in which a value of this size (SI) reads best."""
        if unit == "s":
            shown = next(name for name, least in _TIMES if abs(size) >= least)
        elif unit in ("m", "rad"):
            shown = drawing_unit(unit, abs(size))
        else:
            return cls(unit, 1.0)  # a third party's may be any text
        return cls(symbol(shown), per_si(shown))

    def __call__(self, values: FloatArray) -> FloatArray:
        """Return values (SI) in this unit."""
        return values * self.per_si

    def text(self, value: float) -> str:
        """Return a value (SI) with this unit."""
        return f"{value * self.per_si:.4g} {self.symbol}".rstrip()


def unit_of(axis: str, tap: Tap, records: Sequence[Record]) -> str:
    """Return the SI unit of a tap, as the records have it."""
    if tap is Tap.U:
        return "V"
    return next((record.units[axis] for record in records if axis in record.axes), "")


def named_unit(unit: str, source_unit: str) -> str:
    """Return a parameter's unit with what it leaves open, that of the axis it comes from."""
    return "" if unit == f"{source_unit}/…" else unit.replace("…", source_unit or "…")


def amount(value: float | None, unit: str) -> str:
    """Return a value (SI) in the unit that suits it."""
    if value is None or not isfinite(value):
        return NOTHING
    return Scale.of(unit, value).text(value)


def amounts(interval: tuple[float, float] | None, unit: str) -> str:
    """Return an interval (SI), both ends in one unit."""
    if interval is None or not all(map(isfinite, interval)):
        return NOTHING
    scale = Scale.of(unit, max(abs(end) for end in interval))
    return " … ".join(scale.text(end) for end in interval)


def percent(share: float | None) -> str:
    """Return a share of 1 in per cent."""
    if share is None or not isfinite(share):
        return NOTHING
    if 0.0 < share < _LEAST_SHARE:
        return f"< {100.0 * _LEAST_SHARE:g} %"
    return f"{100.0 * share:.3g} %"


def percents(interval: tuple[float, float] | None) -> str:
    """Return an interval of shares in per cent."""
    return NOTHING if interval is None else " … ".join(percent(end) for end in interval)
