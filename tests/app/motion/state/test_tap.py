"""The tap of a session, which passes on all processed samples."""

import logging

import numpy as np

from rotemina.app.motion.state import ConnectionState


def test_a_tap_gets_every_sample_once_with_the_model(harness):
    portions = []
    remove_tap = harness.session.tap(lambda *portion: portions.append(portion))
    previous_count = len(harness.session.history.tail())
    harness.session.go_to({"x": 0.028})
    harness.step_until_idle()
    window = harness.session.history.tail()
    times = np.concatenate([samples.device_time_s for samples, _ in portions])
    models = np.concatenate([model for _, (model, *_) in portions])
    np.testing.assert_array_equal(times, window.device_time_s[previous_count:])
    np.testing.assert_array_equal(models, window.model[previous_count:])
    remove_tap()
    remove_tap()
    portion_count = len(portions)
    harness.step(0.05, 3)
    assert len(portions) == portion_count


def test_a_failing_tap_stops_neither_the_worker_nor_the_other_taps(harness, caplog):
    counts, failed_counts = [], []

    def fail_once(samples, model):
        failed_counts.append(len(samples))
        remove_tap()
        raise RuntimeError("no room")

    remove_tap = harness.session.tap(fail_once)
    harness.session.tap(lambda samples, _: counts.append(len(samples)))
    with caplog.at_level(logging.ERROR):
        state = harness.step(0.02, 10)
    assert state.connection is ConnectionState.CONNECTED
    assert sum(counts) == 200
    assert len(failed_counts) == 1
    assert [record.message for record in caplog.records] == ["a tap failed"]


def test_the_age_of_samples_counts_from_their_reading(harness):
    harness.step(0.0165)
    read_s = harness.clock()
    harness.step(0.0004)  # too short for another sample, but enough to process the earlier ones
    assert harness.session.snapshot().sample_host_time_s == read_s
