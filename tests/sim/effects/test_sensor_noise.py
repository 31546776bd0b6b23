"""Noise beyond the declared: white, normal, of the asked size, and without memory."""

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
RMS = 5e-6
ROWS = 20_000


def scatter(rate_hz, amplitude=0.0):
    time_s = np.arange(ROWS) / rate_hz
    command = 5e-4 + amplitude * np.sin(2 * np.pi * 3.0 * time_s)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(axis="thx", id="sensor_noise", parameters={"rms": RMS})
    answer = simulate(ROBOT, [effect], record, np.random.default_rng(7))
    clean = simulate(ROBOT, (), record)
    return answer.signal("thx", Tap.MEAS) - clean.signal("thx", Tap.MEAS)


@pytest.mark.parametrize("rate_hz", [200.0, 20_000.0])
def test_its_size_is_the_root_sum_of_its_own_and_the_declared_at_any_rate(rate_hz):
    declared = ROBOT.axes["thx"].sensor.noise_floor
    assert scatter(rate_hz).std() == pytest.approx(np.hypot(RMS, declared), rel=0.02)


def test_it_is_white():
    noise = scatter(2000.0)
    noise -= noise.mean()
    for lag in (1, 2, 5, 50, 500):
        likeness = np.dot(noise[lag:], noise[:-lag]) / np.dot(noise, noise)
        assert abs(likeness) < 4 / np.sqrt(ROWS), lag


def test_it_is_normal():
    noise = scatter(2000.0) / np.hypot(RMS, ROBOT.axes["thx"].sensor.noise_floor)
    assert abs(np.mean(noise**3)) < 4 * np.sqrt(15 / ROWS)
    assert np.mean(noise**4) == pytest.approx(3.0, abs=4 * np.sqrt(96 / ROWS))


def test_it_is_the_same_whether_the_axis_moves_or_not():
    np.testing.assert_allclose(scatter(2000.0, 3e-4), scatter(2000.0), atol=1.5e-7)
