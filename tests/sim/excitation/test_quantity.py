"""Amounts as users write them."""

import pytest

from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation import CapabilityShare, parse_axis_amount


@pytest.mark.parametrize(
    ("text", "unit", "amount"),
    [
        ("5um", "m", 5e-6),
        ("5 µm", "m", 5e-6),
        (" .5mm ", "m", 5e-4),
        ("-1e-3mm", "m", -1e-6),
        ("200urad", "rad", 200e-6),
        ("30%", "m", CapabilityShare(0.3)),
        ("30 %", "rad", CapabilityShare(0.3)),
        ("1 mm/s", "m/s", 1e-3),
        ("2m/s3", "m/s3", 2.0),
        ("2m/s³", "m/s3", 2.0),
    ],
)
def test_amounts_are_converted_to_si(text, unit, amount):
    assert parse_axis_amount(text, "x", unit) == amount


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("5", "has no unit"),
        ("5kg", "unknown unit 'kg'"),
        ("5urad", "axis x: '5urad' is in rad, not in m"),
        ("5um/s", "is in m/s, not in m"),
        ("5%/s", "unknown unit"),
        ("um", "not an amount"),
        ("", "not an amount"),
        ("nan um", "not an amount"),
        ("1e999um", "not a finite number"),
        ("1,5um", "not an amount"),
    ],
)
def test_texts_that_are_no_amount_are_refused(text, words):
    with pytest.raises(ExcitationRequestError, match=words):
        parse_axis_amount(text, "x", "m")
