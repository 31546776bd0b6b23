"""Signals of a report, recomputed from the effects found."""

import numpy as np
import pytest

from rotemina.sim.gap.output import compute_traces
from rotemina.sim.records import Tap


@pytest.fixture(scope="module")
def traces(diagnosis, records):
    return compute_traces(diagnosis, "thx", records)


def test_each_record_has_a_trace_without_mean_in_which_the_corrected_model_is_closer(
    diagnosis, traces, records
):
    assert diagnosis.fitted
    assert [trace.number for trace in traces if trace.tap is Tap.MEAS] == list(range(len(records)))
    for trace in traces:
        assert trace.time_s[0] == 0.0
        assert len(trace.time_s) == len(trace.real) == len(trace.raw) == len(trace.corrected)
        assert trace.gap_before.mean() == pytest.approx(0.0, abs=1e-12)
        assert trace.gap_after.mean() == pytest.approx(0.0, abs=1e-12)
        if trace.tap is Tap.MEAS:
            assert trace.is_corrected
            assert np.std(trace.gap_after) < 0.2 * np.std(trace.gap_before)


def test_a_record_that_does_not_measure_the_axis_has_no_trace(diagnosis, records):
    assert compute_traces(diagnosis, "zn", records) == ()
