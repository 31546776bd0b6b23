"""ARX and output error: exact recovery, honest deviations, refusals."""

import numpy as np
import pytest

from rotemina.sim.identification.arx import identify_arx
from rotemina.sim.identification.errors import (
    ExcitationError,
    IdentificationError,
    SettingError,
    TooShortError,
)
from rotemina.sim.identification.experiment_signals import signals_of, siso
from rotemina.sim.identification.model import Orders, simulate
from rotemina.sim.identification.output_error import identify_oe
from rotemina.sim.identification.transfer_function import TransferFunction, stabilised
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

RATE_HZ = 1000.0
TRUE = TransferFunction(np.array([0.1, 0.05]), np.array([1.0, -1.5, 0.7]), 2, RATE_HZ)
ORDERS = Orders(2, 2, 2)
METHODS = pytest.mark.parametrize("identify", [identify_arx, identify_oe])


def experiment(count=3000, noise=0.0, seed=0, lead=100, offset=0.5):
    """Input in volts, output in nanometres; what came before the first sample is cut off."""
    rng = np.random.default_rng(seed)
    driven = 3.0 + rng.standard_normal(count + lead)
    answer = TRUE.simulate(driven) + offset + noise * rng.standard_normal(count + lead)
    return siso(driven[lead:], 1e-9 * answer[lead:], RATE_HZ)


def coefficients(model):
    transfer = model.transfer_function
    return np.r_[1e9 * transfer.numerator, transfer.denominator[1:]]


TRUTH = np.array([0.1, 0.05, -1.5, 0.7])


@METHODS
def test_a_system_without_noise_is_recovered_to_rounding(identify):
    model = identify(experiment(), ORDERS)
    np.testing.assert_allclose(coefficients(model), TRUTH, rtol=1e-9)
    assert model.offset == pytest.approx(0.5e-9, rel=1e-8)
    assert model.fit_percent > 100 - 1e-7
    transfer = model.transfer_function
    assert transfer.stable
    assert transfer.rate_hz == RATE_HZ
    assert transfer.static_gain == pytest.approx(0.15e-9 / 0.2, rel=1e-8)
    np.testing.assert_allclose(np.sort_complex(transfer.poles), np.sort_complex(TRUE.poles))
    np.testing.assert_allclose(transfer.zeros, [-0.5], rtol=1e-7)


@METHODS
@pytest.mark.parametrize(
    ("numerator", "denominator", "delay"),
    [([0.3], [1.0], 0), ([0.0, 0.2], [1.0, -0.9], 7), ([1.0, -0.4, 0.1], [1, -0.2, 0.5, 0.1], 0)],
)
def test_other_structures_are_recovered_too(identify, numerator, denominator, delay):
    true = TransferFunction(np.array(numerator), np.array(denominator, float), delay, RATE_HZ)
    driven = np.random.default_rng(1).standard_normal(600)
    orders = Orders(len(denominator) - 1, len(numerator), delay)
    model = identify(siso(driven, true.simulate(driven), RATE_HZ), orders).transfer_function
    np.testing.assert_allclose(model.numerator, numerator, atol=1e-9)
    np.testing.assert_allclose(model.denominator, denominator, atol=1e-9)


def test_deviations_of_output_error_are_those_of_many_runs():
    """Sensor noise: over 60 seeds the normalised errors have mean 0 and spread 1."""
    models = [identify_oe(experiment(800, 0.1, seed), ORDERS) for seed in range(60)]
    deviations = [[1e9, 1e9, 1, 1] * np.sqrt(np.diag(each.covariance)) for each in models]
    scores = (np.array([coefficients(each) for each in models]) - TRUTH) / deviations
    assert np.abs(scores.mean(axis=0)).max() < 3.5 / np.sqrt(60)
    assert scores.std(axis=0) == pytest.approx(np.ones(4), abs=0.35)
    gains = np.array([each.transfer_function.static_gain for each in models])
    spread = [each.static_gain_deviation for each in models]
    assert np.std((gains - 0.75e-9) / spread) == pytest.approx(1.0, abs=0.35)
    assert models[0].residual_rms == pytest.approx(0.1e-9, rel=0.1)


def test_deviations_of_arx_hold_for_its_own_noise():
    rng = np.random.default_rng(3)
    scores = []
    for _ in range(60):
        driven, noise = rng.standard_normal((2, 900))
        coloured = TransferFunction(np.ones(1), TRUE.denominator, 0, RATE_HZ).simulate(0.2 * noise)
        model = identify_arx(siso(driven, TRUE.simulate(driven) + coloured, RATE_HZ), ORDERS)
        deviation = np.sqrt(np.diag(model.covariance))
        found = np.r_[model.transfer_function.numerator, model.transfer_function.denominator[1:]]
        scores.append((found - TRUTH) / deviation)
    assert np.std(scores, axis=0) == pytest.approx(np.ones(4), abs=0.35)
    assert model.prediction_percent > model.fit_percent


def test_sensor_noise_biases_arx_but_not_output_error():
    noisy = experiment(4000, 0.1)
    arx, oe = identify_arx(noisy, ORDERS), identify_oe(noisy, ORDERS)
    assert np.abs(coefficients(arx) - TRUTH).max() > 0.2
    assert np.abs(coefficients(oe) - TRUTH).max() < 0.02
    assert oe.fit_percent > arx.fit_percent


def test_a_model_is_validated_on_a_record_it_has_not_seen():
    model = identify_oe(experiment(noise=0.05), ORDERS).transfer_function
    fresh = simulate(model, experiment(seed=9, offset=2.0))
    assert fresh.fit_percent > 98.5
    assert fresh.relative_error < 0.01
    with pytest.raises(SettingError, match="sampled at 1000 Hz, the record at 500 Hz; resample"):
        simulate(model, siso(*experiment().single(), 500.0))


@pytest.mark.parametrize("shape", ["sine", "triangle"])
def test_the_nominal_axis_is_recovered_from_the_excitations_of_the_paper(shape):
    """Its exact zero-order hold: poles at exp(s T), gain 1 from command to position."""
    robot = load_robot("rotemina")
    time_s = np.arange(6000) / 2000.0
    phase = 7.3 * time_s
    wave = np.sin(2 * np.pi * phase)
    if shape == "triangle":
        wave = 4 * np.abs(phase % 1 - 0.5) - 1
    command = 2e-2 + 1e-4 * wave
    bare = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    answer = nominal_response(robot, bare).signal("x", Tap.REF)
    signals = {("x", Tap.CMD): command, ("x", Tap.REF): answer}
    record = Record.from_signals(time_s, signals, {"x": "m"})
    experiment = signals_of(record, [("x", Tap.CMD)], [("x", Tap.REF)])
    model = identify_oe(experiment, Orders(2, 2, 1)).transfer_function
    poles = np.exp(np.roots(robot.axes["x"].inertia) / 2000.0)
    np.testing.assert_allclose(np.sort_complex(model.poles), np.sort_complex(poles), atol=1e-5)
    assert model.static_gain == pytest.approx(1.0, abs=1e-6)


def test_bad_experiments_are_refused():
    still = siso(np.full(100, 2.0), np.random.default_rng(0).standard_normal(100), RATE_HZ)
    with pytest.raises(ExcitationError, match=r"u: constant at 2 over 100 samples; .* moves"):
        identify_arx(still, ORDERS)
    with pytest.raises(TooShortError, match=r"20 samples, but .* needs at least 23; record longer"):
        identify_oe(experiment(20), ORDERS)
    with pytest.raises(SettingError, match="cannot be negative"):
        identify_arx(experiment(), Orders(-1, 2))
    with pytest.raises(ExcitationError, match="choose lower orders or excite more frequencies"):
        identify_arx(experiment(), Orders(4, 4, 2))
    with pytest.raises(IdentificationError, match="a value is not finite"):
        siso(np.array([1.0, np.nan]), np.ones(2), RATE_HZ)


def test_an_unstable_denominator_is_mirrored():
    mirrored = stabilised(np.poly([2.0, 0.5]))
    np.testing.assert_allclose(np.sort(np.roots(mirrored)), [0.5, 0.5], atol=1e-7)
    assert TransferFunction(np.ones(1), np.array([1.0, -2.0]), 0, 1.0).stable is False


def test_a_transfer_function_answers_in_frequency_as_it_does_in_time():
    count, line = 4000, 130
    driven = np.cos(2 * np.pi * line * np.arange(count) / 1000)
    steady = np.fft.rfft(TRUE.simulate(driven)[-1000:])[line] / 500
    np.testing.assert_allclose(TRUE.response(np.array([130.0]))[0], steady, rtol=1e-9)
