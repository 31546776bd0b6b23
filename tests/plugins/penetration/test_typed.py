"""What an operator types: numbers with units, and the thrust's table."""

from dataclasses import fields

import pytest

from rotemina.app.motion.penetration.parameters import BOUNDS, PenetrationParameters
from rotemina.plugins.penetration.parameter_quantities import (
    QUANTITIES,
    Group,
    TypedError,
    in_group,
)
from rotemina.plugins.penetration.thrust_table_text import EXAMPLE, read_table, table_text

CHOICES = {"axis", "direction", "shape", "shaping", "table"}


def test_every_parameter_can_be_typed_or_chosen():
    assert set(QUANTITIES) == set(BOUNDS)
    assert set(QUANTITIES) | CHOICES == {one.name for one in fields(PenetrationParameters)}
    assert [one for group in Group for one in in_group(group)] == list(QUANTITIES.values())


@pytest.mark.parametrize("key", QUANTITIES)
def test_bounds_and_preset_are_taken_as_they_are_shown(key):
    one, bound = QUANTITIES[key], BOUNDS[key]
    for value in (bound.least, bound.most, getattr(PenetrationParameters(), key)):
        assert one.value(one.number(value)) == value


@pytest.mark.parametrize(
    ("key", "typed", "shown"),
    [
        ("depth", "12.5", 12.5e-6),
        ("approach_speed", " 20 ", 2e-5),
        ("duration_s", "90", 0.09),
        ("drift", "15", 0.15),
        ("armed_s", "60", 60.0),
        ("false_alarms_per_hour", "1e-2", 0.01),
    ],
)
def test_units_are_those_of_the_screen(key, typed, shown):
    assert QUANTITIES[key].value(typed) == pytest.approx(shown, rel=1e-15)


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("500", "Depth: 500 µm must be 1 to 100 µm"),
        ("0", "must be 1 to 100 µm"),
        ("12,5", "'12,5' is not a number; enter one in µm with a decimal point"),
        ("1_0", "is not a number"),
        ("nan", "is not a number"),
        ("", "is not a number"),
    ],
)
def test_what_is_no_depth_is_refused_with_its_bounds(typed, said):
    with pytest.raises(TypedError, match=said):
        QUANTITIES["depth"].value(typed)


def test_a_tip_says_what_it_does_and_its_bounds():
    about, bounds = QUANTITIES["retract_speed"].tip
    assert about == "Speed of the retraction."
    assert bounds == "1 to 1000 µm/s; preset 100 µm/s"


def test_a_table_reads_back():
    assert read_table(table_text(EXAMPLE)) == EXAMPLE
    assert read_table("\n 0, 0\n\n 1,1 ") == ((0.0, 0.0), (1.0, 1.0))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "table: 0 points; must be 2 to 200"),
        ("0, 0", "1 points"),
        ("0, 0\n0.5\n1, 1", "line 2: '0.5'; enter a time share, a comma and a depth share"),
        ("0, 0\n0;5, 1\n1, 1", "line 2"),
        ("0, 0\n\n0.5, 1.2\n1, 1", "line 3: depth 1.2 must be 0 to 1"),
        ("0, 0\n-0.5, 1\n1, 1", "time -0.5 must be 0 to 1"),
        ("0, 0\n0.5, 0.1\n0.5, 0.2\n1, 1", "point 3: time 0.5 must be after 0.5"),
        ("0, 0\n0.9, 1", "from 0, 0 to 1, 1"),
        ("0, 0.1\n1, 1", "from 0, 0 to 1, 1"),
        ("\n".join(f"{k / 200}, {k / 200}" for k in range(201)), "201 points"),
    ],
)
def test_what_is_no_table_is_refused_with_its_line(text, said):
    with pytest.raises(TypedError, match=said):
        read_table(text)
