"""Processing of samples at the rate of a screen, in cycles that have time for it."""

import numpy as np
import pytest

from rotemina.app.motion.device.sample_portions import SampleBatches
from rotemina.drivers.contract import DeviceSamples


def make_rows(*times_s):
    values = np.zeros((len(times_s), 1))
    return DeviceSamples(np.array(times_s), values, values, values, np.full(len(times_s), -1))


@pytest.fixture
def portions():
    """Portions of which one was processed at 1 s."""
    portions = SampleBatches()
    portions.add(make_rows(1.0), 1.0)
    portions.take(1.0, 1)
    return portions


def test_the_first_portion_is_due_at_once():
    portions = SampleBatches()
    portions.add(make_rows(), 1.0)
    assert not portions.is_idle
    assert portions.is_due(urgent=False)


def test_a_portion_waits_for_its_time(portions):
    portions.add(make_rows(), 1.015)
    assert portions.is_idle
    portions.add(make_rows(), 1.017)
    assert portions.is_due(urgent=False)


def test_a_cycle_with_samples_defers_processing_only_once(portions):
    portions.add(make_rows(1.017), 1.017)
    assert not portions.is_due(urgent=False)
    portions.add(make_rows(1.02), 1.02)
    assert portions.is_due(urgent=False)


def test_urgent_portions_do_not_wait(portions):
    portions.add(make_rows(1.001), 1.001)
    assert portions.is_due(urgent=True)


def test_a_portion_has_all_rows_since_the_last_one(portions):
    portions.add(make_rows(1.001), 1.001)
    portions.add(make_rows(1.002, 1.003), 1.003)
    portions.add(make_rows(), 1.016)
    assert portions.take(1.016, 1).device_time_s.tolist() == [1.001, 1.002, 1.003]
    assert portions.received_s == 1.003
    assert len(portions.take(1.032, 1)) == 0


def test_after_a_reconnection_no_old_samples_remain(portions):
    portions.add(make_rows(1.001), 1.001)
    portions.restart()
    portions.add(make_rows(), 1.002)
    assert portions.is_due(urgent=False)
    assert len(portions.take(1.002, 1)) == 0
