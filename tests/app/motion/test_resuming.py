"""Resuming a playback: it waits for rest, moves axes back if asked, and ends with a stop."""

import numpy as np
import pytest

from rotemina.app.motion.playback import Playback, PlaybackPhase
from rotemina.app.motion.resuming import ResumeStep, Resumption
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.trajectory.checked_trajectory import check

ROWS = 2001


class Bench:
    """A paused playback of a fast swing, and what was said while it was to be resumed."""

    def __init__(self, stepped):
        self.stepped, self.session = stepped, stepped.session
        self.playback = Playback(self.session)
        self.refusals = []
        self.resumption = Resumption(self.session, self.playback, self._ask, self.refusals.append)
        time_s = np.arange(ROWS) * 1e-3
        path = 0.02 + 4e-3 * np.sin(np.pi * time_s / 2.0) ** 4
        record = Record.from_signals(time_s, {("x", Tap.CMD): path}, {"x": "m"})
        self.playback.play(check(self.session.robot, record, 1e-3))
        while self.playback.state.row < 500:
            stepped.step(0.005)
        self.playback.pause()

    def _ask(self, request, done, undone):
        try:
            request()
        except InputError as error:
            self.refusals.append(str(error))
            undone()
        else:
            done()

    def begin(self, **options):
        self.resumption.begin(self.session.permit(), **options)

    def step(self, times=1):
        for _ in range(times):
            self.stepped.step(0.005)
            self.resumption.step()

    def until_paused(self):
        while self.playback.state.pausing:
            self.stepped.step(0.005)

    def until(self, reached):
        for _ in range(4000):
            self.step()
            if reached():
                return
        raise AssertionError(self.playback.state)

    def move_away(self):
        self.until_paused()
        self.session.jog("y", 2.7e-3)
        self.stepped.until_idle()

    @property
    def plays(self):
        return self.session.snapshot().activity is DeviceState.PLAYING


@pytest.fixture
def bench(make_stepped):
    made = Bench(make_stepped(settings={"settle_s": 0.1}))
    yield made
    made.playback.close()


def test_pressed_while_the_axes_still_brake_it_resumes_once_they_rest(bench):
    while bench.playback.state.phase is not PlaybackPhase.PAUSED:
        bench.stepped.step(0.001)
    assert bench.playback.state.pausing
    bench.begin()
    assert bench.resumption.waits_for is ResumeStep.RESTING
    bench.until(lambda: bench.plays)
    assert bench.resumption.waits_for is ResumeStep.NONE
    bench.stepped.until_idle()
    assert bench.playback.state.row == ROWS - 1
    assert bench.refusals == []


def test_axes_move_back_and_then_it_plays_on(bench):
    bench.move_away()
    row = bench.playback.state.row
    bench.begin(moves_back=True)
    bench.step()
    assert bench.resumption.waits_for is ResumeStep.RETURNING
    assert set(bench.session.snapshot().owners.values()) == {"playback"}
    bench.until(lambda: bench.plays)
    assert bench.playback.state.row >= row
    bench.stepped.until_idle()
    assert bench.playback.state.row == ROWS - 1
    assert bench.refusals == []


def test_nothing_moves_back_unasked(bench):
    bench.move_away()
    bench.begin()
    assert bench.refusals == [
        "axis y moved 2.7 mm since the pause; move it back first, or play the trajectory from its "
        "first row"
    ]
    assert bench.session.at_rest
    assert bench.playback.state.phase is PlaybackPhase.PAUSED


def test_a_stop_on_the_way_back_ends_the_resumption_and_says_so(bench):
    bench.move_away()
    bench.begin(moves_back=True)
    bench.step(20)
    bench.session.stop()
    bench.step(400)
    assert bench.refusals == ["Not resumed: the machine was stopped again."]
    assert bench.session.at_rest
    assert bench.playback.state.phase is PlaybackPhase.PAUSED
    assert 1e-3 < bench.playback.state.moved["y"] < 2.7e-3


def test_the_end_of_the_playback_on_the_way_back_needs_no_word(bench):
    bench.move_away()
    bench.begin(moves_back=True)
    bench.step(20)
    bench.playback.end()
    bench.step(400)
    assert bench.refusals == []
    assert bench.playback.state.phase is PlaybackPhase.IDLE
    assert bench.session.at_rest


def test_a_second_request_changes_nothing(bench):
    bench.move_away()
    bench.begin(moves_back=True)
    bench.begin()
    assert bench.resumption.waits_for is ResumeStep.RETURNING
    assert bench.refusals == []
