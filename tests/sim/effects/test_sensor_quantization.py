"""Quantization of a reading: sharp steps at any speed, on a grid that may be shifted."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
STEP = 2e-5


def simulate_reading(frequency_hz=1.0, **parameters):
    time_s = np.arange(20_000) / 10_000
    command = 5e-4 + 4e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(axis="thx", id="sensor_quantization", parameters=parameters)
    response = simulate(ROBOT, [effect], record)
    return response.signal("thx", Tap.MEAS), response.signal("thx", Tap.REF)


@pytest.mark.parametrize("frequency_hz", [1.0, 40.0])
@pytest.mark.parametrize("shift", [0.0, 0.3, -0.5])
def test_all_readings_lie_on_the_grid(frequency_hz, shift):
    reading, true = simulate_reading(frequency_hz, step=STEP, shift=shift)
    steps = reading / STEP - shift
    np.testing.assert_allclose(steps, np.rint(steps), atol=1e-9)
    assert np.abs(reading - true).max() <= STEP / 2 + 1e-15
    assert (reading - true).std() == pytest.approx(STEP / np.sqrt(12), rel=0.06)


def test_the_mechanics_do_not_filter_the_steps():
    """A step in the command would ring at 300 Hz, but a step in the reading does not."""
    reading, _ = simulate_reading(1.0, step=STEP)
    jumps = np.abs(np.diff(reading))
    assert set(np.unique(np.rint(jumps / STEP))) == {0.0, 1.0}


def test_the_error_shrinks_with_the_step_down_to_zero():
    errors = [
        np.abs(np.subtract(*simulate_reading(step=step))).max() for step in (1e-5, 1e-6, 1e-7, 0.0)
    ]
    np.testing.assert_allclose(errors, [5e-6, 5e-7, 5e-8, 0.0], rtol=0.01)


def test_noise_is_added_before_quantization():
    time_s = np.arange(20_000) / 10_000
    command = np.full(20_000, 5.03e-4)  # 0.15 steps above one of them
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effects = [
        AxisEffect(axis="thx", id="sensor_noise", parameters={"rms": 2e-5}),
        AxisEffect(axis="thx", id="sensor_quantization", parameters={"step": STEP}),
    ]
    for order in (effects, effects[::-1]):
        response = simulate(ROBOT, order, record, np.random.default_rng(2))
        reading = response.signal("thx", Tap.MEAS)
        np.testing.assert_allclose(reading / STEP, np.rint(reading / STEP), atol=1e-9)
        assert reading.mean() == pytest.approx(5.03e-4, abs=1e-6)
        assert reading.std() == pytest.approx(np.hypot(2e-5, STEP / np.sqrt(12)), rel=0.03)
