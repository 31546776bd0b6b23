"""What counts as a cause of an axis' gap."""

import numpy as np
import pytest

from rotemina.sim.effects.identification import Sign
from rotemina.sim.gap.compare.explanations import untouched
from rotemina.sim.gap.examination import _counting
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.noise.disturbances import Disturbance
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(("share", "counts"), [(0.4, False), (0.6, True)])
def test_a_drift_is_a_cause_if_it_is_most_of_what_is_left(share, counts):
    own = ROBOT.axes["zn"]
    time_s = np.arange(1000) / 1000.0
    swing = sum(own.range) / 2 + 0.1 * own.span * np.sin(2.0 * np.pi * time_s)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): swing}, {"zn": own.unit})
    late = AxisEffect(axis="zn", id="delay", parameters={"delay": 1e-3})
    seen = Evidence.of(ROBOT, "zn", [simulate(ROBOT, [late], commands, np.random.default_rng(0))])
    left = untouched(seen)
    power = share * (left.by_tap[Tap.MEAS] - 1.0)
    drift = Disturbance(Sign.WANDER, Tap.MEAS, power, message("gap", "It drifts."))
    assert bool(_counting(seen, seen, left, (), drift)) is counts
