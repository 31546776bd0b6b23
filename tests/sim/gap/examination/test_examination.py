"""Disturbances that count as a cause of the gap of an axis."""

import numpy as np
import pytest

from rotemina.sim.effects import EffectSignature
from rotemina.sim.gap.compare import untouched
from rotemina.sim.gap.examination.examination import _select_causal_disturbances
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.noise import Disturbance
from rotemina.sim.messages import message
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(("share", "counts"), [(0.4, False), (0.6, True)])
def test_a_drift_is_a_cause_if_it_is_most_of_the_remainder(share, counts):
    axis = ROBOT.axes["zn"]
    time_s = np.arange(1000) / 1000.0
    positions = sum(axis.range) / 2 + 0.1 * axis.span * np.sin(2.0 * np.pi * time_s)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): positions}, {"zn": axis.unit})
    delay = AxisEffect(axis="zn", id="delay", parameters={"delay": 1e-3})
    evidence = Evidence.of(
        ROBOT, "zn", [simulate(ROBOT, [delay], commands, np.random.default_rng(0))]
    )
    explanation = untouched(evidence)
    power = share * (explanation.by_tap[Tap.MEAS] - 1.0)
    drift = Disturbance(EffectSignature.WANDER, Tap.MEAS, power, message("gap", "It drifts."))
    assert bool(_select_causal_disturbances(evidence, evidence, explanation, (), drift)) is counts
