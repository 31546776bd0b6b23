"""Frequency and damping of fitted poles: known values are recovered with correct deviations."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.identification import (
    ModelOrders,
    find_natural_modes,
    identify_oe,
    make_siso_signals,
)
from rotemina.sim.identification.transfer_function import TransferFunction

RATE_HZ = 2000.0


def make_pole(frequency_hz, damping_ratio):
    s = 2.0 * np.pi * frequency_hz * complex(-damping_ratio, np.sqrt(1.0 - damping_ratio**2))
    return np.exp(s / RATE_HZ)


def fit_model(poles, numerator, noise=0.0, seed=0, count=4000):
    """Return a model fitted to the response of these poles (conjugates are added)."""
    rng = np.random.default_rng(seed)
    all_poles = np.r_[poles, np.conj([pole for pole in poles if pole.imag])]
    true_system = TransferFunction(np.array(numerator), np.real(np.poly(all_poles)), 1, RATE_HZ)
    input_signal = rng.standard_normal(count)
    output_signal = true_system.simulate(input_signal)
    output_signal = output_signal + noise * output_signal.std() * rng.standard_normal(count)
    return identify_oe(
        make_siso_signals(input_signal, output_signal, RATE_HZ),
        ModelOrders(len(all_poles), len(numerator), 1),
    )


def test_a_mode_of_known_frequency_and_damping_is_recovered():
    (mode,) = find_natural_modes(fit_model([make_pole(120.0, 0.05)], [1.0, 0.8]))
    assert mode.oscillates
    assert mode.frequency_hz == pytest.approx(120.0, rel=1e-8)
    assert mode.damping_ratio == pytest.approx(0.05, rel=1e-6)


def test_the_strongest_mode_comes_first():
    weak, strong = make_pole(400.0, 0.1), make_pole(60.0, 0.02)
    modes = find_natural_modes(fit_model([weak, strong], [1.0, 0.5, 0.2, 0.1]))
    assert [round(mode.frequency_hz) for mode in modes] == [60, 400]


def test_a_real_pole_is_a_lag_with_its_corner_frequency():
    time_constant_s = 0.004
    (mode,) = find_natural_modes(
        fit_model([complex(np.exp(-1.0 / RATE_HZ / time_constant_s))], [1.0])
    )
    assert not mode.oscillates
    assert mode.damping_ratio == 1.0
    assert mode.frequency_hz == pytest.approx(1.0 / (2.0 * np.pi * time_constant_s), rel=1e-8)


def test_a_pole_at_zero_is_not_a_mode():
    model = fit_model([make_pole(120.0, 0.05)], [1.0, 0.8])
    transfer = model.transfer_function
    delayed = TransferFunction(
        transfer.numerator, np.r_[transfer.denominator, 0.0], transfer.delay, RATE_HZ
    )
    covariance = np.zeros((5, 5))
    covariance[:4, :4] = model.covariance
    modes = find_natural_modes(replace(model, transfer_function=delayed, covariance=covariance))
    assert len(modes) == 1


def test_the_deviations_are_those_of_repeated_experiments():
    modes = [
        find_natural_modes(
            fit_model([make_pole(120.0, 0.05)], [1.0, 0.8], noise=0.1, seed=seed, count=800)
        )[0]
        for seed in range(60)
    ]
    spread = np.std([mode.frequency_hz for mode in modes], ddof=1)
    assert np.mean([mode.frequency_deviation for mode in modes]) == pytest.approx(spread, rel=0.3)
    spread = np.std([mode.damping_ratio for mode in modes], ddof=1)
    assert np.mean([mode.damping_deviation for mode in modes]) == pytest.approx(spread, rel=0.3)
