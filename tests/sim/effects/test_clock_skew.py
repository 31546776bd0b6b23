"""A clock that runs at another rate: a lag of the reading that grows along the record."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import Simulation, simulate

ROBOT = load_robot("rotemina")


def driven(skew, frequency_hz=7.0, seconds=20.0, rate_hz=1000.0, start_s=0.0, rng=None):
    time_s = np.arange(int(seconds * rate_hz)) / rate_hz
    command = 5e-4 + 4e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    record = Record.from_signals(time_s + start_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(axis="thx", id="clock_skew", parameters={"skew": skew})
    return record, simulate(ROBOT, [effect], record, rng)


@pytest.mark.parametrize("skew", [-300.0, -20.0, 20.0, 300.0, 2500.0])
@pytest.mark.parametrize("start_s", [0.0, 1000.0])
def test_the_lag_grows_with_the_asked_slope(skew, start_s):
    """From far below a sample to fifty of them, counted from the start of the run."""
    record, answer = driven(skew, start_s=start_s)
    time_s = record.time_s - start_s
    turning = np.exp(-2j * np.pi * 7.0 * time_s)
    lags = []
    rows = np.arange(3000, 18_000, 1000)  # blocks of whole periods
    for row in rows:
        own = slice(row, row + 1000)
        between = np.sum(answer.signal("thx", Tap.REF)[own] * turning[own])
        between /= np.sum(answer.signal("thx", Tap.MEAS)[own] * turning[own])
        lags.append(np.angle(between) / (2 * np.pi * 7.0))
    slope, first = np.polyfit(time_s[rows + 500], np.unwrap(lags, period=1 / 7), 1)
    assert slope == pytest.approx(1e-6 * skew, rel=2e-3)
    assert first == pytest.approx(0.0, abs=2e-5 + 2e-8 * abs(skew))


def test_fractions_of_a_sample_are_as_right_as_whole_ones():
    record, answer = driven(137.0, frequency_hz=20.0, seconds=5.0, rate_hz=4000.0)
    fine_s = np.arange(200_000) / 40_000
    command = np.repeat(record.signal("thx", Tap.CMD), 10)
    fine = Record.from_signals(fine_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    true = simulate(ROBOT, (), fine).signal("thx", Tap.REF)
    expected = np.interp(record.time_s * (1 - 137e-6), fine_s, true)
    gap = answer.signal("thx", Tap.MEAS) - expected
    assert np.abs(gap).max() < 5e-8


def test_a_live_run_that_lags_is_the_run_at_once():
    record, whole = driven(5000.0, seconds=4.0)
    effect = AxisEffect(axis="thx", id="clock_skew", parameters={"skew": 5000.0})
    live = Simulation(ROBOT, [effect], record)
    read = [
        live.follow(record.part(slice(row, row + 20))).signal("thx", Tap.MEAS)
        for row in range(0, 4000, 20)
    ]
    np.testing.assert_allclose(np.concatenate(read), whole.signal("thx", Tap.MEAS), atol=1e-15)


def test_noise_is_that_of_the_same_samples_and_readings_keep_their_steps():
    record, answer = driven(300.0, seconds=2.0, rng=np.random.default_rng(1))
    clean = simulate(ROBOT, (), record, np.random.default_rng(1))
    steps = answer.signal("thx", Tap.MEAS) / ROBOT.axes["thx"].sensor.resolution
    np.testing.assert_allclose(steps, np.rint(steps), atol=1e-6)
    late = driven(300.0, seconds=2.0)[1].signal("thx", Tap.MEAS)
    noise = answer.signal("thx", Tap.MEAS) - late
    same = clean.signal("thx", Tap.MEAS) - simulate(ROBOT, (), record).signal("thx", Tap.MEAS)
    np.testing.assert_allclose(noise, same, atol=1.01 * ROBOT.axes["thx"].sensor.resolution)


def test_uneven_samples_are_read_at_their_own_times():
    rng = np.random.default_rng(0)
    time_s = np.cumsum(rng.uniform(0.5e-4, 2e-4, 4000))
    command = 5e-4 + 4e-4 * np.sin(2 * np.pi * 2.0 * time_s)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    slow = replace(ROBOT.axes["thx"], damping=0.1)
    robot = replace(ROBOT, axes={"thx": slow}, couplings=(), stages={})
    effect = AxisEffect(axis="thx", id="clock_skew", parameters={"skew": 1e4})
    answer = simulate(robot, [effect], record)
    since = time_s - time_s[0]
    expected = np.interp(since - 1e-2 * since, since, answer.signal("thx", Tap.REF))
    np.testing.assert_allclose(answer.signal("thx", Tap.MEAS), expected, atol=1e-7)
