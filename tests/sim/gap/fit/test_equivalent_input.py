"""A gap is undone to what caused it at the input."""

import numpy as np

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.gap.compare.explanations import untouched
from rotemina.sim.gap.fit.equivalent_input import inputs_left
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


def recorded(axis, effects, *shares, rate_hz=1000.0, seed=0):
    """Sweeps of growing pace over shares of the range, one record each."""
    own, rng = ROBOT.axes[axis], np.random.default_rng(seed)
    records = []
    for share in shares:
        time_s = np.arange(6000) / rate_hz
        wave = np.sin(2.0 * np.pi * (0.1 * time_s + 0.05 * time_s**2))
        command = sum(own.range) / 2 + share * own.span * wave
        record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: own.unit})
        records.append(simulate(ROBOT, effects, record, rng))
    return records


def test_a_ringing_gap_is_undone_to_what_caused_it_at_the_input():
    steps = AxisEffect(axis="thx", id="quantization", parameters={"step": 0.6, "shift": 0.0})
    records = recorded("thx", [steps], 0.2)
    evidence = Evidence.of(ROBOT, "thx", records)
    clean = simulate(ROBOT, [], records[0])
    wanted = records[0].signal("thx", Tap.U) - clean.signal("thx", Tap.U)
    wanted = (wanted - wanted.mean()) * Attached.of(ROBOT, steps).facts.gain
    for part, found in inputs_left(evidence, untouched(evidence).fit):
        inner = slice(400, -400)  # ends are tapered
        likeness = np.corrcoef(found[inner], wanted[inner])[0, 1]
        assert likeness > (0.97 if part.tap is not Tap.MEAS else 0.8), part.tap
