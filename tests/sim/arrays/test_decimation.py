"""Decimation for a plot keeps every peak."""

import numpy as np
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays

from rotemina.sim.arrays import decimate_to_envelope


@given(arrays(np.float64, st.integers(1, 3000), elements=st.floats(-1e9, 1e9)), st.integers(1, 40))
def test_decimation_keeps_minimum_and_maximum(values, buckets):
    time_s = np.arange(len(values), dtype=float)
    decimated_time, decimated = decimate_to_envelope(time_s, values, buckets)
    assert len(decimated) <= min(len(values), 2 * buckets)
    assert decimated.min() == values.min()
    assert decimated.max() == values.max()
    assert np.all(np.diff(decimated_time) >= 0)
    assert np.array_equal(decimated, values[decimated_time.astype(int)])


def test_a_short_signal_is_not_changed():
    time_s, values = np.arange(10.0), np.arange(10.0)
    assert decimate_to_envelope(time_s, values, 5)[1] is values
