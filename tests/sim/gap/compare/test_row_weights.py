"""What the machine does besides at one time does not decide about all other times."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.row_weights import huber_weighted
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
PLAY = AxisEffect(axis="x", id="backlash", parameters={"width": 4e-6})


def recorded(besides):
    """Return evidence of a play, and of what the machine does ``besides`` at 200 rows, floors."""
    time_s = np.arange(1600) / 100.0
    command = 0.015 + 2e-3 * np.sin(2.0 * np.pi * 0.5 * time_s) + 1e-3 * np.sin(2.3 * time_s)
    commands = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    seen = simulate(ROBOT, [PLAY], commands, np.random.default_rng(5))
    floor = Evidence.of(ROBOT, "x", [seen]).floor(Tap.MEAS)
    read = seen.signal("x", Tap.MEAS).copy()
    read[900:1100] += besides * floor * np.sign(np.gradient(command))[900:1100]
    signals = {("x", Tap.CMD): command, ("x", Tap.MEAS): read}
    return Evidence.of(ROBOT, "x", [Record.from_signals(time_s, signals, {"x": "m"})])


def width(evidence):
    return fit(evidence, [AxisEffect(axis="x", id="backlash")]).effects[0].parameters["width"]


def test_one_bad_time_of_a_record_no_longer_bends_a_fit():
    evidence = recorded(besides=300.0)
    bent = fit(evidence, [AxisEffect(axis="x", id="backlash")])
    weighted = huber_weighted(evidence, [bent.residual])
    assert weighted is not None
    true = PLAY.parameters["width"]
    assert abs(width(weighted) - true) < 0.1 * abs(bent.effects[0].parameters["width"] - true)
    (weight,) = (one.weight[Tap.MEAS] for one in weighted.observations)
    assert weight[950:1050].max() < 0.5 < weight[:850].min()
    assert weighted.unweighted().residual() == pytest.approx(evidence.residual())


def test_what_is_left_evenly_keeps_its_weights():
    evidence = recorded(besides=0.0)
    assert huber_weighted(evidence, [fit(evidence, [PLAY]).residual]) is None
    assert evidence.unweighted() is evidence
