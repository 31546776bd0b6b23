"""How parameters are shown, typed and slid."""

from math import inf

import pytest

from rotemina.plugins.effects.parameter_display import SLIDER_STEPS, Quantity, ValueRefusedError
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import Parameter
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")


def quantity(unit, low, high, typical, axis="thx", per=None, source_unit=""):
    parameter = Parameter("p", "of the test", unit, low, high, typical, per)
    return Quantity.of(parameter, Facts.of(ROBOT.axes[axis]), source_unit)


@pytest.mark.parametrize(
    ("unit", "typical", "axis", "text"),
    [
        ("q", 1.1e-4, "thx", "110 µrad"),
        ("q", 5.5e-6, "x", "5.5 µm"),
        ("q", 2e-3, "x", "2 mm"),
        ("q/s", 1e-3, "x", "1 mm/s"),
        ("q", 2e-8, "zn", "20 nm"),
        ("s", 1e-3, "x", "1 ms"),
        ("s", 60.0, "x", "60 s"),
        ("N s/q", 3.0, "x", "3 N s/m"),
        ("Hz", 50.0, "x", "50 Hz"),
        ("u", 2.0, "thx", "2 V"),
        ("", 0.03, "x", "0.03"),
    ],
)
def test_the_unit_fits_the_size(unit, typical, axis, text):
    shown = quantity(unit, 0.0, 100.0, typical, axis)
    assert shown.text(typical) == text
    assert shown.value(shown.number(typical)) == pytest.approx(typical, rel=1e-12)


def test_a_coupling_has_the_units_of_both_axes():
    assert quantity("q/…", -1.0, 1.0, 0.1, "thx", source_unit="m").text(0.5) == "0.5 rad/m"
    assert quantity("q/…", -1.0, 1.0, 0.1, "thx", source_unit="rad").text(0.5) == "0.5"


@pytest.mark.parametrize("text", ["1_0", "٢٥", "nan", "inf", "0x10", "2 8", "", "1e", "2,8"])
def test_only_plain_numbers_are_taken(text):
    with pytest.raises(ValueRefusedError, match="decimal point"):
        quantity("q", 0.0, 1.0, 0.1).value(text)


def test_a_value_out_of_bounds_is_refused_with_the_bounds():
    shown = quantity("q", 0.0, 0.5, 0.1, per="span")
    with pytest.raises(ValueRefusedError, match=r"600 µrad.*between 0 and 581\.775 µrad"):
        shown.value("600")
    with pytest.raises(ValueRefusedError, match="at least 0 N"):
        quantity("N", 0.0, inf, 1.0, "x").value("-1")
    with pytest.raises(ValueRefusedError, match="at least 0 N"):
        quantity("N", 0.0, inf, 1.0, "x").value("1e999")


def test_the_bound_as_it_is_shown_is_the_bound():
    shown = quantity("q", 0.0, 1.0 / 3.0, 0.1)
    assert shown.value(shown.number(shown.high)) == shown.high


@pytest.mark.parametrize(
    ("low", "high", "typical"),
    [
        (0.0, 0.2, 1e-4),
        (0.02, 50.0, 1.7),
        (0.0, 1.0, 0.7),
        (-100.0, 100.0, 0.02),
        (-0.9, 9.0, 0.0),
        (-0.05, 1.0, 0.05),
        (0.0, 1.0, 0.0),
        (1.0, 3.0, 1.0),
        (0.5, 4.0, 4.0),
    ],
)
def test_a_slider_runs_from_bound_to_bound_and_finds_back(low, high, typical):
    shown = quantity("", low, high, typical)
    values = [shown.at(place) for place in range(SLIDER_STEPS + 1)]
    assert values[0] == low
    assert values[-1] == high
    assert values == sorted(values)
    assert shown.place(low) == 0
    assert shown.place(high) == SLIDER_STEPS
    for place in range(SLIDER_STEPS // 4, SLIDER_STEPS + 1, 50):
        assert shown.at(shown.place(values[place])) == values[place]
    nearest = shown.at(shown.place(typical))
    assert nearest == pytest.approx(typical, rel=0.02, abs=1e-12)


def test_without_a_bound_there_is_no_slider():
    assert not quantity("N", 0.0, inf, 1.0).bounded
    assert quantity("N", 0.0, 2.0, 1.0).bounded
