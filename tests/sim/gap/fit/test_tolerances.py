"""Bounds of a parameter in a fit, which depend on the coverage of the records."""

from dataclasses import replace

import pytest

from rotemina.sim.effects import AttachedEffect, RecordCoverage
from rotemina.sim.gap.fit.output_error import tolerance
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(("longest_s", "min_hz"), [(10.0, 0.3), (7.5, 0.4), (600.0, 0.1)])
def test_a_periodic_effect_has_a_few_periods_within_a_record(longest_s, min_hz):
    attached = AttachedEffect.of(ROBOT, AxisEffect(axis="x", id="vibration"))
    frequency = attached.formulation.find_parameter("frequency")
    low, high = tolerance(attached, frequency, RecordCoverage((0.0, 0.05), longest_s))
    assert low == pytest.approx(min_hz)
    assert high == 2000.0


def test_a_contact_lies_beyond_the_first_part_of_the_travel():
    attached = AttachedEffect.of(ROBOT, AxisEffect(axis="x", id="contact"))
    place = attached.formulation.find_parameter("place")
    low, high = tolerance(attached, place, RecordCoverage((0.01, 0.02), 10.0))
    assert low == pytest.approx(0.013)
    assert high == pytest.approx(0.02)


@pytest.mark.parametrize(
    ("period_in_pitches", "low_in_pitches", "high_in_pitches"),
    [(1.03, 0.98, 1.02), (0.8, 0.98, 1.02), (0.6, 0.05, 0.51)],
)
def test_the_period_of_a_screw_is_one_turn_or_at_most_half_of_it(
    period_in_pitches, low_in_pitches, high_in_pitches
):
    pitch = ROBOT.axes["x"].pitch
    effect = AxisEffect(
        axis="x", id="leadscrew_error", parameters={"period": period_in_pitches * pitch}
    )
    attached = AttachedEffect.of(ROBOT, effect)
    period = attached.formulation.find_parameter("period")
    low, high = tolerance(attached, period, RecordCoverage((0.0, 0.05), 10.0))
    assert (low, high) == pytest.approx((low_in_pitches * pitch, high_in_pitches * pitch))


def test_without_a_declared_pitch_the_screw_may_have_any_period():
    robot = replace(ROBOT, axes={"x": replace(ROBOT.axes["x"], pitch=None, steps_per_rev=None)})
    attached = AttachedEffect.of(robot, AxisEffect(axis="x", id="leadscrew_error"))
    period = attached.formulation.find_parameter("period")
    bounds = tolerance(attached, period, RecordCoverage((0.0, 0.05), 10.0))
    assert bounds == period.bounds(attached.facts)
