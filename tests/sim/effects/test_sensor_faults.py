"""Gain, nonlinearity, noise and quantization of sensors, and sensor faults in a control loop."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects import AxisProperties, load_effect
from rotemina.sim.effects.sensor_nonlinearity import SENSOR_NONLINEARITY, add_bow_and_cubic
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT, EMPS = load_robot("rotemina"), load_robot("emps")
THX = ROBOT.axes["thx"]
ROWS = 20_000
STEP, RMS = 2e-5, 5e-6
#: Clock skew is left out: its time stamps do not affect a control loop.
LOOP_EFFECTS = [
    (effect_id, formulation.name)
    for effect_id in (
        "sensor_gain",
        "sensor_nonlinearity",
        "sensor_lag",
        "sensor_noise",
        "sensor_quantization",
        "sensor_drift",
        "sensor_outliers",
        "encoder_interpolation",
    )
    for formulation in load_effect(effect_id).formulations
]


def simulate_reading(effects, command, rate_hz=10_000.0, seed=None):
    """Return reading and true position of thx with effects (id, parameters)."""
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    axis_effects = [
        AxisEffect(axis="thx", id=name, parameters=parameters) for name, parameters in effects
    ]
    rng = None if seed is None else np.random.default_rng(seed)
    reading = simulate(ROBOT, axis_effects, record, rng).signal("thx", Tap.MEAS)
    return reading, simulate(ROBOT, (), record).signal("thx", Tap.REF)


def make_sine(frequency_hz=1.0):
    return 5e-4 + 4e-4 * np.sin(2 * np.pi * frequency_hz * np.arange(ROWS) / 10_000)


@pytest.mark.parametrize("error", [-0.3, 0.02])
def test_a_gain_error_is_proportional_to_the_position(error):
    reading, true = simulate_reading([("sensor_gain", {"error": error})], make_sine(20.0))
    np.testing.assert_allclose(reading, (1 + error) * true, rtol=1e-13)


def compute_bend(axis, bow, cubic, positions):
    """Return the error of a bent sensor at shares of the range, as a share of it."""
    properties = AxisProperties.of(axis)
    p = SENSOR_NONLINEARITY.formulations[0].compute_numbers(
        {"bow": bow * properties.span, "cubic": cubic * properties.span}, properties
    )
    positions_si = properties.low + properties.span * np.asarray(positions)
    reading = np.array([add_bow_and_cubic(x, x, 0.0, 1e-3, 0.0, 0.0, p, []) for x in positions_si])
    return (reading - positions_si) / properties.span


@pytest.mark.parametrize("name", ["x", "thx"])
def test_a_bent_sensor_is_exact_at_both_ends_with_an_even_bow_and_an_odd_cubic_part(name):
    axis, shares = ROBOT.axes[name], np.linspace(0, 1, 20_001)
    np.testing.assert_allclose(compute_bend(axis, -0.05, 0.1, [0.0, 1.0]), 0.0, atol=1e-15)
    bow = compute_bend(axis, 0.01, 0.0, shares)
    assert bow.max() == bow[10_000] == pytest.approx(0.01, rel=1e-12)
    np.testing.assert_allclose(bow, bow[::-1], atol=1e-15)
    cubic = compute_bend(axis, 0.0, 0.01, shares)
    assert cubic.max() == pytest.approx(0.01, rel=1e-7)
    assert 2 * shares[np.argmax(cubic)] - 1 == pytest.approx(1 / np.sqrt(3), abs=1e-3)
    np.testing.assert_allclose(cubic, -cubic[::-1], atol=1e-15)


@pytest.mark.parametrize("rate_hz", [200.0, 20_000.0])
def test_noise_is_white_and_normal_and_adds_to_the_declared_noise_at_any_rate(rate_hz):
    reading, true = simulate_reading(
        [("sensor_noise", {"rms": RMS})], np.full(ROWS, 5e-4), rate_hz, seed=7
    )
    noise = (reading - true) / np.hypot(RMS, THX.sensor.noise_floor)
    assert noise.std() == pytest.approx(1.0, rel=0.02)
    assert abs(np.mean(noise**3)) < 4 * np.sqrt(15 / ROWS)
    assert np.mean(noise**4) == pytest.approx(3.0, abs=4 * np.sqrt(96 / ROWS))
    noise -= noise.mean()
    for lag in (1, 2, 5, 50, 500):
        correlation = np.dot(noise[lag:], noise[:-lag]) / np.dot(noise, noise)
        assert abs(correlation) < 4 / np.sqrt(ROWS), lag


@pytest.mark.parametrize(("frequency_hz", "shift"), [(1.0, 0.0), (1.0, 0.3), (40.0, -0.5)])
def test_quantized_readings_lie_on_their_grid(frequency_hz, shift):
    parameters = {"step": STEP, "shift": shift}
    reading, true = simulate_reading([("sensor_quantization", parameters)], make_sine(frequency_hz))
    steps = reading / STEP - shift
    np.testing.assert_allclose(steps, np.rint(steps), atol=1e-9)
    assert np.abs(reading - true).max() <= STEP / 2 + 1e-15
    assert (reading - true).std() == pytest.approx(STEP / np.sqrt(12), rel=0.06)
    if frequency_hz == 1.0:  # the mechanics would ring after a step, but the reading does not
        assert set(np.unique(np.rint(np.abs(np.diff(reading)) / STEP))) == {0.0, 1.0}


def test_the_error_of_quantization_shrinks_with_the_step_down_to_zero():
    errors = [
        np.abs(
            np.subtract(*simulate_reading([("sensor_quantization", {"step": step})], make_sine()))
        )
        for step in (1e-5, 1e-7, 0.0)
    ]
    peaks = [error.max() for error in errors]
    np.testing.assert_allclose(peaks, [5e-6, 5e-8, 0.0], rtol=0.01)


def test_noise_is_added_before_quantization_in_any_order_of_the_effects():
    effects = [("sensor_noise", {"rms": 2e-5}), ("sensor_quantization", {"step": STEP})]
    command = np.full(ROWS, 5.03e-4)  # 0.15 steps above one of them
    for order in (effects, effects[::-1]):
        reading, _ = simulate_reading(order, command, seed=2)
        np.testing.assert_allclose(reading / STEP, np.rint(reading / STEP), atol=1e-9)
        assert reading.mean() == pytest.approx(5.03e-4, abs=1e-6)
        assert reading.std() == pytest.approx(np.hypot(2e-5, STEP / np.sqrt(12)), rel=0.03)


def test_effects_of_one_axis_act_in_sequence_and_the_offset_comes_last():
    time_s = np.arange(1000) / 2000.0
    command = 0.0275 + 1.5e-3 * np.sin(2 * np.pi * 5.0 * time_s**2)
    commands = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effects = [
        AxisEffect(axis="x", id="sensor_gain", parameters={"error": 0.1}),
        AxisEffect(axis="x", id="sensor_quantization", parameters={"step": STEP}),
    ]
    true = simulate(ROBOT, (), commands).signal("x", Tap.MEAS)
    for offset in (0.0, 1e-3):
        axes = {**ROBOT.axes, "x": replace(ROBOT.axes["x"], offset=offset)}
        reading = simulate(replace(ROBOT, axes=axes), effects, commands).signal("x", Tap.MEAS)
        expected = STEP * np.rint((1.1 * true + offset) / STEP)
        np.testing.assert_allclose(reading, expected, atol=1e-15)


def simulate_loop(effect_id=None, formulation=None, seed=None, **parameters):
    time_s = np.arange(1000) / 2000.0
    command = 0.1 + 0.02 * np.sin(2 * np.pi * 2.0 * time_s)
    commands = Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )
    effect = AxisEffect(
        axis="q", id=effect_id or "", formulation=formulation, parameters=parameters
    )
    rng = None if seed is None else np.random.default_rng(seed)
    return simulate(EMPS, [effect] if effect_id else (), commands, rng)


@pytest.mark.parametrize(("effect_id", "formulation"), LOOP_EFFECTS)
def test_a_controller_responds_to_the_sensor_fault(effect_id, formulation):
    # At this rate some outliers fall into the short run.
    parameters = {"rate": 50.0} if effect_id == "sensor_outliers" else {}
    clean = simulate_loop(seed=2)
    faulty = simulate_loop(effect_id, formulation, seed=2, **parameters)
    assert np.ptp(faulty.signal("q", Tap.U) - clean.signal("q", Tap.U)) > 1e-3
    assert np.ptp(faulty.signal("q", Tap.REF) - clean.signal("q", Tap.REF)) > 1e-9


def test_a_skewed_clock_leaves_a_closed_loop_alone():
    clean, skewed = simulate_loop(), simulate_loop("clock_skew", skew=5000.0)
    np.testing.assert_array_equal(skewed.signal("q", Tap.U), clean.signal("q", Tap.U))
    assert np.any(skewed.signal("q", Tap.MEAS) != clean.signal("q", Tap.MEAS))
