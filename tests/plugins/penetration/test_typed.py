"""Values that an operator types: numbers with units, and the thrust table."""

from dataclasses import fields

import pytest

from rotemina.app.motion.penetration import PARAMETER_BOUNDS, PenetrationParameters
from rotemina.plugins.penetration.parameter_quantities import (
    QUANTITIES,
    ParameterGroup,
    ParameterInputError,
    find_quantities,
)
from rotemina.plugins.penetration.thrust_table_text import EXAMPLE_TABLE, format_table, parse_table

CHOICE_PARAMETERS = {"axis", "direction", "shape", "shaping", "table"}


def test_every_parameter_can_be_typed_or_chosen():
    assert set(QUANTITIES) == set(PARAMETER_BOUNDS)
    assert set(QUANTITIES) | CHOICE_PARAMETERS == {
        field.name for field in fields(PenetrationParameters)
    }
    grouped = [quantity for group in ParameterGroup for quantity in find_quantities(group)]
    assert grouped == list(QUANTITIES.values())


def test_displayed_bounds_and_presets_are_accepted():
    for key, quantity in QUANTITIES.items():
        bound = PARAMETER_BOUNDS[key]
        for value in (bound.minimum, bound.maximum, getattr(PenetrationParameters(), key)):
            assert quantity.parse_value(quantity.format_number(value)) == value, key


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("depth", "12.5", 12.5e-6),
        ("approach_speed", " 20 ", 2e-5),
        ("duration_s", "90", 0.09),
        ("drift", "15", 0.15),
        ("false_alarms_per_hour", "1e-2", 0.01),
    ],
)
def test_typed_values_have_the_displayed_unit(key, text, value):
    assert QUANTITIES[key].parse_value(text) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("500", "Depth: 500 µm must be 1 to 100 µm"),
        ("12,5", "'12,5' is not a number; enter one in µm with a decimal point"),
        ("1_0", "is not a number"),
        ("nan", "is not a number"),
    ],
)
def test_an_invalid_depth_is_refused_with_its_bounds(text, message):
    with pytest.raises(ParameterInputError, match=message):
        QUANTITIES["depth"].parse_value(text)


def test_a_formatted_table_is_parsed_again():
    assert parse_table(format_table(EXAMPLE_TABLE)) == EXAMPLE_TABLE
    assert parse_table("\n 0, 0\n\n 1,1 ") == ((0.0, 0.0), (1.0, 1.0))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0, 0", "table: 1 points; must be 2 to 200"),
        ("0, 0\n0.5\n1, 1", "line 2: '0.5'; enter a time share, a comma and a depth share"),
        ("0, 0\n\n0.5, 1.2\n1, 1", "line 3: depth 1.2 must be 0 to 1"),
        ("0, 0\n-0.5, 1\n1, 1", "time -0.5 must be 0 to 1"),
        ("0, 0\n0.5, 0.1\n0.5, 0.2\n1, 1", "point 3: time 0.5 must be after 0.5"),
        ("0, 0\n0.9, 1", "from 0, 0 to 1, 1"),
        ("\n".join(f"{k / 200}, {k / 200}" for k in range(201)), "201 points"),
    ],
)
def test_an_invalid_table_is_refused_with_its_line(text, message):
    with pytest.raises(ParameterInputError, match=message):
        parse_table(text)
