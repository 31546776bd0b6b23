"""A disturbance at one time does not determine the fit of all other times."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.row_weights import huber_weighted
from rotemina.sim.gap.fit import Evidence, fit
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
PLAY = AxisEffect(axis="x", id="backlash", parameters={"width": 4e-6})


def make_evidence(extra_floors):
    """Return evidence of a play, with a disturbance of 200 rows, in floors."""
    time_s = np.arange(1600) / 100.0
    command = 0.015 + 2e-3 * np.sin(2.0 * np.pi * 0.5 * time_s) + 1e-3 * np.sin(2.3 * time_s)
    commands = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    record = simulate(ROBOT, [PLAY], commands, np.random.default_rng(5))
    floor = Evidence.of(ROBOT, "x", [record]).floor(Tap.MEAS)
    reading = record.signal("x", Tap.MEAS).copy()
    reading[900:1100] += extra_floors * floor * np.sign(np.gradient(command))[900:1100]
    signals = {("x", Tap.CMD): command, ("x", Tap.MEAS): reading}
    return Evidence.of(ROBOT, "x", [Record.from_signals(time_s, signals, {"x": "m"})])


def fit_width(evidence):
    return fit(evidence, [AxisEffect(axis="x", id="backlash")]).effects[0].parameters["width"]


def test_a_disturbed_part_of_a_record_does_not_distort_a_fit():
    evidence = make_evidence(extra_floors=300.0)
    unweighted_fit = fit(evidence, [AxisEffect(axis="x", id="backlash")])
    weighted = huber_weighted(evidence, [unweighted_fit.residual])
    assert weighted is not None
    true_width = PLAY.parameters["width"]
    assert abs(fit_width(weighted) - true_width) < 0.1 * abs(
        unweighted_fit.effects[0].parameters["width"] - true_width
    )
    (weight,) = (observation.weight[Tap.MEAS] for observation in weighted.observations)
    assert weight[950:1050].max() < 0.5 < weight[:850].min()
    assert weighted.unweighted().residual() == pytest.approx(evidence.residual())


def test_an_even_remainder_keeps_its_weights():
    evidence = make_evidence(extra_floors=0.0)
    assert huber_weighted(evidence, [fit(evidence, [PLAY]).residual]) is None
    assert evidence.unweighted() is evidence
