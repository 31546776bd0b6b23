"""Noise in addition to the declared noise: white, normal, and of its rms."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
RMS = 5e-6
ROWS = 20_000


def simulate_noise(rate_hz, amplitude=0.0):
    time_s = np.arange(ROWS) / rate_hz
    command = 5e-4 + amplitude * np.sin(2 * np.pi * 3.0 * time_s)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(axis="thx", id="sensor_noise", parameters={"rms": RMS})
    response = simulate(ROBOT, [effect], record, np.random.default_rng(7))
    clean = simulate(ROBOT, (), record)
    return response.signal("thx", Tap.MEAS) - clean.signal("thx", Tap.MEAS)


@pytest.mark.parametrize("rate_hz", [200.0, 20_000.0])
def test_the_rms_is_the_root_sum_square_with_the_declared_noise_at_any_rate(rate_hz):
    declared = ROBOT.axes["thx"].sensor.noise_floor
    assert simulate_noise(rate_hz).std() == pytest.approx(np.hypot(RMS, declared), rel=0.02)


def test_the_noise_is_white():
    noise = simulate_noise(2000.0)
    noise -= noise.mean()
    for lag in (1, 2, 5, 50, 500):
        correlation = np.dot(noise[lag:], noise[:-lag]) / np.dot(noise, noise)
        assert abs(correlation) < 4 / np.sqrt(ROWS), lag


def test_the_noise_is_normally_distributed():
    noise = simulate_noise(2000.0) / np.hypot(RMS, ROBOT.axes["thx"].sensor.noise_floor)
    assert abs(np.mean(noise**3)) < 4 * np.sqrt(15 / ROWS)
    assert np.mean(noise**4) == pytest.approx(3.0, abs=4 * np.sqrt(96 / ROWS))


def test_the_noise_does_not_depend_on_the_motion():
    np.testing.assert_allclose(simulate_noise(2000.0, 3e-4), simulate_noise(2000.0), atol=1.5e-7)
