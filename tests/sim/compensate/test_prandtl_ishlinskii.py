"""Both Prandtl-Ishlinskii forms: the inverse is exact, and the fit finds the true weights."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotemina.sim.compensate import compute_stops, kernel
from rotemina.sim.compensate.modified_prandtl_ishlinskii import fit_modified
from rotemina.sim.compensate.prandtl_ishlinskii import PrandtlIshlinskii, fit_hysteresis

RADII = np.array([0.02, 0.08, 0.15, 0.3])


def make_random_path(seed, rows=2000):
    rng = np.random.default_rng(seed)
    corners = np.concatenate([[0.0], rng.uniform(0.0, 1.0, 25)])
    return np.interp(np.linspace(0.0, 25.0, rows), np.arange(26), corners)


@settings(max_examples=25)
@given(
    weights=st.lists(st.floats(0.0, 0.5), min_size=4, max_size=4),
    direct=st.floats(0.05, 1.5),
    memory=st.floats(0.0, 1.0),
    seed=st.integers(0, 99),
)
def test_the_inverse_is_exact_from_any_initial_state(weights, direct, memory, seed):
    hysteresis = PrandtlIshlinskii(0.0, RADII, memory * RADII, np.array([direct, *weights]))
    commands = make_random_path(seed, 400)
    assert hysteresis.make_inverse().compute_output(
        hysteresis.compute_output(commands)
    ) == pytest.approx(commands, abs=1e-12)


def compute_plays(commands):
    return commands[:, None] - compute_stops(commands, RADII, np.zeros(4))


def test_the_fit_finds_the_weights():
    true_hysteresis = PrandtlIshlinskii(
        0.03, RADII, np.zeros(4), np.array([0.8, 0.05, 0.1, 0.0, 0.2])
    )
    x = make_random_path(1)
    fit = fit_hysteresis(RADII, np.zeros(4), x, compute_plays(x), true_hysteresis.compute_output(x))
    assert fit.weights == pytest.approx(true_hysteresis.weights, abs=1e-9)
    assert fit.offset == pytest.approx(0.03, abs=1e-9)


def test_fitted_weights_always_have_an_inverse():
    x = make_random_path(2)
    falling = 0.5 - 0.4 * x  # falls where the command rises
    fit = fit_hysteresis(RADII, np.zeros(4), x, compute_plays(x), falling)
    assert (fit.weights[1:] >= 0.0).all()
    assert fit.weights[0] > 0.0
    modified_fit, bend = fit_modified(RADII, np.zeros(4), x, compute_plays(x), falling)
    assert modified_fit.weights[0] > 0.0
    assert (np.cumsum(bend.slopes) > 0.0).all()


def test_the_modified_form_compensates_a_loop_that_saturates():
    hysteresis = PrandtlIshlinskii(0.0, RADII, np.zeros(4), np.array([0.7, 0.05, 0.05, 0.1, 0.1]))
    x, unseen = make_random_path(3, 6000), make_random_path(4)

    def compute_saturated_output(commands):
        return np.tanh(1.2 * hysteresis.compute_output(commands))

    modified_fit, bend = fit_modified(
        RADII, np.zeros(4), x, compute_plays(x), compute_saturated_output(x)
    )
    table = np.stack([[bend.offset, *bend.at], bend.slopes])
    unbent = np.array([kernel.apply_bend(table, y) for y in compute_saturated_output(unseen)])
    residual = modified_fit.make_inverse().compute_output(unbent) - unseen
    assert np.sqrt(np.mean(residual**2)) < 0.004
    classical = fit_hysteresis(RADII, np.zeros(4), x, compute_plays(x), compute_saturated_output(x))
    classical_residual = (
        classical.make_inverse().compute_output(compute_saturated_output(unseen) - classical.offset)
        - unseen
    )
    assert np.sqrt(np.mean(residual**2)) < 0.2 * np.sqrt(np.mean(classical_residual**2))
