"""A zero that wanders: how far, with which spectrum, at any rate, and never the motion."""

import numpy as np
import pytest
from scipy.signal import welch

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.sensor_drift import POLES, SENSOR_DRIFT, flicker
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
FACTS = Facts.of(ROBOT.axes["thx"])


def wander(formulation, seed, rows, rate_hz, amplitude=0.0, **parameters):
    """Reading minus reading without the effect, noise of the sensor in both."""
    time_s = np.arange(rows) / rate_hz
    command = 5e-4 + amplitude * np.sin(2 * np.pi * 3.0 * time_s)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(
        axis="thx", id="sensor_drift", formulation=formulation, parameters=parameters
    )
    faulty = simulate(ROBOT, [effect], record, np.random.default_rng(seed))
    clean = simulate(ROBOT, (), record, np.random.default_rng(seed))
    np.testing.assert_array_equal(faulty.signal("thx", Tap.REF), clean.signal("thx", Tap.REF))
    return faulty.signal("thx", Tap.MEAS) - clean.signal("thx", Tap.MEAS)


@pytest.mark.parametrize("rate_hz", [50.0, 1000.0])
def test_a_random_walk_spreads_as_the_root_of_time_at_any_rate(rate_hz):
    ends = np.array(
        [
            wander("random_walk", seed, int(2 * rate_hz) + 1, rate_hz, rate=1e-4)[
                [int(rate_hz / 2), int(2 * rate_hz)]
            ]
            for seed in range(150)
        ]
    )
    spread = ends.std(axis=0)
    np.testing.assert_allclose(spread, 1e-4 * np.sqrt([0.5, 2.0]), rtol=0.2)


def test_a_walk_is_the_same_whether_the_axis_moves_or_not():
    still = wander("random_walk", 3, 4000, 1000.0, rate=1e-4)
    moving = wander("random_walk", 3, 4000, 1000.0, amplitude=3e-4, rate=1e-4)
    np.testing.assert_allclose(moving, still, atol=1.5e-7)  # a step of the sensor


@pytest.mark.parametrize("rate_hz", [100.0, 1000.0])
def test_flicker_has_the_asked_level_and_slope_at_any_rate(rate_hz):
    level = 1e-4
    p = SENSOR_DRIFT.formulation("flicker").numbers({"level": level}, FACTS)
    rows = 200_000
    variates = np.random.default_rng(11).standard_normal(rows)
    s = [0.0] * SENSOR_DRIFT.formulations[1].acts.states
    h = 1.0 / rate_hz
    w = np.array([flicker(0.0, 0.0, 0.0, h, a, 0.0, p, s) for a in variates])
    frequency, density = welch(w, rate_hz, nperseg=20_000)
    band = (frequency > 5e-4 * rate_hz) & (frequency < 0.04 * rate_hz)
    x, y = np.log(frequency[band]), np.log(density[band])
    slope = np.polyfit(x, y, 1, w=np.exp(-0.5 * x))[0]
    assert slope == pytest.approx(-1.0, abs=0.05)
    assert np.mean(density[band] * frequency[band]) == pytest.approx(level**2, rel=0.1)


def test_the_pole_zero_cascade_falls_as_one_over_f_over_five_decades():
    p = SENSOR_DRIFT.formulation("flicker").numbers({"level": 1.0}, FACTS)
    frequency = np.logspace(-2.5, 1.9, 400)
    answer = (p[POLES:] / (2j * np.pi * frequency[:, None] + p[:POLES])).sum(axis=1)
    np.testing.assert_allclose(2 * np.abs(answer) ** 2 * frequency, 1.0, rtol=0.02)


def test_flicker_is_done_alike_in_steps_of_any_length():
    """Its memory fades by exact exponentials: two steps without chance are one twice as long."""
    p = SENSOR_DRIFT.formulation("flicker").numbers({"level": 1.0}, FACTS)
    once, twice = (
        [0.0] * SENSOR_DRIFT.formulations[1].acts.states,
        [0.0] * SENSOR_DRIFT.formulations[1].acts.states,
    )
    for s in (once, twice):
        flicker(0.0, 0.0, 0.0, 0.01, 1.0, 0.0, p, s)
    for h in (0.3, 0.3):
        parted = flicker(0.0, 0.0, 0.0, h, 0.0, 0.0, p, twice)
    assert flicker(0.0, 0.0, 0.0, 0.6, 0.0, 0.0, p, once) == pytest.approx(parted, rel=1e-12)


def test_flicker_wanders_about_where_the_run_began():
    drift = wander("flicker", 5, 4000, 1000.0, level=1e-4)
    assert drift[0] == 0.0
    assert 1e-4 < drift.std() < 1e-3
