"""Weights of hypotheses by their remainder in unseen data."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.held_out_power import Power
from rotemina.sim.gap.compare.weights import weigh


def make_power(*means, blocks=32, counted=50.0):
    """Return the power that hypotheses leave, equal in all blocks of ten rows."""
    squares = 10.0 * np.outer(means, np.ones(blocks))
    return [Power(squares, np.full(blocks, 10.0), counted)]


def test_weights_are_shares_and_the_smallest_remainder_is_likeliest():
    weights = weigh(make_power(9.0, 3.0, 30.0), [1, 1, 1])
    assert weights.sum() == pytest.approx(1.0)
    assert np.argsort(-weights).tolist() == [1, 0, 2]
    assert weights[1] > 0.99


def test_equal_hypotheses_share_the_weight_and_another_effect_must_improve_the_fit():
    equal = weigh(make_power(3.0, 3.0), [1, 1])
    assert equal == pytest.approx([0.5, 0.5])
    simple = weigh(make_power(3.0, 2.95), [1, 2])
    assert simple[0] > 0.7


def test_a_smaller_remainder_below_the_floor_gains_no_weight():
    below = weigh(make_power(0.9, 0.4), [0, 1])
    assert below[0] > 0.9


def test_evidence_from_a_single_block_is_not_sure():
    """If only one block distinguishes two hypotheses, it is often drawn with almost no weight."""
    steady = weigh(make_power(4.0, 1.6), [0, 1])
    squares = np.full((2, 32), 16.0)
    squares[0, 5] += 10.0 * 32 * 2.4
    single_block = weigh([Power(squares, np.full(32, 10.0), 50.0)], [0, 1])
    assert steady[1] > 0.99
    assert single_block[1] < steady[1] - 0.05
