"""Power that hypotheses leave in held-out data, and the number of effective rows."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.held_out_power import MOST_COUNTED, effective_rows, held_out_powers
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def test_correlated_neighbours_count_as_fewer_rows():
    noise = np.random.default_rng(0).standard_normal(4000)
    assert effective_rows(noise) == pytest.approx(4000, rel=0.5)
    slow = np.convolve(noise, np.ones(50) / 50.0, "same")
    assert effective_rows(slow) < 300
    assert effective_rows(np.zeros(100)) == 100


def test_reading_and_reference_share_the_motion_of_the_machine():
    """A remainder in both taps counts only once against a hypothesis: the sensor adds nothing."""
    time_s = np.arange(1000) * 0.01
    axis = ROBOT.axes["zn"]
    command = sum(axis.range) / 2.0 + 0.2 * axis.span * np.sin(time_s)
    signals = {("zn", Tap.CMD): command, ("zn", Tap.REF): command, ("zn", Tap.MEAS): command}
    record = Record.from_signals(time_s, signals, {"zn": "m"})
    evidence = Evidence.of(ROBOT, "zn", [record])
    floor = evidence.observations[0].floor
    remainder_m = 5e-8 * np.sin(3.0 * time_s)
    residual = np.concatenate([remainder_m / floor[part.tap] for part in evidence.parts])
    reference, beyond = held_out_powers(evidence, [residual])
    assert reference.squares.sum() > 1000.0
    assert beyond.squares.sum() == pytest.approx(0.0, abs=1e-12)
    assert 1.0 < reference.counted < MOST_COUNTED
