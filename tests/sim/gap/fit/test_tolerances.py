"""How far a fit may take a parameter, by what its records cover."""

from dataclasses import replace

import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.identification import Extent
from rotemina.sim.gap.fit.tolerances import tolerance
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(("longest_s", "least_hz"), [(10.0, 0.3), (7.5, 0.4), (600.0, 0.1)])
def test_what_is_periodic_returns_a_few_times_within_a_record(longest_s, least_hz):
    attached = Attached.of(ROBOT, AxisEffect(axis="x", id="vibration"))
    frequency = attached.formulation.parameter("frequency")
    low, high = tolerance(attached, frequency, Extent((0.0, 0.05), longest_s))
    assert low == pytest.approx(least_hz)
    assert high == 2000.0


def test_a_contact_lies_beyond_the_first_part_of_the_way():
    attached = Attached.of(ROBOT, AxisEffect(axis="x", id="contact"))
    place = attached.formulation.parameter("place")
    low, high = tolerance(attached, place, Extent((0.01, 0.02), 10.0))
    assert low == pytest.approx(0.013)
    assert high == pytest.approx(0.02)


@pytest.mark.parametrize(
    ("seen", "least", "most"), [(1.03, 0.98, 1.02), (0.8, 0.98, 1.02), (0.6, 0.05, 0.51)]
)
def test_what_a_screw_repeats_is_a_turn_or_half_of_one_at_most(seen, least, most):
    pitch = ROBOT.axes["x"].pitch
    asked = AxisEffect(axis="x", id="leadscrew_error", parameters={"period": seen * pitch})
    attached = Attached.of(ROBOT, asked)
    period = attached.formulation.parameter("period")
    low, high = tolerance(attached, period, Extent((0.0, 0.05), 10.0))
    assert (low, high) == pytest.approx((least * pitch, most * pitch))


def test_without_a_declared_pitch_any_period_may_be_the_screw_s():
    robot = replace(ROBOT, axes={"x": replace(ROBOT.axes["x"], pitch=None, steps_per_rev=None)})
    attached = Attached.of(robot, AxisEffect(axis="x", id="leadscrew_error"))
    period = attached.formulation.parameter("period")
    found = tolerance(attached, period, Extent((0.0, 0.05), 10.0))
    assert found == period.bounds(attached.facts)
