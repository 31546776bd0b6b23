"""Drift of a sensor's zero: its size and spectrum at any rate."""

import numpy as np
import pytest
from scipy.signal import welch

from rotemina.sim.effects import AxisProperties
from rotemina.sim.effects.sensor_drift import POLE_COUNT, SENSOR_DRIFT, add_flicker_noise
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
PROPERTIES = AxisProperties.of(ROBOT.axes["thx"])


def simulate_drift(formulation, seed, rows, rate_hz, **parameters):
    """Return the reading minus that without the effect, both with noise of the sensor."""
    time_s = np.arange(rows) / rate_hz
    command = np.full(rows, 5e-4)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(
        axis="thx", id="sensor_drift", formulation=formulation, parameters=parameters
    )
    faulty = simulate(ROBOT, [effect], record, np.random.default_rng(seed))
    clean = simulate(ROBOT, (), record, np.random.default_rng(seed))
    np.testing.assert_array_equal(faulty.signal("thx", Tap.REF), clean.signal("thx", Tap.REF))
    return faulty.signal("thx", Tap.MEAS) - clean.signal("thx", Tap.MEAS)


@pytest.mark.parametrize("rate_hz", [50.0, 1000.0])
def test_a_random_walk_spreads_with_the_root_of_time_at_any_rate(rate_hz):
    ends = np.array(
        [
            simulate_drift("random_walk", seed, int(2 * rate_hz) + 1, rate_hz, rate=1e-4)[
                [int(rate_hz / 2), int(2 * rate_hz)]
            ]
            for seed in range(150)
        ]
    )
    spread = ends.std(axis=0)
    np.testing.assert_allclose(spread, 1e-4 * np.sqrt([0.5, 2.0]), rtol=0.2)


def test_flicker_has_its_level_and_slope():
    rate_hz, level = 1000.0, 1e-4
    p = SENSOR_DRIFT.find_formulation("flicker").compute_numbers({"level": level}, PROPERTIES)
    rows = 200_000
    variates = np.random.default_rng(11).standard_normal(rows)
    s = [0.0] * SENSOR_DRIFT.formulations[1].acts.states
    h = 1.0 / rate_hz
    w = np.array([add_flicker_noise(0.0, 0.0, 0.0, h, a, 0.0, p, s) for a in variates])
    frequency, density = welch(w, rate_hz, nperseg=20_000)
    band = (frequency > 5e-4 * rate_hz) & (frequency < 0.04 * rate_hz)
    x, y = np.log(frequency[band]), np.log(density[band])
    slope = np.polyfit(x, y, 1, w=np.exp(-0.5 * x))[0]
    assert slope == pytest.approx(-1.0, abs=0.05)
    assert np.mean(density[band] * frequency[band]) == pytest.approx(level**2, rel=0.1)


def test_the_spectrum_of_the_poles_falls_as_one_over_f():
    p = SENSOR_DRIFT.find_formulation("flicker").compute_numbers({"level": 1.0}, PROPERTIES)
    frequency = np.logspace(-2.5, 1.9, 400)
    response = (p[POLE_COUNT:] / (2j * np.pi * frequency[:, None] + p[:POLE_COUNT])).sum(axis=1)
    np.testing.assert_allclose(2 * np.abs(response) ** 2 * frequency, 1.0, rtol=0.02)


def test_flicker_is_the_same_in_steps_of_any_length():
    """Its memory decays exactly: two steps without random input equal one of twice the length."""
    p = SENSOR_DRIFT.find_formulation("flicker").compute_numbers({"level": 1.0}, PROPERTIES)
    states = SENSOR_DRIFT.formulations[1].acts.states
    one_step_state, two_step_state = [0.0] * states, [0.0] * states
    for s in (one_step_state, two_step_state):
        add_flicker_noise(0.0, 0.0, 0.0, 0.01, 1.0, 0.0, p, s)
    for h in (0.3, 0.3):
        after_two_steps = add_flicker_noise(0.0, 0.0, 0.0, h, 0.0, 0.0, p, two_step_state)
    assert add_flicker_noise(0.0, 0.0, 0.0, 0.6, 0.0, 0.0, p, one_step_state) == pytest.approx(
        after_two_steps, rel=1e-12
    )


def test_flicker_starts_at_zero():
    drift = simulate_drift("flicker", 5, 4000, 1000.0, level=1e-4)
    assert drift[0] == 0.0
    assert 1e-4 < drift.std() < 1e-3
