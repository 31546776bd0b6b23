"""A replay that is paced by a clock: its speed, pauses and seeks."""

import pytest

from rotemina.app.motion.recording import PacedReplay, Recording, Replay


@pytest.fixture
def paced(harness, record, clock):
    recorded_session = record(harness)
    recorded_session.rest(1.0)
    return PacedReplay(Replay(Recording.open(recorded_session.recorder.close())), clock)


def test_the_position_follows_the_clock_times_the_speed(paced, clock):
    clock.advance(5.0)
    paced.step()
    assert paced.position_s == 0.0
    paced.play()
    clock.advance(0.1)
    paced.step()
    assert paced.position_s == pytest.approx(0.1)
    paced.speed = 2.0
    clock.advance(0.1)
    paced.step()
    assert paced.position_s == pytest.approx(0.3)
    paced.pause()
    clock.advance(0.1)
    paced.step()
    assert paced.position_s == pytest.approx(0.3)
    assert paced.replay.snapshot().age_s < 0.05


def test_a_late_screen_does_not_catch_up(paced, clock):
    paced.play()
    clock.advance(3.0)
    paced.step()
    assert paced.position_s == pytest.approx(0.25)


def test_it_pauses_at_the_end_and_can_start_again(paced, clock):
    paced.seek(100.0)
    assert paced.position_s == paced.duration_s == pytest.approx(1.0, abs=0.03)
    paced.play()  # from the begin, because the end was reached
    assert paced.position_s == 0.0
    paced.speed = 20.0
    for _ in range(3):
        clock.advance(0.1)
        paced.step()
    assert paced.position_s == paced.duration_s
    assert not paced.is_playing


def test_only_the_last_of_several_seeks_counts(paced, monkeypatch):
    times_s = []
    seek = paced.replay.seek
    monkeypatch.setattr(paced.replay, "seek", lambda at_s: (times_s.append(at_s), seek(at_s)))
    for at_s in (0.2, 0.9, 0.5):
        paced.seek(at_s)
    paced.step()
    assert times_s == [pytest.approx(paced.replay.recording.began_s + 0.5)]
    assert paced.position_s == pytest.approx(0.5)


@pytest.mark.parametrize("speed", [0.05, 21.0, float("nan")])
def test_a_speed_out_of_bounds_is_refused(paced, speed):
    with pytest.raises(ValueError, match="must be"):
        paced.speed = speed
