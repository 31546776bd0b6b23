"""Vector fitting finds the poles of a known system."""

import numpy as np
import pytest

from rotemina.sim.identification import (
    InputOutputSpectra,
    fit_poles,
    pole_contributions,
)

ANGLES = np.linspace(0.05, 3.0, 400)
Z = np.exp(1j * ANGLES)
POLES = np.array([0.99, 0.985, 0.97, 0.96]) * np.exp(1j * np.array([0.4, 1.1, 1.9, 2.6]))
MAX_POLE_RADIUS = 0.999


def make_spectra(records=3, inputs=2, noise=0.0, seed=1):
    """Return random inputs and the outputs of a system with POLES."""
    rng = np.random.default_rng(seed)

    def draw_normal(*shape):
        return rng.standard_normal(shape) + 1j * rng.standard_normal(shape)

    x, residues = draw_normal(records, inputs, len(Z)), draw_normal(inputs, len(POLES))
    response = sum(
        residues[:, k, None] / (Z - pole) + residues[:, k, None].conj() / (Z - pole.conj())
        for k, pole in enumerate(POLES)
    )
    y = (x * response).sum(axis=1)
    return InputOutputSpectra.from_records(Z, x, y + noise * draw_normal(records, len(Z)))


@pytest.mark.parametrize("records", [1, 7])
def test_the_poles_of_a_system_are_found_exactly(records):
    poles = fit_poles(make_spectra(records), 6, MAX_POLE_RADIUS, max_poles=4)
    assert poles == pytest.approx(POLES, abs=1e-9)


def test_the_residual_of_the_fit_is_the_noise():
    spectra = make_spectra(noise=0.1)
    poles = fit_poles(spectra, 8, MAX_POLE_RADIUS, max_poles=4)
    assert poles == pytest.approx(POLES, abs=2e-3)
    residual_power, contributions = pole_contributions(spectra, poles)
    degrees_of_freedom = 2 * spectra.output.size - 2 * len(POLES) * (2 + 1)
    assert residual_power / degrees_of_freedom == pytest.approx(0.1**2, rel=0.15)
    assert all(contributions > 100.0 * residual_power / len(Z))


def test_the_contribution_of_a_pole_is_the_added_residual_without_it():
    spectra = make_spectra(noise=0.1)
    residual_power, contributions = pole_contributions(spectra, POLES)
    for k in range(len(POLES)):
        residual_without, _ = pole_contributions(spectra, np.delete(POLES, k))
        assert residual_without - residual_power == pytest.approx(contributions[k], rel=1e-6)


def test_records_are_reduced_to_as_many_as_there_are_signals():
    spectra = make_spectra(records=9)
    assert spectra.output.shape == (3, len(Z))
    residual = pole_contributions(spectra, POLES[:3])[0]
    rng = np.random.default_rng(2)
    rotation = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    rotated_spectra = InputOutputSpectra(
        Z, np.einsum("ij,jkl->ikl", rotation, spectra.inputs), rotation @ spectra.output
    )
    rotated_residual = pole_contributions(rotated_spectra, POLES[:3])[0]
    assert rotated_residual == pytest.approx(residual, rel=1e-9)


def test_poles_stay_within_the_maximum_radius():
    poles = fit_poles(make_spectra(noise=1.0), 6, MAX_POLE_RADIUS, max_poles=8)
    assert np.all(np.abs(poles) <= MAX_POLE_RADIUS + 1e-12)
    assert np.all(poles.imag > 0.0)
