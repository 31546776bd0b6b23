"""Units in a report."""

import pytest

from rotemina.sim.gap.output import unit_of
from rotemina.sim.gap.output.report_words import complete_unit
from rotemina.sim.records import Tap


def test_a_tap_has_the_unit_of_its_axis_or_volts(records):
    assert unit_of("thx", Tap.MEAS, records) == "rad"
    assert unit_of("y", Tap.CMD, records) == "m"
    assert unit_of("thx", Tap.U, records) == "V"
    assert unit_of("another", Tap.MEAS, records) == ""


@pytest.mark.parametrize(
    ("unit", "source", "expected"),
    [("rad/…", "m", "rad/m"), ("m/…", "m", ""), ("1/s", "m", "1/s"), ("rad/…", "", "rad/…")],
)
def test_a_parameter_across_axes_has_both_units(unit, source, expected):
    assert complete_unit(unit, source) == expected
