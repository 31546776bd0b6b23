"""Thinning for a drawing keeps every peak."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rotemina.sim.decimation import envelope


@given(arrays(np.float64, st.integers(1, 3000), elements=st.floats(-1e9, 1e9)), st.integers(1, 40))
def test_every_bucket_keeps_its_lowest_and_highest(values, buckets):
    time_s = np.arange(len(values), dtype=float)
    thin_time, thin = envelope(time_s, values, buckets)
    assert len(thin) <= min(len(values), 2 * buckets)
    assert thin.min() == values.min()
    assert thin.max() == values.max()
    assert np.all(np.diff(thin_time) >= 0)
    assert np.array_equal(thin, values[thin_time.astype(int)])


def test_a_single_spike_among_a_million_samples_is_drawn():
    values = np.zeros(1_000_000)
    values[765_432] = 1.0
    time_s = np.arange(1_000_000.0)
    thin_time, thin = envelope(time_s, values, 300)
    assert len(thin) <= 602
    assert thin_time[thin.argmax()] == 765_432


def test_a_short_signal_is_left_as_it_is():
    time_s, values = np.arange(10.0), np.arange(10.0)
    assert envelope(time_s, values, 5)[1] is values
