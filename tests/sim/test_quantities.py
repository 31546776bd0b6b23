"""Numbers as people read them: digits, prefixes, decimal signs, and what was typed."""

from math import log10

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.sim import quantities
from rotemina.sim.quantities import (
    amount,
    amounts,
    exact,
    fixed,
    formatted,
    parsed,
    percent,
    rounded,
    scale_in,
    scale_of,
    uncertain,
    use_decimal_sign,
)

NUMBERS = st.floats(-1e12, 1e12)
READABLE = st.floats(1e-6, 9.99e8) | st.floats(-9.99e8, -1e-6)


@pytest.fixture
def comma():
    use_decimal_sign(",")
    yield
    use_decimal_sign(quantities.POINT)


@given(NUMBERS, st.integers(1, 9))
def test_a_rounded_number_is_read_back_within_its_digits(value, digits):
    read = parsed(rounded(value, digits))
    assert read == pytest.approx(value, rel=0.501 * 10.0 ** (1 - digits), abs=0.0)


@given(READABLE, st.integers(1, 9))
def test_a_number_has_no_exponent_no_idle_zero_and_no_more_digits(value, digits):
    text = rounded(value, digits)
    assert "e" not in text
    assert not ("." in text and text.endswith(("0", ".")))
    assert len(text.strip("-").replace(".", "").strip("0")) <= digits


@given(READABLE, st.integers(0, 6))
def test_fixed_decimals_are_pythons_but_zero_has_no_sign(value, decimals):
    text = f"{value:.{decimals}f}"
    zero = float(text) == 0.0
    assert fixed(value, decimals) == (text.lstrip("-") if zero else text)


@given(st.sampled_from(("m", "rad", "s")), st.floats(1e-9, 900.0), st.integers(3, 6))
def test_a_prefix_keeps_a_quantity_between_1_and_1000(unit, value, digits):
    number, symbol = amount(value, unit, digits=digits).split()
    smallest = {"m": "nm", "rad": "µrad", "s": "µs"}[unit]
    assert "e" not in number
    assert float(number) < 1000.0
    assert float(number) >= 1.0 or symbol == smallest


@given(st.sampled_from(("m", "m/s", "rad/s²", "s", "V", "N")), st.floats(1e-6, 900.0))
def test_what_is_shown_is_what_it_is(unit, value):
    number, symbol = exact(value, unit).split()
    head, _, rest = symbol.partition("/")
    factor = 1.0 if unit in ("V", "N") else scale_in(head).per_si
    assert rest == unit.partition("/")[2]
    assert float(number) / factor == pytest.approx(value, rel=1e-5)


@given(st.floats(1e-9, 1.0), st.floats(1e-9, 1.0))
def test_an_interval_has_one_unit(low, high):
    units = {text.split()[1] for text in amounts((low, high), "m").split(" … ")}
    assert len(units) == 1


@given(st.floats(-1e5, 1e5), st.floats(1e-6, 1e3))
def test_an_uncertainty_has_two_digits_and_ends_the_number(value, deviation):
    number, doubt = uncertain(value, deviation)
    assert len(number.partition(".")[2]) == len(doubt.partition(".")[2])
    assert float(doubt) == pytest.approx(deviation, rel=0.06, abs=0.5 if deviation >= 1 else 0.0)
    assert float(number) == pytest.approx(value, abs=0.51 * 10.0 ** -len(doubt.partition(".")[2]))


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        (amount(6.713e-10, "s"), "0.0006713 µs"),
        (amount(9.15e-18, "m"), "0 nm"),
        (amount(0.9996e-3, "m", digits=3), "1 mm"),
        (amount(None, "m"), "–"),
        (exact(89.54, "rad/s²"), "89.54 rad/s²"),
        (exact(0.0, "m"), "0 m"),
        (exact(float("inf"), "V"), "inf V"),
        (exact(1e-4, "m", size=0.02), "0.1 mm"),
        (exact(3.269e-4, "m/s²", size=5.0), "326.9 µm/s²"),
        (percent(6.713e-7), "< 0.01 %"),
        (percent(0.999), "99.9 %"),
        (percent(None), "–"),
        (scale_of("m", 2e-5, 3)._replace(padded=True).text(2e-5), "20.0 µm"),
        (scale_in("um", decimals=3).text(2.5e-5), "25.000 µm"),
        (fixed(-0.0004, 2), "0.00"),
        (formatted(0.5, "+.2f"), "+0.50"),
        (formatted(12345.6, "g"), "12345.6"),
    ],
)
def test_examples(text, shown):
    assert text == shown


def test_a_comma_is_written_and_typed_where_it_is_the_sign(comma):
    assert (percent(0.999), amount(1.5e-6, "m"), fixed(0.25, 2)) == ("99,9 %", "1,5 µm", "0,25")
    assert formatted(1.25, ".1f") == "1,2"
    assert (parsed(" 1,5 "), parsed("1.5"), parsed("-,5e1")) == (1.5, 1.5, -5.0)
    assert [parsed(text) for text in ("1.500,0", "1 500", "1_5", "٣", "", "mm")] == [None] * 6


def test_a_comma_is_no_sign_in_english():
    assert parsed("1,5") is None
    assert parsed("1,5", sign=",") == 1.5


def test_digits_follow_a_step():
    steps = {1e-4: 4, 0.05: 2, 0.1: 1, 1.0: 0, 20.0: 0, 0.0: 0, 1e-15: 9}
    for step, decimals in steps.items():
        assert quantities.decimals_of(step) == decimals, log10(step or 1.0)
