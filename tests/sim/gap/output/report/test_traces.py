"""Signals of a report, recomputed from the effects found."""

import numpy as np
import pytest

from rotemina.sim.gap.output.report.traces import traces
from rotemina.sim.records.record import Tap


@pytest.fixture(scope="module")
def found(diagnosis, records):
    return traces(diagnosis, "thx", records)


def test_each_record_speaks_of_each_tap_that_it_measures(found, records):
    assert [one.number for one in found if one.tap is Tap.MEAS] == list(range(len(records)))
    for one in found:
        assert one.time_s[0] == 0.0
        assert len(one.time_s) == len(one.real) == len(one.raw) == len(one.corrected)


def test_the_mean_distance_is_a_nuisance(found):
    for one in found:
        assert one.before.mean() == pytest.approx(0.0, abs=1e-12)
        assert one.after.mean() == pytest.approx(0.0, abs=1e-12)


def test_the_corrected_model_is_nearer(diagnosis, found):
    assert diagnosis.fitted
    for one in found:
        if one.tap is Tap.MEAS:
            assert one.changed
            assert np.std(one.after) < 0.2 * np.std(one.before)


def test_a_record_that_does_not_measure_the_axis_says_nothing(diagnosis, records):
    assert traces(diagnosis, "zn", records) == ()
