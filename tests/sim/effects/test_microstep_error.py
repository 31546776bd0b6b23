"""Microstep error: locked to the commanded position, once in four full steps, at any speed."""

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
PERIOD = 20e-6


def gap(command, **parameters):
    time_s = np.arange(len(command)) / 1000.0
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id="microstep_error", parameters=parameters)
    with_effect, without = (simulate(ROBOT, e, record).signal("x", Tap.REF) for e in ([effect], []))
    return with_effect - without


@pytest.mark.parametrize("speed", [2e-5, 1e-4, -5e-5])
def test_two_harmonics_of_the_position_at_any_speed(speed):
    command = 0.0275 + speed * np.arange(4000) / 1000.0
    found = gap(command, sine=2e-7, cosine=1e-7, sine_2=-5e-8, cosine_2=3e-8)
    angle = 2 * np.pi * (command - 0.0275) / PERIOD
    waves = [np.sin(angle), np.cos(angle), np.sin(2 * angle), np.cos(2 * angle)]
    weights = np.linalg.lstsq(np.stack(waves, 1)[100:], found[100:], rcond=None)[0]
    lag = 2 * np.pi * abs(speed) / PERIOD * 8e-4  # rad; the mechanics answer a little later
    np.testing.assert_allclose(weights, [2e-7, 1e-7, -5e-8, 3e-8], atol=2.5e-7 * (lag + 1e-3))


def test_it_repeats_every_four_full_steps_and_no_amplitude_is_nominal():
    places = 0.01 + PERIOD * np.array([0.0, 1.0, 7.0, 0.3, 4.3])
    found = [gap(np.full(3, place))[-1] for place in places]
    np.testing.assert_allclose(found[:3], found[0], atol=1e-12)
    assert found[3] == pytest.approx(found[4], abs=1e-12)
    assert abs(found[0] - found[3]) > 1e-8
    none = dict.fromkeys(("sine", "cosine", "sine_2", "cosine_2"), 0.0)
    assert np.abs(gap(np.linspace(0.01, 0.0101, 50), **none)).max() == 0.0


def test_the_mechanics_filter_it():
    fast = 300.0 * PERIOD  # the error comes at 300 Hz, well above the axis' 112 Hz
    found = gap(0.01 + fast * np.arange(1500) / 1000.0, sine=1e-6, sine_2=0.0)[-500:]
    assert np.abs(found).max() < 0.4e-6
