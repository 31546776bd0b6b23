"""Resuming a playback: it waits for rest, moves axes back on request, and ends with a stop."""

import numpy as np
import pytest

from rotemina.app.motion.playback import Playback, PlaybackPhase, PlaybackResumption, ResumeStep
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap
from rotemina.sim.trajectory.checked_trajectory import check_and_seal

ROWS = 2001


class ResumptionBench:
    """A paused playback of a fast swing, and the refusals of its resumption."""

    def __init__(self, harness):
        self.harness, self.session = harness, harness.session
        self.playback = Playback(self.session)
        self.refusals = []
        self.resumption = PlaybackResumption(
            self.session, self.playback, self._ask, self.refusals.append
        )
        time_s = np.arange(ROWS) * 1e-3
        path = 0.02 + 4e-3 * np.sin(np.pi * time_s / 2.0) ** 4
        record = Record.from_signals(time_s, {("x", Tap.CMD): path}, {"x": "m"})
        self.playback.play(check_and_seal(self.session.robot, record, 1e-3))
        while self.playback.state.row < 500:
            harness.step(0.005)
        self.playback.pause()

    def _ask(self, request, done, failed):
        try:
            request()
        except InputError as error:
            self.refusals.append(str(error))
            failed()
        else:
            done()

    def begin(self, **options):
        self.resumption.begin(self.session.permit(), **options)

    def step(self, times=1):
        for _ in range(times):
            self.harness.step(0.005)
            self.resumption.step()

    def step_until_paused(self):
        while self.playback.state.pausing:
            self.harness.step(0.005)

    def step_until(self, condition):
        for _ in range(4000):
            self.step()
            if condition():
                return
        raise AssertionError(self.playback.state)

    def move_away(self):
        self.step_until_paused()
        self.session.jog("y", 2.7e-3)
        self.harness.step_until_idle()

    @property
    def is_playing(self):
        return self.session.snapshot().activity is DeviceState.PLAYING


@pytest.fixture
def bench(make_harness):
    resumption_bench = ResumptionBench(make_harness(settings={"settle_s": 0.1}))
    yield resumption_bench
    resumption_bench.playback.close()


def test_a_request_during_braking_resumes_at_rest(bench):
    while bench.playback.state.phase is not PlaybackPhase.PAUSED:
        bench.harness.step(0.001)
    assert bench.playback.state.pausing
    bench.begin()
    assert bench.resumption.waits_for is ResumeStep.RESTING
    bench.step_until(lambda: bench.is_playing)
    assert bench.resumption.waits_for is ResumeStep.NONE
    bench.harness.step_until_idle()
    assert bench.playback.state.row == ROWS - 1
    assert bench.refusals == []


def test_axes_move_back_and_then_the_playback_continues(bench):
    bench.move_away()
    row = bench.playback.state.row
    bench.begin(moves_back=True)
    bench.step()
    assert bench.resumption.waits_for is ResumeStep.RETURNING
    assert set(bench.session.snapshot().owners.values()) == {"playback"}
    bench.step_until(lambda: bench.is_playing)
    assert bench.playback.state.row >= row
    bench.harness.step_until_idle()
    assert bench.playback.state.row == ROWS - 1
    assert bench.refusals == []


def test_axes_do_not_move_back_without_a_request(bench):
    bench.move_away()
    bench.begin()
    assert bench.refusals == [
        "axis y moved 2.7 mm since the pause; move it back first, or play the trajectory from its "
        "first row"
    ]
    assert bench.session.at_rest
    assert bench.playback.state.phase is PlaybackPhase.PAUSED


@pytest.mark.parametrize(
    ("end", "refusals", "phase"),
    [
        (
            lambda bench: bench.session.stop(),
            ["Not resumed: the machine was stopped again."],
            PlaybackPhase.PAUSED,
        ),
        (lambda bench: bench.playback.end(), [], PlaybackPhase.IDLE),
    ],
)
def test_only_a_stop_during_the_return_ends_it_with_a_message(bench, end, refusals, phase):
    bench.move_away()
    bench.begin(moves_back=True)
    bench.begin()  # a second request has no effect
    assert bench.resumption.waits_for is ResumeStep.RETURNING
    bench.step(20)
    end(bench)
    bench.step(400)
    assert bench.refusals == refusals
    assert bench.session.at_rest
    assert bench.playback.state.phase is phase
    if phase is PlaybackPhase.PAUSED:
        assert 1e-3 < bench.playback.state.moved["y"] < 2.7e-3
