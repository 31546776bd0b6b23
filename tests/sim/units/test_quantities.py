"""Formatted numbers: digits, prefixes and decimal signs, and parsing of typed numbers."""

from math import log10

import pytest
from hypothesis import given, strategies as st

from rotemina.sim.messages import (
    format_fixed,
    format_number,
    format_rounded,
    format_uncertain,
    number_text,
    parse_number,
    use_decimal_sign,
)
from rotemina.sim.units import (
    choose_scale,
    format_exact,
    format_interval,
    format_percent,
    format_quantity,
    make_scale,
)

NUMBERS = st.floats(-1e12, 1e12)
READABLE = st.floats(1e-6, 9.99e8) | st.floats(-9.99e8, -1e-6)


@pytest.fixture
def decimal_comma():
    use_decimal_sign(",")
    yield
    use_decimal_sign(number_text.POINT)


@given(NUMBERS, st.integers(1, 9))
def test_a_rounded_number_can_be_parsed_within_its_digits(value, digits):
    parsed = parse_number(format_rounded(value, digits))
    assert parsed == pytest.approx(value, rel=0.501 * 10.0 ** (1 - digits), abs=0.0)


@given(READABLE, st.integers(1, 9))
def test_a_number_has_no_exponent_no_trailing_zero_and_its_digits(value, digits):
    text = format_rounded(value, digits)
    assert "e" not in text
    assert not ("." in text and text.endswith(("0", ".")))
    assert len(text.strip("-").replace(".", "").strip("0")) <= digits


@given(READABLE, st.integers(0, 6))
def test_fixed_decimals_match_python_but_zero_has_no_sign(value, decimals):
    text = f"{value:.{decimals}f}"
    is_zero = float(text) == 0.0
    assert format_fixed(value, decimals) == (text.lstrip("-") if is_zero else text)


@given(st.sampled_from(("m", "rad", "s")), st.floats(1e-9, 900.0), st.integers(3, 6))
def test_a_prefix_keeps_a_quantity_between_1_and_1000(unit, value, digits):
    number, symbol = format_quantity(value, unit, digits=digits).split()
    smallest = {"m": "nm", "rad": "µrad", "s": "µs"}[unit]
    assert "e" not in number
    assert float(number) < 1000.0
    assert float(number) >= 1.0 or symbol == smallest


@given(st.sampled_from(("m", "m/s", "rad/s²", "s", "V", "N")), st.floats(1e-6, 900.0))
def test_the_formatted_value_and_unit_are_correct(unit, value):
    number, symbol = format_exact(value, unit).split()
    numerator, _, denominator = symbol.partition("/")
    factor = 1.0 if unit in ("V", "N") else make_scale(numerator).per_si
    assert denominator == unit.partition("/")[2]
    assert float(number) / factor == pytest.approx(value, rel=1e-5)


@given(st.floats(1e-9, 1.0), st.floats(1e-9, 1.0))
def test_an_interval_has_one_unit(low, high):
    units = {text.split()[1] for text in format_interval((low, high), "m").split(" … ")}
    assert len(units) == 1


@given(st.floats(-1e5, 1e5), st.floats(1e-6, 1e3))
def test_a_number_has_the_decimals_of_its_uncertainty(value, deviation):
    number, uncertainty = format_uncertain(value, deviation)
    assert len(number.partition(".")[2]) == len(uncertainty.partition(".")[2])
    assert float(uncertainty) == pytest.approx(
        deviation, rel=0.06, abs=0.5 if deviation >= 1 else 0.0
    )
    assert float(number) == pytest.approx(
        value, abs=0.51 * 10.0 ** -len(uncertainty.partition(".")[2])
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (format_quantity(6.713e-10, "s"), "0.0006713 µs"),
        (format_quantity(9.15e-18, "m"), "0 nm"),
        (format_quantity(0.9996e-3, "m", digits=3), "1 mm"),
        (format_quantity(None, "m"), "–"),
        (format_exact(89.54, "rad/s²"), "89.54 rad/s²"),
        (format_exact(0.0, "m"), "0 m"),
        (format_exact(float("inf"), "V"), "inf V"),
        (format_exact(1e-4, "m", size=0.02), "0.1 mm"),
        (format_exact(3.269e-4, "m/s²", size=5.0), "326.9 µm/s²"),
        (format_percent(6.713e-7), "< 0.01 %"),
        (format_percent(0.999), "99.9 %"),
        (format_percent(None), "–"),
        (choose_scale("m", 2e-5, 3)._replace(padded=True).format_with_unit(2e-5), "20.0 µm"),
        (make_scale("um", decimals=3).format_with_unit(2.5e-5), "25.000 µm"),
        (format_fixed(-0.0004, 2), "0.00"),
        (format_number(0.5, "+.2f"), "+0.50"),
        (format_number(12345.6, "g"), "12345.6"),
    ],
)
def test_examples_of_formatted_numbers(text, expected):
    assert text == expected


def test_a_decimal_comma_is_written_and_parsed(decimal_comma):
    assert (format_percent(0.999), format_quantity(1.5e-6, "m"), format_fixed(0.25, 2)) == (
        "99,9 %",
        "1,5 µm",
        "0,25",
    )
    assert format_number(1.25, ".1f") == "1,2"
    assert (parse_number(" 1,5 "), parse_number("1.5"), parse_number("-,5e1")) == (1.5, 1.5, -5.0)
    assert [parse_number(text) for text in ("1.500,0", "1 500", "1_5", "٣", "", "mm")] == [None] * 6


def test_a_comma_is_no_decimal_sign_in_english():
    assert parse_number("1,5") is None
    assert parse_number("1,5", sign=",") == 1.5


def test_the_number_of_decimals_follows_the_step():
    steps = {1e-4: 4, 0.05: 2, 0.1: 1, 1.0: 0, 20.0: 0, 0.0: 0, 1e-15: 9}
    for step, decimals in steps.items():
        assert number_text.count_decimals(step) == decimals, log10(step or 1.0)
