"""What repeats another cause: a mode at the axis' own resonance, a harmonic of a period."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.compare.repeated_causes import has_overtone, is_own_mode
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect


@pytest.mark.parametrize(("frequency_hz", "own"), [(302.0, True), (340.0, False)])
def test_a_mode_at_the_axis_own_resonance_is_no_further_one(frequency_hz, own):
    mode = AxisEffect(axis="thx", id="flexible_mode", parameters={"frequency": frequency_hz})
    tuned = AxisEffect(axis="thx", id="resonance_mismatch", parameters={"frequency_error": 0.0})
    evidence = SimpleNamespace(robot=load_robot("rotemina"), axis="thx")
    one = SimpleNamespace(causes=(mode,), fit=SimpleNamespace(effects=(mode, tuned)))
    assert is_own_mode(evidence, one, one) is own


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
def test_what_repeats_a_few_times_a_period_is_a_harmonic(second, period, with_ref, overtone):
    evidence = SimpleNamespace(has=lambda tap: with_ref)
    causes = [
        AxisEffect(axis="x", id="leadscrew_error", parameters={"period": 1e-3}),
        AxisEffect(axis="x", id=second, parameters={"period": period}),
    ]
    assert has_overtone(evidence, SimpleNamespace(causes=causes)) is overtone
