"""Display of parameters, parsing of typed values, and their sliders."""

from math import inf

import pytest

from rotemina.plugins.effects.parameter_display import (
    SLIDER_STEPS,
    DisplayedParameter,
    ValueRefusedError,
)
from rotemina.sim.effects import AxisProperties, EffectParameter
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def make_parameter(unit, low, high, typical, axis="thx", per=None, source_unit=""):
    parameter = EffectParameter("p", "of the test", unit, low, high, typical, per)
    return DisplayedParameter.from_parameter(
        parameter, AxisProperties.of(ROBOT.axes[axis]), source_unit
    )


@pytest.mark.parametrize(
    ("unit", "typical", "axis", "text"),
    [
        ("q", 1.1e-4, "thx", "110 µrad"),
        ("q", 2e-3, "x", "2 mm"),
        ("q/s", 1e-3, "x", "1 mm/s"),
        ("q", 2e-8, "zn", "20 nm"),
        ("s", 60.0, "x", "60 s"),
        ("N s/q", 3.0, "x", "3 N s/m"),
        ("u", 2.0, "thx", "2 V"),
        ("", 0.03, "x", "0.03"),
    ],
)
def test_the_unit_fits_the_typical_value(unit, typical, axis, text):
    parameter = make_parameter(unit, 0.0, 100.0, typical, axis)
    assert parameter.format_value(typical) == text
    assert parameter.parse_value(parameter.format_number(typical)) == pytest.approx(
        typical, rel=1e-12
    )


@pytest.mark.parametrize(("source_unit", "text"), [("m", "0.5 rad/m"), ("rad", "0.5")])
def test_a_coupling_has_the_units_of_both_axes(source_unit, text):
    parameter = make_parameter("q/…", -1.0, 1.0, 0.1, "thx", source_unit=source_unit)
    assert parameter.format_value(0.5) == text


@pytest.mark.parametrize("text", ["1_0", "٢٥", "nan", "inf", "0x10", "2 8", "", "1e", "2,8"])
def test_only_plain_numbers_are_accepted(text):
    with pytest.raises(ValueRefusedError, match="decimal point"):
        make_parameter("q", 0.0, 1.0, 0.1).parse_value(text)


def test_a_value_out_of_bounds_is_refused_with_the_bounds():
    parameter = make_parameter("q", 0.0, 0.5, 0.1, per="span")
    with pytest.raises(ValueRefusedError, match=r"600 µrad.*between 0 and 581\.775 µrad"):
        parameter.parse_value("600")
    for text in ("-1", "1e999"):
        with pytest.raises(ValueRefusedError, match="at least 0 N"):
            make_parameter("N", 0.0, inf, 1.0, "x").parse_value(text)


def test_the_displayed_bound_is_accepted_as_the_bound():
    parameter = make_parameter("q", 0.0, 1.0 / 3.0, 0.1)
    assert parameter.parse_value(parameter.format_number(parameter.high)) == parameter.high


@pytest.mark.parametrize(
    ("low", "high", "typical"),
    [
        (0.0, 0.2, 1e-4),
        (0.02, 50.0, 1.7),
        (-100.0, 100.0, 0.02),
        (-0.05, 1.0, 0.05),
        (0.0, 1.0, 0.0),
        (0.5, 4.0, 4.0),
    ],
)
def test_a_slider_covers_the_bounds_and_is_invertible(low, high, typical):
    parameter = make_parameter("", low, high, typical)
    values = [parameter.from_slider(position) for position in range(SLIDER_STEPS + 1)]
    assert values[0] == low
    assert values[-1] == high
    assert values == sorted(values)
    assert parameter.to_slider(low) == 0
    assert parameter.to_slider(high) == SLIDER_STEPS
    for position in range(SLIDER_STEPS // 4, SLIDER_STEPS + 1, 50):
        assert parameter.from_slider(parameter.to_slider(values[position])) == values[position]
    nearest = parameter.from_slider(parameter.to_slider(typical))
    assert nearest == pytest.approx(typical, rel=0.02, abs=1e-12)
