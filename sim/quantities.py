"""Numbers and quantities as people read them: in window, report and on the command line.

A number has as many digits as its resolution or its uncertainty deserves; a quantity stands in the
unit whose prefix keeps it between 1 and 1000. An exponent is used only where no prefix could take
its place. Files and protocols do without this module: they spell numbers as their formats demand.

The decimal sign is a setting of the process, like the C library's locale: a point, unless the
window chooses that of its language.
"""

import re
from collections.abc import Iterable
from math import floor, isfinite, log10
from typing import NamedTuple

from rotemina.sim.arrays import FloatArray
from rotemina.sim.unit_table import PER_SI, factor_of, spelled, symbol_of

POINT = "."
_sign = POINT

_LEAST_SHARE = 1e-4  # that is written in digits
_LEAST_SHARED = 1e-2  # of a shared unit; a quantity below it gets a prefix of its own
# Between these, a number without a prefix is written without an exponent.
_LEAST, _MOST = 1e-6, 1e9
# Least size (SI) that each unit is for, largest unit first.
_PREFIXES = {
    "m": (("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("nm", 0.0)),
    "rad": (("rad", 1.0), ("mrad", 1e-3), ("urad", 0.0)),
    "s": (("s", 1.0), ("ms", 1e-3), ("us", 0.0)),
}
_SPECIFICATION = re.compile(r"(?P<sign>\+?)(\.(?P<digits>[0-9]+))?(?P<kind>[fg])")
_DECIMAL = re.compile(r"(?<=[0-9])[.,](?=[0-9])")
# What float() takes beside this (1_0, digits of other scripts) is likelier a slip than a number.
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


class Number(str):
    """A number as text, with or without its unit, convertible to another decimal sign."""

    __slots__ = ()

    def with_sign(self, sign: str) -> str:
        """Return it with a decimal sign, whichever it was written with."""
        return _DECIMAL.sub(sign, self)


NOTHING = Number("–")  # in place of what is not known


def use_decimal_sign(sign: str) -> None:
    """Let all numbers of this process be written, and be typed, with a decimal sign."""
    global _sign
    _sign = sign


def decimal_sign() -> str:
    """Return the decimal sign in use."""
    return _sign


def parsed(text: str, sign: str | None = None) -> float | None:
    """Return a number as someone typed it, with the decimal sign or a point; None for no number.

    There are no separators of thousands: ``1,500`` is no number where the sign is the point.
    ``sign`` is the process's unless given.
    """
    plain = text.strip().replace(sign or _sign, POINT)
    return float(plain) if _NUMBER.fullmatch(plain) else None


def localized(number: str) -> Number:
    """Return a number that something else wrote, with a point, with the decimal sign in use."""
    return Number(number.replace(POINT, _sign))


def fixed(value: float, decimals: int) -> Number:
    """Return a number with so many decimals; zero has no sign."""
    text = f"{value:.{decimals}f}"
    if text.startswith("-") and not text.strip("-0."):
        text = text[1:]
    return localized(text)


def rounded(value: float, digits: int = 4, *, padded: bool = False) -> Number:
    """Return a number rounded to so many significant digits; ``padded`` keeps zeros at its end."""
    if value == 0.0 or not isfinite(value):
        return Number(f"{value + 0.0:g}")
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    if not _LEAST <= abs(value) < _MOST:
        return localized(f"{value:.{digits}g}")
    decimals = max(digits - 1 - int(exponent), 0)
    text = f"{float(f'{mantissa}e{exponent}'):.{decimals}f}"
    if decimals and not padded:
        text = text.rstrip("0").rstrip(POINT)
    return localized(text)


def formatted(value: float, spec: str) -> str:
    """Return a number by a format specification, in this module's terms.

    ``.3f`` is :func:`fixed` and ``.3g`` or ``g`` is :func:`rounded`; signs, widths and per cent
    are what they are in Python.
    """
    found = _SPECIFICATION.fullmatch(spec)
    if found is None or not isfinite(value):
        return localized(format(value, spec))
    sign, digits, kind = found["sign"], int(found["digits"] or 6), found["kind"]
    text = fixed(value, digits) if kind == "f" else rounded(value, max(digits, 1))
    return f"+{text}" if sign and not text.startswith("-") else text


def decimals_of(step: float) -> int:
    """Return how many decimals show a step; at most 9."""
    if not 0.0 < step < 1.0:
        return 0
    return min(-floor(log10(step) + 1e-9), 9)


def uncertain(value: float, deviation: float) -> tuple[str, str]:
    """Return a number and its uncertainty, which has two digits and ends with the number."""
    if not isfinite(deviation) or deviation <= 0.0:
        return rounded(value, 4), rounded(deviation, 2)
    decimals = decimals_of(float(f"{deviation:.1e}") / 10.0)
    return fixed(value, decimals), fixed(deviation, decimals)


class Scale(NamedTuple):
    """A unit for several values, so that they can be compared.

    Attributes
    ----------
    symbol : str
        The unit as screens write it, such as ``µm``.
    per_si : float
        How many of it make one SI unit.
    decimals : int or None
        Of each value, where a sensor's resolution gives them.
    digits : int
        Significant ones of each value, where ``decimals`` is None.
    padded : bool
        Whether those are kept where they are zero, so that a live value does not change its width.
    quantity : str
        The SI unit whose prefixes a much smaller quantity may take; none if empty.
    """

    symbol: str
    per_si: float = 1.0
    decimals: int | None = None
    digits: int = 4
    padded: bool = False
    quantity: str = ""

    def __call__(self, values: FloatArray) -> FloatArray:
        """Return values (SI) of any shape in this unit."""
        return values * self.per_si

    def number(self, value: float | None) -> Number:
        """Return a value (SI) as digits, without its unit."""
        if value is None or not isfinite(value):
            return NOTHING
        shown = float(value) * self.per_si
        if self.decimals is not None:
            return fixed(shown, self.decimals)
        if abs(shown) < _LEAST and self.per_si != 1.0:
            return Number("0")
        return rounded(shown, self.digits, padded=self.padded)

    def text(self, value: float | None) -> Number:
        """Return a value (SI) with its unit; one far too small for this unit takes another."""
        if value and self.quantity and not self.padded and self.decimals is None:
            small = abs(value) * self.per_si < _LEAST_SHARED
            own = scale_of(self.quantity, value, self.digits) if small else self
            if own.symbol != self.symbol:
                return own.text(value)
        number = self.number(value)
        return number if number == NOTHING else Number(f"{number} {self.symbol}".rstrip())


def scale_in(unit: str, *, decimals: int | None = None, digits: int = 4) -> Scale:
    """Return the scale of a unit of :mod:`rotemina.sim.unit_table`, such as ``"um"``."""
    plain = spelled(unit)
    return Scale(symbol_of(plain), factor_of(plain), decimals, digits)


def scale_of(unit: str, size: float, digits: int = 4) -> Scale:
    """Return the scale in which an SI value of this size reads best.

    Lengths, angles and times take a prefix, also where something follows their unit (``"m/s"``);
    any other unit stays as it is. ``size`` is the largest of the values that share the scale.
    """
    head, slash, rest = unit.partition("/")
    steps = _PREFIXES.get(head)
    if steps is None or size == 0.0 or not isfinite(size):
        return Scale(unit, 1.0, None, digits)
    size = float(f"{abs(size):.{digits - 1}e}")  # 999.96 µm, in four digits, are 1 mm
    shown = next(name for name, least in steps if size >= least)
    name = f"{symbol_of(shown)}{slash}{rest}"
    return Scale(name, PER_SI[head][shown], None, digits, quantity=unit)


def amount(value: float | None, unit: str, *, digits: int = 4, size: float | None = None) -> Number:
    """Return an SI value in the unit that suits it, or that suits ``size``."""
    if value is None or not isfinite(value):
        return NOTHING
    return scale_of(unit, value if size is None else size, digits).text(value)


def exact(value: float, unit: str, *, size: float | None = None) -> Number:
    """Return an SI value that is known exactly, as a limit or a request: with up to six digits."""
    if not isfinite(value):
        return Number(f"{value:g} {unit}".rstrip())
    return scale_of(unit, value if size is None else size, 6).text(value)


def amounts(interval: Iterable[float] | None, unit: str, *, digits: int = 4) -> Number:
    """Return an interval (SI), both ends in one unit."""
    ends = tuple(interval or ())
    if not ends or not all(map(isfinite, ends)):
        return NOTHING
    scale = scale_of(unit, max(map(abs, ends)), digits)
    return Number(" … ".join(f"{scale.number(end)} {scale.symbol}".rstrip() for end in ends))


def percent(share: float | None, digits: int = 3) -> Number:
    """Return a share of 1 in per cent."""
    if share is None or not isfinite(share):
        return NOTHING
    if -_LEAST_SHARE < share <= 0.0:
        return Number("0 %")
    if 0.0 < share < _LEAST_SHARE:
        return Number(f"< {rounded(100.0 * _LEAST_SHARE)} %")
    return Number(f"{rounded(100.0 * share, digits)} %")


def percents(interval: Iterable[float] | None, digits: int = 3) -> Number:
    """Return an interval of shares in per cent."""
    if interval is None:
        return NOTHING
    return Number(" … ".join(percent(end, digits) for end in interval))
