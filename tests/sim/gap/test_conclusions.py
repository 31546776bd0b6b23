"""What is told of a cause."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.explanations import explain
from rotemina.sim.gap.conclusions import derived
from rotemina.sim.gap.fit.evidence import Evidence, block_rows
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


def swung(late_s):
    """A record of zn, slow beside its ring, that comes late."""
    time_s = np.arange(1500) * 2e-3
    own = ROBOT.axes["zn"]
    wave = np.sin(9.0 * time_s) * np.minimum(time_s, 1.0)
    commands = Record.from_signals(
        time_s, {("zn", Tap.CMD): sum(own.range) / 2.0 + 0.2 * own.span * wave}, {"zn": "m"}
    )
    late = AxisEffect(axis="zn", id="delay", parameters={"delay": late_s})
    whole = simulate(ROBOT, [late], commands, np.random.default_rng(0))
    signals = {("zn", tap): whole.signal("zn", tap) for tap in (Tap.CMD, Tap.MEAS)}
    return Evidence.of(ROBOT, "zn", [Record.from_signals(time_s, signals, {"zn": "m"})])


@pytest.mark.parametrize(
    ("effect", "start"), [("delay", {"delay": 2.8e-3}), ("amplifier_lag", {"time_constant": 2e-3})]
)
def test_how_late_an_axis_is_holds_whatever_effect_it_is_told_by(effect, start):
    evidence = swung(3e-3)
    found = explain(evidence, [AxisEffect(axis="zn", id=effect, parameters=start)])
    (lateness,) = derived(evidence, found, found.causes[0])
    assert (lateness.name, lateness.unit) == ("lateness", "s")
    assert lateness.value == pytest.approx(3e-3, rel=0.1)
    low, high = lateness.interval
    assert 0.0 <= low < lateness.value < high < 4e-3


def test_what_makes_nothing_late_tells_no_lateness():
    evidence = swung(3e-3)
    found = explain(evidence, [AxisEffect(axis="zn", id="hysteresis")])
    assert derived(evidence, found, found.causes[0]) == ()


def test_a_deviation_grows_with_its_direction():
    evidence = swung(3e-3)
    fitted = explain(evidence, [AxisEffect(axis="zn", id="delay")]).fit
    numbers = block_rows(evidence)
    axes = np.eye(len(fitted.free))
    assert fitted.deviation(numbers)[0] > 0.0
    assert fitted.deviation_along(2.0 * axes[:1], numbers)[0] == pytest.approx(
        2.0 * fitted.deviation(numbers)[0]
    )
