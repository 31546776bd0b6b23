"""Weights of hypotheses by what they leave of unseen data."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.held_out_power import Power
from rotemina.sim.gap.compare.weights import weigh


def power(*means, blocks=32, counted=50.0):
    """Hypotheses that leave so much, the same in every block of ten rows."""
    squares = 10.0 * np.outer(means, np.ones(blocks))
    return [Power(squares, np.full(blocks, 10.0), counted)]


def test_weights_are_shares_and_the_one_that_leaves_least_is_likeliest():
    weights = weigh(power(9.0, 3.0, 30.0), [1, 1, 1])
    assert weights.sum() == pytest.approx(1.0)
    assert np.argsort(-weights).tolist() == [1, 0, 2]
    assert weights[1] > 0.99


def test_what_does_as_well_shares_the_weight_and_a_further_effect_must_earn_its_place():
    twins = weigh(power(3.0, 3.0), [1, 1])
    assert twins == pytest.approx([0.5, 0.5])
    simple = weigh(power(3.0, 2.95), [1, 2])
    assert simple[0] > 0.7


def test_below_the_floor_nothing_is_gained():
    below = weigh(power(0.9, 0.4), [0, 1])
    assert below[0] > 0.9


def test_what_rests_on_one_moment_is_not_sure():
    """One block holds all that tells the two apart: it is often drawn with next to no weight."""
    steady = weigh(power(4.0, 1.6), [0, 1])
    squares = np.full((2, 32), 16.0)
    squares[0, 5] += 10.0 * 32 * 2.4
    at_once = weigh([Power(squares, np.full(32, 10.0), 50.0)], [0, 1])
    assert steady[1] > 0.99
    assert at_once[1] < steady[1] - 0.05
