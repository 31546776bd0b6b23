"""Microstep error: a function of the command with a period of four full steps, at any speed."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
PERIOD = 20e-6


def simulate_gap(command, **parameters):
    time_s = np.arange(len(command)) / 1000.0
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id="microstep_error", parameters=parameters)
    with_effect, without = (
        simulate(ROBOT, effects, record).signal("x", Tap.REF) for effects in ([effect], [])
    )
    return with_effect - without


@pytest.mark.parametrize("speed", [2e-5, 1e-4, -5e-5])
def test_the_error_has_two_harmonics_of_the_position_at_any_speed(speed):
    command = 0.0275 + speed * np.arange(4000) / 1000.0
    gap = simulate_gap(command, sine=2e-7, cosine=1e-7, sine_2=-5e-8, cosine_2=3e-8)
    angle = 2 * np.pi * (command - 0.0275) / PERIOD
    waves = [np.sin(angle), np.cos(angle), np.sin(2 * angle), np.cos(2 * angle)]
    weights = np.linalg.lstsq(np.stack(waves, 1)[100:], gap[100:], rcond=None)[0]
    lag = 2 * np.pi * abs(speed) / PERIOD * 8e-4  # rad, lag of the mechanics
    np.testing.assert_allclose(weights, [2e-7, 1e-7, -5e-8, 3e-8], atol=2.5e-7 * (lag + 1e-3))


def test_the_error_repeats_every_four_full_steps_and_zero_amplitude_is_nominal():
    positions = 0.01 + PERIOD * np.array([0.0, 1.0, 7.0, 0.3, 4.3])
    gaps = [simulate_gap(np.full(3, position))[-1] for position in positions]
    np.testing.assert_allclose(gaps[:3], gaps[0], atol=1e-12)
    assert gaps[3] == pytest.approx(gaps[4], abs=1e-12)
    assert abs(gaps[0] - gaps[3]) > 1e-8
    no_amplitudes = dict.fromkeys(("sine", "cosine", "sine_2", "cosine_2"), 0.0)
    assert np.abs(simulate_gap(np.linspace(0.01, 0.0101, 50), **no_amplitudes)).max() == 0.0


def test_the_mechanics_filter_the_error():
    # The error has 300 Hz, well above the 112 Hz of the axis.
    speed = 300.0 * PERIOD
    gap = simulate_gap(0.01 + speed * np.arange(1500) / 1000.0, sine=1e-6, sine_2=0.0)[-500:]
    assert np.abs(gap).max() < 0.4e-6
