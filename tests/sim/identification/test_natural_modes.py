"""Frequency and damping of fitted poles: known ones come back, with honest deviations."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.identification.experiment_signals import siso
from rotemina.sim.identification.model import Orders
from rotemina.sim.identification.natural_modes import natural_modes
from rotemina.sim.identification.output_error import identify_oe
from rotemina.sim.identification.transfer_function import TransferFunction

RATE_HZ = 2000.0


def pole(frequency_hz, damping_ratio):
    s = 2.0 * np.pi * frequency_hz * complex(-damping_ratio, np.sqrt(1.0 - damping_ratio**2))
    return np.exp(s / RATE_HZ)


def fitted(poles, numerator, noise=0.0, seed=0, count=4000):
    """A model fitted to an answer of the poles given (conjugates are added)."""
    rng = np.random.default_rng(seed)
    every = np.r_[poles, np.conj([each for each in poles if each.imag])]
    truth = TransferFunction(np.array(numerator), np.real(np.poly(every)), 1, RATE_HZ)
    driven = rng.standard_normal(count)
    answer = truth.simulate(driven)
    answer = answer + noise * answer.std() * rng.standard_normal(count)
    return identify_oe(siso(driven, answer, RATE_HZ), Orders(len(every), len(numerator), 1))


def test_a_mode_of_known_frequency_and_damping_comes_back():
    (mode,) = natural_modes(fitted([pole(120.0, 0.05)], [1.0, 0.8]))
    assert mode.oscillates
    assert mode.frequency_hz == pytest.approx(120.0, rel=1e-8)
    assert mode.damping_ratio == pytest.approx(0.05, rel=1e-6)


def test_the_strongest_of_several_comes_first():
    weak, strong = pole(400.0, 0.1), pole(60.0, 0.02)
    modes = natural_modes(fitted([weak, strong], [1.0, 0.5, 0.2, 0.1]))
    assert [round(each.frequency_hz) for each in modes] == [60, 400]


def test_a_real_pole_is_a_lag_with_its_corner_frequency():
    time_constant_s = 0.004
    (mode,) = natural_modes(fitted([complex(np.exp(-1.0 / RATE_HZ / time_constant_s))], [1.0]))
    assert not mode.oscillates
    assert mode.damping_ratio == 1.0
    assert mode.frequency_hz == pytest.approx(1.0 / (2.0 * np.pi * time_constant_s), rel=1e-8)


def test_a_pole_at_zero_is_a_delay_and_no_mode():
    model = fitted([pole(120.0, 0.05)], [1.0, 0.8])
    transfer = model.transfer_function
    longer = TransferFunction(
        transfer.numerator, np.r_[transfer.denominator, 0.0], transfer.delay, RATE_HZ
    )
    covariance = np.zeros((5, 5))
    covariance[:4, :4] = model.covariance
    modes = natural_modes(replace(model, transfer_function=longer, covariance=covariance))
    assert len(modes) == 1


def test_the_deviations_are_those_of_repeated_experiments():
    found = [
        natural_modes(fitted([pole(120.0, 0.05)], [1.0, 0.8], noise=0.1, seed=seed, count=800))[0]
        for seed in range(60)
    ]
    spread = np.std([each.frequency_hz for each in found], ddof=1)
    assert np.mean([each.frequency_deviation for each in found]) == pytest.approx(spread, rel=0.3)
    spread = np.std([each.damping_ratio for each in found], ddof=1)
    assert np.mean([each.damping_deviation for each in found]) == pytest.approx(spread, rel=0.3)
