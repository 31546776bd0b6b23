"""ARX and output error: exact recovery, correct deviations, refusals."""

import numpy as np
import pytest

from rotemina.sim.errors import (
    IdentificationError,
    IdentificationSettingError,
    InsufficientExcitationError,
    TooShortError,
)
from rotemina.sim.identification import (
    ModelOrders,
    identify_arx,
    identify_oe,
    make_siso_signals,
    signals_from_record,
    simulate,
)
from rotemina.sim.identification.transfer_function import TransferFunction, stabilise
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

RATE_HZ = 1000.0
TRUE_SYSTEM = TransferFunction(np.array([0.1, 0.05]), np.array([1.0, -1.5, 0.7]), 2, RATE_HZ)
ORDERS = ModelOrders(2, 2, 2)
each_method = pytest.mark.parametrize("identify", [identify_arx, identify_oe])


def make_experiment(count=3000, noise=0.0, seed=0, lead=100, offset=0.5):
    """Return input in volts and output in nanometres, without the lead-in before the record."""
    rng = np.random.default_rng(seed)
    input_signal = 3.0 + rng.standard_normal(count + lead)
    output_signal = (
        TRUE_SYSTEM.simulate(input_signal) + offset + noise * rng.standard_normal(count + lead)
    )
    return make_siso_signals(input_signal[lead:], 1e-9 * output_signal[lead:], RATE_HZ)


def get_coefficients(model):
    transfer = model.transfer_function
    return np.r_[1e9 * transfer.numerator, transfer.denominator[1:]]


TRUE_COEFFICIENTS = np.array([0.1, 0.05, -1.5, 0.7])


@each_method
def test_a_system_without_noise_is_recovered_to_rounding(identify):
    model = identify(make_experiment(), ORDERS)
    np.testing.assert_allclose(get_coefficients(model), TRUE_COEFFICIENTS, rtol=1e-9)
    assert model.offset == pytest.approx(0.5e-9, rel=1e-8)
    assert model.fit_percent > 100 - 1e-7
    transfer = model.transfer_function
    assert transfer.stable
    assert transfer.rate_hz == RATE_HZ
    assert transfer.static_gain == pytest.approx(0.15e-9 / 0.2, rel=1e-8)
    np.testing.assert_allclose(np.sort_complex(transfer.poles), np.sort_complex(TRUE_SYSTEM.poles))
    np.testing.assert_allclose(transfer.zeros, [-0.5], rtol=1e-7)


@each_method
@pytest.mark.parametrize(
    ("numerator", "denominator", "delay"),
    [([0.3], [1.0], 0), ([0.0, 0.2], [1.0, -0.9], 7), ([1.0, -0.4, 0.1], [1, -0.2, 0.5, 0.1], 0)],
)
def test_other_structures_are_recovered_too(identify, numerator, denominator, delay):
    true_system = TransferFunction(
        np.array(numerator), np.array(denominator, float), delay, RATE_HZ
    )
    input_signal = np.random.default_rng(1).standard_normal(600)
    orders = ModelOrders(len(denominator) - 1, len(numerator), delay)
    model = identify(
        make_siso_signals(input_signal, true_system.simulate(input_signal), RATE_HZ), orders
    ).transfer_function
    np.testing.assert_allclose(model.numerator, numerator, atol=1e-9)
    np.testing.assert_allclose(model.denominator, denominator, atol=1e-9)


def test_deviations_of_output_error_are_those_of_many_runs():
    """With sensor noise, the normalised errors of 60 seeds have mean 0 and spread 1."""
    models = [identify_oe(make_experiment(800, 0.1, seed), ORDERS) for seed in range(60)]
    deviations = [[1e9, 1e9, 1, 1] * np.sqrt(np.diag(model.covariance)) for model in models]
    scores = (
        np.array([get_coefficients(model) for model in models]) - TRUE_COEFFICIENTS
    ) / deviations
    assert np.abs(scores.mean(axis=0)).max() < 3.5 / np.sqrt(60)
    assert scores.std(axis=0) == pytest.approx(np.ones(4), abs=0.35)
    gains = np.array([model.transfer_function.static_gain for model in models])
    spread = [model.static_gain_deviation for model in models]
    assert np.std((gains - 0.75e-9) / spread) == pytest.approx(1.0, abs=0.35)
    assert models[0].residual_rms == pytest.approx(0.1e-9, rel=0.1)


def test_deviations_of_arx_are_correct_for_equation_noise():
    rng = np.random.default_rng(3)
    scores = []
    for _ in range(60):
        input_signal, noise = rng.standard_normal((2, 900))
        coloured = TransferFunction(np.ones(1), TRUE_SYSTEM.denominator, 0, RATE_HZ).simulate(
            0.2 * noise
        )
        model = identify_arx(
            make_siso_signals(input_signal, TRUE_SYSTEM.simulate(input_signal) + coloured, RATE_HZ),
            ORDERS,
        )
        deviation = np.sqrt(np.diag(model.covariance))
        estimated = np.r_[
            model.transfer_function.numerator, model.transfer_function.denominator[1:]
        ]
        scores.append((estimated - TRUE_COEFFICIENTS) / deviation)
    assert np.std(scores, axis=0) == pytest.approx(np.ones(4), abs=0.35)
    assert model.prediction_percent > model.fit_percent


def test_a_model_is_validated_on_another_record():
    model = identify_oe(make_experiment(noise=0.05), ORDERS).transfer_function
    validation = simulate(model, make_experiment(seed=9, offset=2.0))
    assert validation.fit_percent > 98.5
    assert validation.relative_error < 0.01
    with pytest.raises(
        IdentificationSettingError, match="sampled at 1000 Hz, the record at 500 Hz; resample"
    ):
        simulate(model, make_siso_signals(*make_experiment().require_single_pair(), 500.0))


@pytest.mark.parametrize("shape", ["sine", "triangle"])
def test_the_nominal_axis_is_recovered_from_the_excitations_of_the_paper(shape):
    """The exact zero-order hold has poles at exp(s T) and gain 1 from command to position."""
    robot = load_robot("rotemina")
    time_s = np.arange(6000) / 2000.0
    phase = 7.3 * time_s
    wave = np.sin(2 * np.pi * phase)
    if shape == "triangle":
        wave = 4 * np.abs(phase % 1 - 0.5) - 1
    command = 2e-2 + 1e-4 * wave
    commands = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    output_signal = simulate_nominal_response(robot, commands).signal("x", Tap.REF)
    signals = {("x", Tap.CMD): command, ("x", Tap.REF): output_signal}
    record = Record.from_signals(time_s, signals, {"x": "m"})
    signals_of_axis = signals_from_record(record, [("x", Tap.CMD)], [("x", Tap.REF)])
    model = identify_oe(signals_of_axis, ModelOrders(2, 2, 1)).transfer_function
    poles = np.exp(np.roots(robot.axes["x"].inertia) / 2000.0)
    np.testing.assert_allclose(np.sort_complex(model.poles), np.sort_complex(poles), atol=1e-5)
    assert model.static_gain == pytest.approx(1.0, abs=1e-6)


def test_bad_experiments_are_refused():
    constant_input = make_siso_signals(
        np.full(100, 2.0), np.random.default_rng(0).standard_normal(100), RATE_HZ
    )
    with pytest.raises(
        InsufficientExcitationError, match=r"u: constant at 2 over 100 samples; .* moves"
    ):
        identify_arx(constant_input, ORDERS)
    with pytest.raises(TooShortError, match=r"20 samples, but .* needs at least 23; record longer"):
        identify_oe(make_experiment(20), ORDERS)
    with pytest.raises(IdentificationSettingError, match="cannot be negative"):
        identify_arx(make_experiment(), ModelOrders(-1, 2))
    with pytest.raises(
        InsufficientExcitationError, match="choose lower orders or excite more frequencies"
    ):
        identify_arx(make_experiment(), ModelOrders(4, 4, 2))
    with pytest.raises(IdentificationError, match="a value is not finite"):
        make_siso_signals(np.array([1.0, np.nan]), np.ones(2), RATE_HZ)


def test_an_unstable_denominator_is_mirrored():
    mirrored = stabilise(np.poly([2.0, 0.5]))
    np.testing.assert_allclose(np.sort(np.roots(mirrored)), [0.5, 0.5], atol=1e-7)
    assert TransferFunction(np.ones(1), np.array([1.0, -2.0]), 0, 1.0).stable is False


def test_the_frequency_response_matches_the_simulation():
    count, line = 4000, 130
    input_signal = np.cos(2 * np.pi * line * np.arange(count) / 1000)
    steady = np.fft.rfft(TRUE_SYSTEM.simulate(input_signal)[-1000:])[line] / 500
    np.testing.assert_allclose(TRUE_SYSTEM.response(np.array([130.0]))[0], steady, rtol=1e-9)
