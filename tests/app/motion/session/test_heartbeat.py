"""A motion that an operator began continues only while the window responds."""

import pytest
from tests.app.motion.session.test_session import make_swing

from rotemina.app.motion.session import BEAT_PERIOD_S
from rotemina.app.motion.session.heartbeat import MAX_SILENCE_S
from rotemina.app.motion.state import PROGRAM
from rotemina.drivers.contract import DeviceState

MOTIONS = {
    "go_to": lambda session: session.go_to({"x": 0.05}),
    "play": lambda session: session.play(make_swing()),
}


@pytest.mark.parametrize("begin", MOTIONS)
def test_a_hanging_window_stops_the_motion(harness, begin):
    session = harness.session
    session.screen_heartbeat.beat()
    MOTIONS[begin](session)
    harness.step(0.02, round(0.9 * MAX_SILENCE_S / 0.02))
    assert session.snapshot().stop is None
    assert session.snapshot().activity is not DeviceState.IDLE
    harness.step(0.02, 7)
    stop = session.snapshot().stop
    assert (stop.by, stop.why) == (PROGRAM, "the window does not respond")
    harness.step_until_idle()
    assert session.snapshot().stop is stop, "stopped once, not in every cycle"


def test_neither_a_responding_window_nor_a_closed_one_stops_the_motion(harness):
    session = harness.session
    session.go_to({"x": 0.05})
    for _ in range(8):
        session.screen_heartbeat.beat()
        harness.step(BEAT_PERIOD_S)
    assert session.snapshot().stop is None
    session.screen_heartbeat.end()
    harness.step(0.02, 100)
    assert session.snapshot().stop is None


def test_a_hanging_window_stops_a_motion_that_begins_later(harness):
    """A stick or a late click must not move anything that the operator cannot see."""
    harness.session.screen_heartbeat.beat()
    harness.step(0.02, 100)
    assert harness.session.snapshot().stop is None
    harness.session.go_to({"x": 0.05})
    harness.step(0.02, 4)
    assert harness.session.snapshot().stop is not None
    assert not harness.session.pulse.is_silent
