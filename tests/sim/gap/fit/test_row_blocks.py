"""Blocks of rows, and means of randomly drawn blocks."""

import numpy as np
import pytest

from rotemina.sim.gap.fit import (
    block_numbers,
    drawn_means,
    summed,
)


def test_a_hold_of_any_length_is_one_block():
    time_s = np.arange(2000) / 1000.0
    command = np.where(time_s < 1.0, 0.0, time_s - 1.0)
    numbers = block_numbers(time_s, command)
    assert len(np.unique(numbers[:1000])) == 1
    assert len(np.unique(numbers[1001:])) in (4, 5)


def test_means_of_drawn_blocks_have_the_spread_of_the_blocks():
    rng = np.random.default_rng(0)
    values = rng.normal(3.0, 1.0, 400)
    blocks = summed(np.arange(400), values[:, None])
    means = drawn_means(blocks, np.random.default_rng(1), draws=2000)
    assert means.mean() == pytest.approx(values.mean(), abs=0.02)
    assert means.std() == pytest.approx(values.std() / 20.0, rel=0.1)
