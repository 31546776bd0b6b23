"""Clock skew: a clock at another rate makes the reading lag more and more along the record."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def simulate_sine(skew, frequency_hz=7.0, seconds=20.0, rate_hz=1000.0, start_s=0.0, rng=None):
    time_s = np.arange(int(seconds * rate_hz)) / rate_hz
    command = 5e-4 + 4e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    record = Record.from_signals(time_s + start_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(axis="thx", id="clock_skew", parameters={"skew": skew})
    return record, simulate(ROBOT, [effect], record, rng)


@pytest.mark.parametrize(("skew", "start_s"), [(-300.0, 0.0), (20.0, 1000.0), (2500.0, 0.0)])
def test_the_lag_grows_at_the_skew_rate(skew, start_s):
    """The lag ranges from a fraction of a sample to fifty samples since the start of the run."""
    record, response = simulate_sine(skew, start_s=start_s)
    time_s = record.time_s - start_s
    rotation = np.exp(-2j * np.pi * 7.0 * time_s)
    lags = []
    rows = np.arange(3000, 18_000, 1000)  # blocks of whole periods
    for row in rows:
        block = slice(row, row + 1000)
        ratio = np.sum(response.signal("thx", Tap.REF)[block] * rotation[block])
        ratio /= np.sum(response.signal("thx", Tap.MEAS)[block] * rotation[block])
        lags.append(np.angle(ratio) / (2 * np.pi * 7.0))
    slope, initial_lag = np.polyfit(time_s[rows + 500], np.unwrap(lags, period=1 / 7), 1)
    assert slope == pytest.approx(1e-6 * skew, rel=2e-3)
    assert initial_lag == pytest.approx(0.0, abs=2e-5 + 2e-8 * abs(skew))


def test_lags_of_a_fraction_of_a_sample_are_exact():
    record, response = simulate_sine(137.0, frequency_hz=20.0, seconds=5.0, rate_hz=4000.0)
    fine_s = np.arange(200_000) / 40_000
    command = np.repeat(record.signal("thx", Tap.CMD), 10)
    fine = Record.from_signals(fine_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    true = simulate(ROBOT, (), fine).signal("thx", Tap.REF)
    expected = np.interp(record.time_s * (1 - 137e-6), fine_s, true)
    gap = response.signal("thx", Tap.MEAS) - expected
    assert np.abs(gap).max() < 5e-8


def test_noise_and_resolution_of_the_reading_stay_the_same():
    record, response = simulate_sine(300.0, seconds=2.0, rng=np.random.default_rng(1))
    clean = simulate(ROBOT, (), record, np.random.default_rng(1))
    steps = response.signal("thx", Tap.MEAS) / ROBOT.axes["thx"].sensor.resolution
    np.testing.assert_allclose(steps, np.rint(steps), atol=1e-6)
    noiseless = simulate_sine(300.0, seconds=2.0)[1].signal("thx", Tap.MEAS)
    noise = response.signal("thx", Tap.MEAS) - noiseless
    noise_without_skew = clean.signal("thx", Tap.MEAS) - simulate(ROBOT, (), record).signal(
        "thx", Tap.MEAS
    )
    np.testing.assert_allclose(
        noise, noise_without_skew, atol=1.01 * ROBOT.axes["thx"].sensor.resolution
    )


def test_uneven_samples_are_read_at_their_own_times():
    rng = np.random.default_rng(0)
    time_s = np.cumsum(rng.uniform(0.5e-4, 2e-4, 4000))
    command = 5e-4 + 4e-4 * np.sin(2 * np.pi * 2.0 * time_s)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    slow_axis = replace(ROBOT.axes["thx"], damping=0.1)
    robot = replace(ROBOT, axes={"thx": slow_axis}, couplings=(), stages={})
    effect = AxisEffect(axis="thx", id="clock_skew", parameters={"skew": 1e4})
    response = simulate(robot, [effect], record)
    elapsed_s = time_s - time_s[0]
    expected = np.interp(elapsed_s - 1e-2 * elapsed_s, elapsed_s, response.signal("thx", Tap.REF))
    np.testing.assert_allclose(response.signal("thx", Tap.MEAS), expected, atol=1e-7)
