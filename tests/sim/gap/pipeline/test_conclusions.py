"""Figures derived for a cause."""

import numpy as np
import pytest

from rotemina.sim.gap.compare import explain
from rotemina.sim.gap.fit import Evidence, block_rows
from rotemina.sim.gap.pipeline.conclusions import derive_figures
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def make_evidence(delay_s):
    """Return evidence of zn, which moves slowly compared with its resonance, with a delay."""
    time_s = np.arange(1500) * 2e-3
    axis = ROBOT.axes["zn"]
    wave = np.sin(9.0 * time_s) * np.minimum(time_s, 1.0)
    commands = Record.from_signals(
        time_s, {("zn", Tap.CMD): sum(axis.range) / 2.0 + 0.2 * axis.span * wave}, {"zn": "m"}
    )
    delay = AxisEffect(axis="zn", id="delay", parameters={"delay": delay_s})
    full_record = simulate(ROBOT, [delay], commands, np.random.default_rng(0))
    signals = {("zn", tap): full_record.signal("zn", tap) for tap in (Tap.CMD, Tap.MEAS)}
    return Evidence.of(ROBOT, "zn", [Record.from_signals(time_s, signals, {"zn": "m"})])


@pytest.mark.parametrize(
    ("effect", "start"), [("delay", {"delay": 2.8e-3}), ("amplifier_lag", {"time_constant": 2e-3})]
)
def test_the_lateness_does_not_depend_on_the_effect_that_explains_it(effect, start):
    evidence = make_evidence(3e-3)
    explanation = explain(evidence, [AxisEffect(axis="zn", id=effect, parameters=start)])
    (lateness,) = derive_figures(evidence, explanation, explanation.causes[0])
    assert (lateness.name, lateness.unit) == ("lateness", "s")
    assert lateness.value == pytest.approx(3e-3, rel=0.1)
    low, high = lateness.interval
    assert 0.0 <= low < lateness.value < high < 4e-3


def test_an_effect_without_delay_has_no_lateness():
    evidence = make_evidence(3e-3)
    explanation = explain(evidence, [AxisEffect(axis="zn", id="hysteresis")])
    assert derive_figures(evidence, explanation, explanation.causes[0]) == ()


def test_a_deviation_is_proportional_to_its_direction():
    evidence = make_evidence(3e-3)
    fitted = explain(evidence, [AxisEffect(axis="zn", id="delay")]).fit
    numbers = block_rows(evidence)
    axes = np.eye(len(fitted.free))
    assert fitted.deviation(numbers)[0] > 0.0
    assert fitted.deviation_along(2.0 * axes[:1], numbers)[0] == pytest.approx(
        2.0 * fitted.deviation(numbers)[0]
    )
