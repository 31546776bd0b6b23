"""Reconstruction of the equivalent input that caused a gap."""

import numpy as np

from rotemina.sim.effects import AttachedEffect
from rotemina.sim.gap.compare import untouched
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.fit.equivalent_input import inputs_left
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def simulate_records(axis, effects, *shares, rate_hz=1000.0, seed=0):
    """Return records of sweeps of increasing frequency, one for each share of the range."""
    description, rng = ROBOT.axes[axis], np.random.default_rng(seed)
    records = []
    for share in shares:
        time_s = np.arange(6000) / rate_hz
        wave = np.sin(2.0 * np.pi * (0.1 * time_s + 0.05 * time_s**2))
        command = sum(description.range) / 2 + share * description.span * wave
        record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: description.unit})
        records.append(simulate(ROBOT, effects, record, rng))
    return records


def test_the_cause_of_an_oscillating_gap_is_reconstructed_at_the_input():
    steps = AxisEffect(axis="thx", id="quantization", parameters={"step": 0.6, "shift": 0.0})
    records = simulate_records("thx", [steps], 0.2)
    evidence = Evidence.of(ROBOT, "thx", records)
    nominal = simulate(ROBOT, [], records[0])
    true_input = records[0].signal("thx", Tap.U) - nominal.signal("thx", Tap.U)
    true_input = (true_input - true_input.mean()) * AttachedEffect.of(ROBOT, steps).facts.gain
    for part, input_found in inputs_left(evidence, untouched(evidence).fit):
        # The ends are tapered.
        inner_rows = slice(400, -400)
        correlation = np.corrcoef(input_found[inner_rows], true_input[inner_rows])[0, 1]
        assert correlation > (0.97 if part.tap is not Tap.MEAS else 0.8), part.tap
