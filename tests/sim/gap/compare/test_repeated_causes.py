"""Causes that repeat another one: a mode at the resonance of the axis, a harmonic of a period."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.compare.repeated_causes import has_overtone, is_own_mode
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot


@pytest.mark.parametrize(("frequency_hz", "is_own"), [(302.0, True), (340.0, False)])
def test_a_mode_at_the_resonance_of_the_axis_is_not_another_mode(frequency_hz, is_own):
    mode = AxisEffect(axis="thx", id="flexible_mode", parameters={"frequency": frequency_hz})
    tuned = AxisEffect(axis="thx", id="resonance_mismatch", parameters={"frequency_error": 0.0})
    evidence = SimpleNamespace(robot=load_robot("rotemina"), axis="thx")
    explanation = SimpleNamespace(causes=(mode,), fit=SimpleNamespace(effects=(mode, tuned)))
    assert is_own_mode(evidence, explanation, explanation) is is_own


@pytest.mark.parametrize(
    ("second", "period", "with_ref", "overtone"),
    [
        ("encoder_interpolation", 1.0005e-3 / 3, False, True),
        ("encoder_interpolation", 1.0005e-3 / 3, True, False),
        ("microstep_error", 1e-3 / 5, True, True),
        ("encoder_interpolation", 1.03e-3 / 3, False, False),
        ("encoder_interpolation", 1e-3 / 50, False, False),
    ],
)
def test_a_cause_that_repeats_a_few_times_per_period_is_a_harmonic(
    second, period, with_ref, overtone
):
    evidence = SimpleNamespace(has=lambda tap: with_ref)
    causes = [
        AxisEffect(axis="x", id="leadscrew_error", parameters={"period": 1e-3}),
        AxisEffect(axis="x", id=second, parameters={"period": period}),
    ]
    assert has_overtone(evidence, SimpleNamespace(causes=causes)) is overtone
