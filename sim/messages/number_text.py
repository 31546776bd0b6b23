"""Numbers as readable text: rounding, the decimal sign, and the reading of typed numbers.

A number gets as many digits as its resolution or its uncertainty justifies. Files and protocols do
not use this module, because their formats define how numbers are written.

The decimal sign is a setting of the process, like the locale of the C library. It is a point unless
the window sets the sign of its language.
"""

import re
from math import floor, isfinite, log10

POINT = "."
_decimal_sign = POINT

# Between these limits, a number without a prefix is written without an exponent.
MIN_PLAIN_VALUE, MAX_PLAIN_VALUE = 1e-6, 1e9
_SPECIFICATION = re.compile(r"(?P<sign>\+?)(\.(?P<digits>[0-9]+))?(?P<kind>[fg])")
_DECIMAL = re.compile(r"(?<=[0-9])[.,](?=[0-9])")
# float() accepts more, such as "1_0" or digits of other scripts; those are more likely typing
# errors.
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


class NumberText(str):
    """The text of a number, with or without unit, that can be converted to another decimal sign."""

    __slots__ = ()

    def with_sign(self, sign: str) -> str:
        """Return the text with this decimal sign instead of the point."""
        return _DECIMAL.sub(sign, self)


# Shown in place of an unknown value.
NO_VALUE = NumberText("–")


def use_decimal_sign(sign: str) -> None:
    """Set the decimal sign with which this process writes and reads numbers."""
    global _decimal_sign
    _decimal_sign = sign


def decimal_sign() -> str:
    """Return the decimal sign in use."""
    return _decimal_sign


def parse_number(text: str, sign: str | None = None) -> float | None:
    """Return the value of a typed number, or None if the text is not a number.

    The decimal sign may be ``sign`` (by default that of the process) or a point. Thousands
    separators are not accepted: ``1,500`` is not a number if the decimal sign is the point.
    """
    plain = text.strip().replace(sign or _decimal_sign, POINT)
    return float(plain) if _NUMBER.fullmatch(plain) else None


def localize_number(number: str) -> NumberText:
    """Return the text of a number, written with a point, with the decimal sign in use."""
    return NumberText(number.replace(POINT, _decimal_sign))


def format_fixed(value: float, decimals: int) -> NumberText:
    """Return a number with this many decimals; zero has no minus sign."""
    text = f"{value:.{decimals}f}"
    if text.startswith("-") and not text.strip("-0."):
        text = text[1:]
    return localize_number(text)


def format_rounded(value: float, digits: int = 4, *, padded: bool = False) -> NumberText:
    """Return a number with this many significant digits; ``padded`` keeps trailing zeros."""
    if value == 0.0 or not isfinite(value):
        return NumberText(f"{value + 0.0:g}")
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    if not MIN_PLAIN_VALUE <= abs(value) < MAX_PLAIN_VALUE:
        return localize_number(f"{value:.{digits}g}")
    decimals = max(digits - 1 - int(exponent), 0)
    text = f"{float(f'{mantissa}e{exponent}'):.{decimals}f}"
    if decimals and not padded:
        text = text.rstrip("0").rstrip(POINT)
    return localize_number(text)


def format_number(value: float, spec: str) -> str:
    """Return a number in a Python format specification, by the rules of this module.

    ``.3f`` means :func:`format_fixed`, and ``.3g`` or ``g`` means :func:`format_rounded`. Signs,
    widths and per cent are as in Python.
    """
    match = _SPECIFICATION.fullmatch(spec)
    if match is None or not isfinite(value):
        return localize_number(format(value, spec))
    sign, digits, kind = match["sign"], int(match["digits"] or 6), match["kind"]
    text = format_fixed(value, digits) if kind == "f" else format_rounded(value, max(digits, 1))
    return f"+{text}" if sign and not text.startswith("-") else text


def count_decimals(step: float) -> int:
    """Return the number of decimals that show a step, at most 9."""
    if not 0.0 < step < 1.0:
        return 0
    return min(-floor(log10(step) + 1e-9), 9)


def format_uncertain(value: float, deviation: float) -> tuple[str, str]:
    """Return a number and its uncertainty: the latter with two digits, both with equal decimals."""
    if not isfinite(deviation) or deviation <= 0.0:
        return format_rounded(value, 4), format_rounded(deviation, 2)
    decimals = count_decimals(float(f"{deviation:.1e}") / 10.0)
    return format_fixed(value, decimals), format_fixed(deviation, decimals)
