"""Both forms of Prandtl and Ishlinskii: the inverse is exact, the fit finds what was there."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotemina.sim.compensate import kernel
from rotemina.sim.compensate.modified_prandtl_ishlinskii import fit_modified
from rotemina.sim.compensate.prandtl_ishlinskii import Hysteresis, fit_hysteresis
from rotemina.sim.stops import stops

RADII = np.array([0.02, 0.08, 0.15, 0.3])


def wander(seed, rows=2000):
    rng = np.random.default_rng(seed)
    places = np.concatenate([[0.0], rng.uniform(0.0, 1.0, 25)])
    return np.interp(np.linspace(0.0, 25.0, rows), np.arange(26), places)


@settings(max_examples=25)
@given(
    weights=st.lists(st.floats(0.0, 0.5), min_size=4, max_size=4),
    direct=st.floats(0.05, 1.5),
    memory=st.floats(0.0, 1.0),
    seed=st.integers(0, 99),
)
def test_the_inverse_is_exact_from_any_beginning(weights, direct, memory, seed):
    whole = Hysteresis(0.0, RADII, memory * RADII, np.array([direct, *weights]))
    commands = wander(seed, 400)
    assert whole.inverse().answer(whole.answer(commands)) == pytest.approx(commands, abs=1e-12)


def plays_of(commands):
    return commands[:, None] - stops(commands, RADII, np.zeros(4))


def test_the_fit_finds_the_weights():
    true = Hysteresis(0.03, RADII, np.zeros(4), np.array([0.8, 0.05, 0.1, 0.0, 0.2]))
    x = wander(1)
    found = fit_hysteresis(RADII, np.zeros(4), x, plays_of(x), true.answer(x))
    assert found.weights == pytest.approx(true.weights, abs=1e-9)
    assert found.offset == pytest.approx(0.03, abs=1e-9)


def test_weights_that_have_no_inverse_are_not_fitted():
    x = wander(2)
    against = 0.5 - 0.4 * x  # falls where the command rises
    found = fit_hysteresis(RADII, np.zeros(4), x, plays_of(x), against)
    assert (found.weights[1:] >= 0.0).all()
    assert found.weights[0] > 0.0
    whole, bend = fit_modified(RADII, np.zeros(4), x, plays_of(x), against)
    assert whole.weights[0] > 0.0
    assert (np.cumsum(bend.slopes) > 0.0).all()


def test_the_modified_form_undoes_a_loop_that_saturates():
    plain = Hysteresis(0.0, RADII, np.zeros(4), np.array([0.7, 0.05, 0.05, 0.1, 0.1]))
    x, unseen = wander(3, 6000), wander(4)

    def saturating(commands):
        return np.tanh(1.2 * plain.answer(commands))

    whole, bend = fit_modified(RADII, np.zeros(4), x, plays_of(x), saturating(x))
    table = np.stack([[bend.offset, *bend.at], bend.slopes])
    straight = np.array([kernel.bent(table, y) for y in saturating(unseen)])
    left = whole.inverse().answer(straight) - unseen
    assert np.sqrt(np.mean(left**2)) < 0.004
    classical = fit_hysteresis(RADII, np.zeros(4), x, plays_of(x), saturating(x))
    worse = classical.inverse().answer(saturating(unseen) - classical.offset) - unseen
    assert np.sqrt(np.mean(left**2)) < 0.2 * np.sqrt(np.mean(worse**2))
