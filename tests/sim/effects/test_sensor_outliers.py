"""Spikes and dropouts: they have their rate and size and come independently of each other."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
THRESHOLD_RAD = 5e-6  # over ten times the sensor's noise


def simulate_reading(formulation, rows=40_000, rate_hz=1000.0, **parameters):
    time_s = np.arange(rows) / rate_hz
    command = 5e-4 + 4e-4 * np.sin(2 * np.pi * 5.0 * time_s)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(
        axis="thx", id="sensor_outliers", formulation=formulation, parameters=parameters
    )
    response = simulate(ROBOT, [effect], record, np.random.default_rng(4))
    clean = simulate(ROBOT, (), record)
    return response.signal("thx", Tap.MEAS), clean.signal("thx", Tap.MEAS)


@pytest.mark.parametrize("rate_hz", [100.0, 1000.0])
def test_spikes_have_their_rate_at_any_sample_rate(rate_hz):
    reading, true = simulate_reading("spikes", rate_hz=rate_hz, rate=5.0, size=1e-4)
    events = np.count_nonzero(np.abs(reading - true) > THRESHOLD_RAD)
    expected = 40_000 * (1 - np.exp(-5.0 / rate_hz))
    assert abs(events - expected) < 4 * np.sqrt(expected)


def test_spikes_are_isolated_and_have_their_size_and_both_signs():
    reading, true = simulate_reading("spikes", rate=10.0, size=1e-4)
    error = reading - true
    rows = np.flatnonzero(np.abs(error) > THRESHOLD_RAD)
    sizes = error[rows]
    assert np.abs(sizes).mean() == pytest.approx(1e-4, rel=0.1)
    assert 0.48e-4 < np.abs(sizes).min() < 0.6e-4 < 1.4e-4 < np.abs(sizes).max() < 1.52e-4
    assert 0.4 < np.mean(sizes > 0) < 0.6
    assert np.mean(np.diff(rows) == 1) < 0.03
    is_good = np.abs(error) <= THRESHOLD_RAD
    assert error[is_good].std() == pytest.approx(ROBOT.axes["thx"].sensor.noise_floor, rel=0.05)


@pytest.mark.parametrize(("duration", "length"), [(0.0, 1.0), (0.0095, 10.0)])
def test_a_dropout_reads_zero_for_its_duration(duration, length):
    reading, _ = simulate_reading("dropouts_to_zero", rate=2.0, duration=duration)
    lost = reading == 0.0
    events = np.count_nonzero(np.diff(lost.astype(int)) == 1)
    assert 50 < events < 115
    assert np.count_nonzero(lost) / events == pytest.approx(length, rel=0.1)


def test_a_held_dropout_repeats_the_last_good_value():
    reading, true = simulate_reading("dropouts_held", rate=2.0, duration=0.0395)
    lost = np.abs(reading - true) > THRESHOLD_RAD
    begins = [row for row in np.flatnonzero(lost) if not lost[max(row - 60, 0) : row].any()]
    assert len(begins) > 20
    for row in begins:
        held_values = reading[row + 1 : row + 20]
        assert np.ptp(held_values) == 0.0  # exactly, without noise
        assert np.abs(held_values.mean() - true[row - 3 : row + 2]).min() < THRESHOLD_RAD
