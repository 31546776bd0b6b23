"""When samples are worked up: as often as a screen shows them, in a cycle that has the time."""

import numpy as np
import pytest

from rotemina.app.motion.sample_portions import SamplePortions
from rotemina.drivers.samples import Samples


def rows(*times_s):
    values = np.zeros((len(times_s), 1))
    return Samples(np.array(times_s), values, values, values, np.full(len(times_s), -1))


@pytest.fixture
def portions():
    """A portion was worked up at 1 s."""
    portions = SamplePortions()
    portions.add(rows(1.0), 1.0)
    portions.take(1.0, 1)
    return portions


def test_the_first_portion_is_due_at_once():
    portions = SamplePortions()
    portions.add(rows(), 1.0)
    assert not portions.idle
    assert portions.due(news=False)


def test_a_portion_waits_for_its_time(portions):
    portions.add(rows(), 1.015)
    assert portions.idle
    portions.add(rows(), 1.017)
    assert portions.due(news=False)


def test_a_cycle_that_has_read_leaves_the_work_to_the_next_one_but_not_for_long(portions):
    portions.add(rows(1.017), 1.017)
    assert not portions.due(news=False)
    portions.add(rows(1.02), 1.02)
    assert portions.due(news=False)


def test_news_do_not_wait(portions):
    portions.add(rows(1.001), 1.001)
    assert portions.due(news=True)


def test_a_portion_has_all_rows_since_the_last_one(portions):
    portions.add(rows(1.001), 1.001)
    portions.add(rows(1.002, 1.003), 1.003)
    portions.add(rows(), 1.016)
    assert portions.take(1.016, 1).device_time_s.tolist() == [1.001, 1.002, 1.003]
    assert portions.received_s == 1.003
    assert len(portions.take(1.032, 1)) == 0


def test_after_a_reconnection_nothing_old_is_left(portions):
    portions.add(rows(1.001), 1.001)
    portions.restart()
    portions.add(rows(), 1.002)
    assert portions.due(news=False)
    assert len(portions.take(1.002, 1)) == 0
