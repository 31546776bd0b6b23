"""Errors that are functions of the position, of the command, or of the time since the start."""

import numpy as np
import pytest

from rotemina.sim.effects import AttachedEffect
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
FOUR_FULL_STEPS = 20e-6
TONE = {"frequency": 37.0, "sine": 2e-6, "cosine": -1e-6}


def simulate_error(
    effect_id, command, tap=Tap.REF, *, formulation=None, first_s=0.0, others=(), **parameters
):
    """Return the true position of x without the effect, and the error that the effect adds."""
    time_s = first_s + np.arange(len(command)) / 1000.0
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id=effect_id, formulation=formulation, parameters=parameters)
    true = simulate(ROBOT, (), record).signal("x", Tap.REF)
    return true, simulate(ROBOT, [*others, effect], record).signal("x", tap) - true


def compute_series(angle, amplitudes):
    waves = (np.sin(angle), np.cos(angle), np.sin(2 * angle), np.cos(2 * angle))
    return sum(size * wave for size, wave in zip(amplitudes, waves, strict=True))


@pytest.mark.parametrize("speed", [1e-5, 5e-3])
@pytest.mark.parametrize(
    ("effect_id", "names", "period", "origin", "tap"),
    [
        ("leadscrew_error", ("sine", "cosine", "sine_2", "cosine_2"), 8e-4, 0.0275, Tap.REF),
        (
            "encoder_interpolation",
            ("sine", "cosine", "second_sine", "second_cosine"),
            20e-6,
            0.0,
            Tap.MEAS,
        ),
    ],
)
def test_errors_of_screw_and_encoder_are_fourier_series_of_the_position_at_any_speed(
    effect_id, names, period, origin, tap, speed
):
    time_s = np.arange(4000) / 1000.0
    command = 0.02 + speed * np.minimum(time_s, 4.0 - time_s)  # there and back
    amplitudes = (2e-6, -1e-6, 5e-7, 3e-7)
    parameters = dict(zip(names, amplitudes, strict=True), period=period)
    q, error = simulate_error(effect_id, command, tap, **parameters)
    expected = compute_series(2 * np.pi * (q - origin) / period, amplitudes)
    np.testing.assert_allclose(error, expected, atol=1e-16)


def test_the_preset_period_of_a_screw_is_one_pitch():
    attached = AttachedEffect.of(ROBOT, AxisEffect(axis="x", id="leadscrew_error"))
    assert attached.values["period"] == pytest.approx(ROBOT.axes["x"].pitch)


def test_an_encoder_error_depends_on_the_position_and_not_on_a_faulty_reading():
    gain = AxisEffect(axis="x", id="sensor_gain", parameters={"error": 0.01})
    parameters = {"period": 20e-6, "sine": 1e-7, "cosine": 0.0, "second_sine": 0.0}
    command = np.linspace(0.02, 0.021, 2000)
    q, error = simulate_error(
        "encoder_interpolation", command, Tap.MEAS, others=[gain], **parameters
    )
    np.testing.assert_allclose(error - 0.01 * q, 1e-7 * np.sin(2 * np.pi * q / 20e-6), atol=1e-15)


@pytest.mark.parametrize("speed", [1e-4, -5e-5])
def test_a_microstep_error_has_two_harmonics_of_the_command_at_any_speed(speed):
    command = 0.0275 + speed * np.arange(4000) / 1000.0
    amplitudes = (2e-7, 1e-7, -5e-8, 3e-8)
    names = ("sine", "cosine", "sine_2", "cosine_2")
    _, error = simulate_error(
        "microstep_error", command, **dict(zip(names, amplitudes, strict=True))
    )
    angle = 2 * np.pi * (command - 0.0275) / FOUR_FULL_STEPS
    waves = [np.sin(angle), np.cos(angle), np.sin(2 * angle), np.cos(2 * angle)]
    weights = np.linalg.lstsq(np.stack(waves, 1)[100:], error[100:], rcond=None)[0]
    lag = 2 * np.pi * abs(speed) / FOUR_FULL_STEPS * 8e-4  # rad, lag of the mechanics
    np.testing.assert_allclose(weights, amplitudes, atol=2.5e-7 * (lag + 1e-3))


def test_the_mechanics_filter_a_microstep_error():
    # The error has 300 Hz, well above the 112 Hz of the axis.
    command = 0.01 + 300.0 * FOUR_FULL_STEPS * np.arange(1500) / 1000.0
    _, error = simulate_error("microstep_error", command, sine=1e-6, sine_2=0.0)
    assert np.abs(error[-500:]).max() < 0.4e-6


@pytest.mark.parametrize("first_s", [0.0, 500.0])
@pytest.mark.parametrize(
    ("formulation", "harmonic"),
    [("tone", {}), ("two_tones", {"sine_2": 5e-7, "cosine_2": 3e-7})],
)
def test_a_vibration_is_a_fourier_series_of_the_time_since_the_start(
    formulation, harmonic, first_s
):
    _, error = simulate_error(
        "vibration",
        np.full(2000, 0.02),
        formulation=formulation,
        first_s=first_s,
        **TONE,
        **harmonic,
    )
    angle = 2 * np.pi * 37.0 * np.arange(2000) / 1000.0
    second = harmonic.values() or (0.0, 0.0)
    np.testing.assert_allclose(error, compute_series(angle, (2e-6, -1e-6, *second)), atol=1e-15)


@pytest.mark.parametrize("first_s", [0.0, 1000.0])
def test_thermal_drift_is_an_exponential_of_the_time_since_the_start(first_s):
    parameters = {"amplitude": 1e-5, "time_constant": 2.0}
    _, error = simulate_error("thermal_drift", np.full(5000, 0.02), first_s=first_s, **parameters)
    expected = 1e-5 * (1 - np.exp(-np.arange(5000) / 1000.0 / 2.0))
    np.testing.assert_allclose(error, expected, atol=1e-15)


def test_the_drift_of_two_bodies_grows_turns_and_comes_back():
    time_s = np.arange(5000) / 1000.0
    _, error = simulate_error(
        "thermal_drift",
        np.full(5000, 0.02),
        formulation="two_bodies",
        amplitude=1e-5,
        time_constant=0.25,
        amplitude_2=-8e-6,
        time_constant_2=2.0,
    )
    expected = 1e-5 * (1 - np.exp(-time_s / 0.25)) - 8e-6 * (1 - np.exp(-time_s / 2.0))
    np.testing.assert_allclose(error, expected, atol=1e-15)
    assert error[-1] < 0.7 * error.max()
