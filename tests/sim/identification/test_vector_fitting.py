"""Vector fitting: the poles of a system that is known."""

import numpy as np
import pytest

from rotemina.sim.identification.vector_fitting import Spectra, contributions, vector_fit

ANGLE = np.linspace(0.05, 3.0, 400)
Z = np.exp(1j * ANGLE)
POLES = np.array([0.99, 0.985, 0.97, 0.96]) * np.exp(1j * np.array([0.4, 1.1, 1.9, 2.6]))
SLOWEST = 0.999


def spectra(records=3, inputs=2, noise=0.0, seed=1):
    """What a system with POLES answers to random inputs."""
    rng = np.random.default_rng(seed)

    def normal(*shape):
        return rng.standard_normal(shape) + 1j * rng.standard_normal(shape)

    x, residues = normal(records, inputs, len(Z)), normal(inputs, len(POLES))
    answer = sum(
        residues[:, k, None] / (Z - pole) + residues[:, k, None].conj() / (Z - pole.conj())
        for k, pole in enumerate(POLES)
    )
    y = (x * answer).sum(axis=1)
    return Spectra.of(Z, x, y + noise * normal(records, len(Z)))


@pytest.mark.parametrize("records", [1, 3, 7])
def test_the_poles_of_a_system_are_found_exactly(records):
    found = vector_fit(spectra(records), 6, SLOWEST, most=4)
    assert found == pytest.approx(POLES, abs=1e-9)


def test_what_poles_leave_is_the_noise():
    whole = spectra(noise=0.1)
    found = vector_fit(whole, 8, SLOWEST, most=4)
    assert found == pytest.approx(POLES, abs=2e-3)
    left, grown = contributions(whole, found)
    told = 2 * whole.output.size - 2 * len(POLES) * (2 + 1)
    assert left / told == pytest.approx(0.1**2, rel=0.15)
    assert all(grown > 100.0 * left / len(Z))


def test_what_a_pole_contributes_is_what_is_left_without_it():
    whole = spectra(noise=0.1)
    left, grown = contributions(whole, POLES)
    for k in range(len(POLES)):
        without, _ = contributions(whole, np.delete(POLES, k))
        assert without - left == pytest.approx(grown[k], rel=1e-6)


def test_many_records_say_no_more_than_as_many_as_there_are_signals():
    many = spectra(records=9)
    assert many.output.shape == (3, len(Z))
    one = contributions(many, POLES[:3])[0]
    rng = np.random.default_rng(2)
    turn = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    turned = Spectra(Z, np.einsum("ij,jkl->ikl", turn, many.inputs), turn @ many.output)
    same = contributions(turned, POLES[:3])[0]
    assert same == pytest.approx(one, rel=1e-9)


def test_poles_outside_the_circle_and_needles_are_brought_inside():
    found = vector_fit(spectra(noise=1.0), 10, SLOWEST, most=10)
    assert np.all(np.abs(found) <= SLOWEST + 1e-12)
    assert np.all(found.imag > 0.0)
