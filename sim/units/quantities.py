"""Quantities as readable text in the window, in reports and on the command line.

A quantity gets the unit prefix that keeps it between 1 and 1000. An exponent is used only where
there is no suitable prefix.
"""

from collections.abc import Iterable, Sequence
from math import isfinite
from typing import TYPE_CHECKING, NamedTuple

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.messages import (
    MIN_PLAIN_VALUE,
    NO_VALUE,
    NumberText,
    format_fixed,
    format_rounded,
)
from rotemina.sim.units.unit_table import PER_SI, get_units_per_si, normalize_unit, symbol_of

# A smaller share is written as "< 0.01 %".
_MIN_WRITTEN_SHARE = 1e-4
# A value below this number of shared units gets its own prefix.
_MIN_SHARED_UNIT_VALUE = 1e-2
# Units with the smallest size (SI) that each is used for, largest unit first.
_UNITS_BY_SIZE = {
    "m": (("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("nm", 0.0)),
    "rad": (("rad", 1.0), ("mrad", 1e-3), ("urad", 0.0)),
    "s": (("s", 1.0), ("ms", 1e-3), ("us", 0.0)),
}


class DisplayScale(NamedTuple):
    """A common unit for several values, so that they can be compared.

    Attributes
    ----------
    symbol : str
        The unit as it is shown on screens, such as ``µm``.
    per_si : float
        Number of units per SI unit.
    decimals : int or None
        Number of decimals of each value, if a sensor's resolution determines it.
    digits : int
        Number of significant digits of each value, if ``decimals`` is None.
    padded : bool
        Whether trailing zeros are kept, so that a live value does not change its width.
    quantity : str
        SI unit with whose prefixes a much smaller value is shown; if empty, the unit never changes.
    """

    symbol: str
    per_si: float = 1.0
    decimals: int | None = None
    digits: int = 4
    padded: bool = False
    quantity: str = ""

    def __call__(self, values: FloatArray) -> FloatArray:
        """Convert values of any shape from SI to this unit."""
        return values * self.per_si

    def format_value(self, value: float | None) -> NumberText:
        """Return the text of a value (SI) without its unit."""
        if value is None or not isfinite(value):
            return NO_VALUE
        number = float(value) * self.per_si
        if self.decimals is not None:
            return format_fixed(number, self.decimals)
        if abs(number) < MIN_PLAIN_VALUE and self.per_si != 1.0:
            return NumberText("0")
        return format_rounded(number, self.digits, padded=self.padded)

    def format_with_unit(self, value: float | None) -> NumberText:
        """Return a value (SI) with its unit; a much smaller value gets another prefix."""
        if value and self.quantity and not self.padded and self.decimals is None:
            is_small = abs(value) * self.per_si < _MIN_SHARED_UNIT_VALUE
            scale = choose_scale(self.quantity, value, self.digits) if is_small else self
            if scale.symbol != self.symbol:
                return scale.format_with_unit(value)
        number = self.format_value(value)
        return number if number == NO_VALUE else NumberText(f"{number} {self.symbol}".rstrip())


def make_scale(unit: str, *, decimals: int | None = None, digits: int = 4) -> DisplayScale:
    """Return the scale of a unit of :mod:`rotemina.sim.units.unit_table`, such as ``"um"``."""
    plain = normalize_unit(unit)
    return DisplayScale(symbol_of(plain), get_units_per_si(plain), decimals, digits)


def choose_scale(unit: str, size: float, digits: int = 4) -> DisplayScale:
    """Return the scale in which an SI value of this size is easiest to read.

    Lengths, angles and times get a prefix, also in a unit such as ``"m/s"``. Any other unit stays
    as it is. ``size`` is the largest of the values that share the scale.
    """
    base_unit, slash, denominator = unit.partition("/")
    units = _UNITS_BY_SIZE.get(base_unit)
    if units is None or size == 0.0 or not isfinite(size):
        return DisplayScale(unit, 1.0, None, digits)
    # Rounded before the choice: 999.96 µm, in four digits, are 1 mm.
    size = float(f"{abs(size):.{digits - 1}e}")
    unit_name = next(name for name, min_size in units if size >= min_size)
    name = f"{symbol_of(unit_name)}{slash}{denominator}"
    return DisplayScale(name, PER_SI[base_unit][unit_name], None, digits, quantity=unit)


def format_quantity(
    value: float | None, unit: str, *, digits: int = 4, size: float | None = None
) -> NumberText:
    """Return an SI value in a unit that suits its size, or ``size`` if given."""
    if value is None or not isfinite(value):
        return NO_VALUE
    return choose_scale(unit, value if size is None else size, digits).format_with_unit(value)


def format_exact(value: float, unit: str, *, size: float | None = None) -> NumberText:
    """Return an exactly known SI value, such as a limit or a target, with up to six digits."""
    if not isfinite(value):
        return NumberText(f"{value:g} {unit}".rstrip())
    return choose_scale(unit, value if size is None else size, 6).format_with_unit(value)


def format_interval(interval: Iterable[float] | None, unit: str, *, digits: int = 4) -> NumberText:
    """Return an interval (SI) with both ends in the same unit."""
    ends = tuple(interval or ())
    if not ends or not all(map(isfinite, ends)):
        return NO_VALUE
    scale = choose_scale(unit, max(map(abs, ends)), digits)
    return NumberText(
        " … ".join(f"{scale.format_value(end)} {scale.symbol}".rstrip() for end in ends)
    )


def format_percent(share: float | None, digits: int = 3) -> NumberText:
    """Return a share, as a fraction of 1, in per cent."""
    if share is None or not isfinite(share):
        return NO_VALUE
    if -_MIN_WRITTEN_SHARE < share <= 0.0:
        return NumberText("0 %")
    if 0.0 < share < _MIN_WRITTEN_SHARE:
        return NumberText(f"< {format_rounded(100.0 * _MIN_WRITTEN_SHARE)} %")
    return NumberText(f"{format_rounded(100.0 * share, digits)} %")


def format_percent_interval(interval: Iterable[float] | None, digits: int = 3) -> NumberText:
    """Return an interval of shares, as fractions of 1, in per cent."""
    if interval is None:
        return NO_VALUE
    return NumberText(" … ".join(format_percent(end, digits) for end in interval))


def align_columns(rows: Sequence[Sequence[str]]) -> str:
    """Return rows of equal length as lines, the first column left-aligned, the others right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        "  ".join(
            [row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])],
        ).rstrip()
        for row in rows
    )


if not TYPE_CHECKING:
    DisplayScale.number = FormerMember("format_value")
    DisplayScale.text = FormerMember("format_with_unit")
    __getattr__ = serve_former_names(
        __name__,
        POINT="rotemina.sim.messages.number_text.POINT",
        use_decimal_sign="rotemina.sim.messages.number_text.use_decimal_sign",
        decimal_sign="rotemina.sim.messages.number_text.decimal_sign",
        parse_number="rotemina.sim.messages.number_text.parse_number",
        localize_number="rotemina.sim.messages.number_text.localize_number",
        format_number="rotemina.sim.messages.number_text.format_number",
        count_decimals="rotemina.sim.messages.number_text.count_decimals",
        format_uncertain="rotemina.sim.messages.number_text.format_uncertain",
        NOTHING="rotemina.sim.messages.number_text.NO_VALUE",
        Number="rotemina.sim.messages.number_text.NumberText",
        Scale="DisplayScale",
        amount="format_quantity",
        amounts="format_interval",
        decimals_of="rotemina.sim.messages.number_text.count_decimals",
        exact="format_exact",
        fixed="rotemina.sim.messages.number_text.format_fixed",
        formatted="rotemina.sim.messages.number_text.format_number",
        localized="rotemina.sim.messages.number_text.localize_number",
        parsed="rotemina.sim.messages.number_text.parse_number",
        percent="format_percent",
        percents="format_percent_interval",
        rounded="rotemina.sim.messages.number_text.format_rounded",
        scale_in="make_scale",
        scale_of="choose_scale",
        uncertain="rotemina.sim.messages.number_text.format_uncertain",
    )
