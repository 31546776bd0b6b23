"""Transport delay of any length: the phase grows with frequency, and the gain stays 1."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
RATE_HZ = 2000.0


def simulate_axis(command, delay_s=None, tap=Tap.REF):
    time_s = np.arange(len(command)) / RATE_HZ
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effects = []
    if delay_s is not None:
        effects = [AxisEffect(axis="thx", id="delay", parameters={"delay": delay_s})]
    return simulate(ROBOT, effects, record).signal("thx", tap)


@pytest.mark.parametrize(("frequency_hz", "delay_s"), [(5.0, 1.37e-3), (150.0, 5e-4)])
def test_the_phase_is_proportional_to_frequency_and_the_gain_is_one(frequency_hz, delay_s):
    time_s = np.arange(8000) / RATE_HZ
    command = 5e-4 + 1e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    rotation = np.exp(-2j * np.pi * frequency_hz * time_s)[4000:]
    ratio = np.sum(simulate_axis(command, delay_s)[4000:] * rotation)
    ratio /= np.sum(simulate_axis(command)[4000:] * rotation)
    assert abs(ratio) == pytest.approx(1.0, abs=2e-3)
    expected = -2 * np.pi * frequency_hz * delay_s
    assert np.angle(ratio / np.exp(1j * expected)) == pytest.approx(0.0, abs=5e-3)


def test_whole_samples_shift_the_response_and_no_delay_is_nominal():
    rng = np.random.default_rng(2)
    command = np.concatenate([np.full(5, 3e-4), rng.uniform(2e-4, 9e-4, 300)])
    clean = simulate_axis(command)
    np.testing.assert_array_equal(simulate_axis(command, 0.0), clean)
    np.testing.assert_allclose(simulate_axis(command, 3 / RATE_HZ)[3:], clean[:-3], atol=1e-15)
    u = simulate_axis(command, 2.5 / RATE_HZ, Tap.U)
    np.testing.assert_allclose(u[3:], simulate_axis(command, None, Tap.U)[:-3], atol=1e-9)


def simulate_static_axis(command, delay_s):
    robot = load_robot("picma")
    time_s = np.arange(len(command)) / 200.0
    record = Record.from_signals(time_s, {("p", Tap.CMD): command}, {"p": "m"})
    delay = AxisEffect(axis="p", id="delay", parameters={"delay": delay_s})
    return simulate(robot, [delay], record).signal("p", Tap.REF)


def test_the_response_of_a_static_axis_is_continuous_in_the_delay():
    command = 2e-5 + np.random.default_rng(3).uniform(-1e-5, 1e-5, 400)
    for samples in (0.0, 1.0, 3.0):
        whole_samples = simulate_static_axis(command, samples / 200.0)
        slightly_later = simulate_static_axis(command, (samples + 1e-6) / 200.0)
        np.testing.assert_allclose(slightly_later, whole_samples, atol=1e-10)
    half_sample = simulate_static_axis(command, 0.5 / 200.0)
    np.testing.assert_allclose(half_sample[1:], (command[1:] + command[:-1]) / 2.0, rtol=1e-9)
