"""The tap of a session: what the worker has worked up, for whoever wants it."""

import logging

import numpy as np

from rotemina.app.motion.state import Connection


def test_a_tap_gets_every_sample_once_with_the_model(stepped):
    portions = []
    end = stepped.session.tap(lambda *portion: portions.append(portion))
    before = len(stepped.session.history.tail())
    stepped.session.go_to({"x": 0.028})
    stepped.until_idle()
    window = stepped.session.history.tail()
    times = np.concatenate([samples.device_time_s for samples, _ in portions])
    models = np.concatenate([model for _, (model, *_) in portions])
    np.testing.assert_array_equal(times, window.device_time_s[before:])
    np.testing.assert_array_equal(models, window.model[before:])
    end()
    end()
    told = len(portions)
    stepped.step(0.05, 3)
    assert len(portions) == told


def test_a_failing_tap_neither_stops_the_worker_nor_the_other_taps(stepped, caplog):
    counts = []

    def fail(samples, model):
        raise RuntimeError("no room")

    stepped.session.tap(fail)
    stepped.session.tap(lambda samples, _: counts.append(len(samples)))
    with caplog.at_level(logging.ERROR):
        state = stepped.step(0.02, 10)
    assert state.connection is Connection.CONNECTED
    assert sum(counts) == 200
    assert [record.message for record in caplog.records] == ["a tap failed"]


def test_a_tap_may_end_itself(stepped):
    told = []

    def once(samples, model):
        told.append(len(samples))
        end()
        raise RuntimeError("gone")

    end = stepped.session.tap(once)
    stepped.step(0.02, 5)
    assert len(told) == 1


def test_samples_are_as_old_as_their_reading_not_as_their_working_up(stepped):
    stepped.step(0.0165)
    read_s = stepped.clock()
    stepped.step(0.0004)  # too short for another sample: time to work up those before
    assert stepped.session.snapshot().sample_host_time_s == read_s


def test_the_host_time_of_a_stop_is_kept(stepped):
    assert stepped.session.stop_asked_s is None
    stepped.session.emergency_stop()
    assert stepped.session.stop_asked_s == stepped.clock()
