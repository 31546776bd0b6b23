"""What hypotheses leave of held-out data, in rows that count."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.held_out_power import MOST_COUNTED, effective_rows, held_out_powers
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")


def test_neighbours_that_are_alike_count_as_fewer_rows():
    noise = np.random.default_rng(0).standard_normal(4000)
    assert effective_rows(noise) == pytest.approx(4000, rel=0.5)
    slow = np.convolve(noise, np.ones(50) / 50.0, "same")
    assert effective_rows(slow) < 300
    assert effective_rows(np.zeros(100)) == 100


def test_reading_and_reference_share_what_the_machine_does():
    """A remainder that both see is held against a hypothesis once: what the sensor adds is none."""
    time_s = np.arange(1000) * 0.01
    own = ROBOT.axes["zn"]
    command = sum(own.range) / 2.0 + 0.2 * own.span * np.sin(time_s)
    signals = {("zn", Tap.CMD): command, ("zn", Tap.REF): command, ("zn", Tap.MEAS): command}
    record = Record.from_signals(time_s, signals, {"zn": "m"})
    evidence = Evidence.of(ROBOT, "zn", [record])
    floor = evidence.observations[0].floor
    moved = 5e-8 * np.sin(3.0 * time_s)
    left = np.concatenate([moved / floor[part.tap] for part in evidence.parts])
    reference, beyond = held_out_powers(evidence, [left])
    assert reference.squares.sum() > 1000.0
    assert beyond.squares.sum() == pytest.approx(0.0, abs=1e-12)
    assert 1.0 < reference.counted < MOST_COUNTED
