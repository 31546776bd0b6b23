"""A replay goes on by a clock, at a speed, and jumps."""

import pytest

from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.replay import Replay
from rotemina.app.motion.recording.replay_pace import PacedReplay


@pytest.fixture
def paced(stepped, record, clock):
    recorded = record(stepped)
    recorded.rest(1.0)
    return PacedReplay(Replay(Recording.open(recorded.recorder.close())), clock)


def test_it_goes_on_by_the_clock_times_the_speed(paced, clock):
    clock.advance(5.0)
    paced.step()
    assert paced.at_s == 0.0
    paced.play()
    clock.advance(0.1)
    paced.step()
    assert paced.at_s == pytest.approx(0.1)
    paced.speed = 2.0
    clock.advance(0.1)
    paced.step()
    assert paced.at_s == pytest.approx(0.3)
    paced.pause()
    clock.advance(0.1)
    paced.step()
    assert paced.at_s == pytest.approx(0.3)
    assert paced.replay.snapshot().age_s < 0.05


def test_a_screen_that_was_late_does_not_make_up_for_it(paced, clock):
    paced.play()
    clock.advance(3.0)
    paced.step()
    assert paced.at_s == pytest.approx(0.25)


def test_it_pauses_at_the_end_and_begins_anew(paced, clock):
    paced.seek(100.0)
    assert paced.at_s == paced.duration_s == pytest.approx(1.0, abs=0.03)
    paced.play()  # from the begin, as the end is reached
    assert paced.at_s == 0.0
    paced.speed = 20.0
    for _ in range(3):
        clock.advance(0.1)
        paced.step()
    assert paced.at_s == paced.duration_s
    assert not paced.playing


def test_of_many_jumps_the_last_one_counts(paced, monkeypatch):
    sought = []
    seek = paced.replay.seek
    monkeypatch.setattr(paced.replay, "seek", lambda at_s: (sought.append(at_s), seek(at_s)))
    for at_s in (0.2, 0.9, 0.5):
        paced.seek(at_s)
    paced.step()
    assert sought == [pytest.approx(paced.replay.recording.began_s + 0.5)]
    assert paced.at_s == pytest.approx(0.5)


@pytest.mark.parametrize("speed", [0.0, 0.05, 21.0, -1.0, float("nan")])
def test_a_speed_out_of_bounds_is_refused(paced, speed):
    with pytest.raises(ValueError, match="must be"):
        paced.speed = speed
