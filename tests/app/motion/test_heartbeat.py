"""What an operator began moves on only as long as the window answers."""

import pytest
from tests.app.motion.test_session import there_and_back

from rotemina.app.motion.heartbeat import PERIOD_S, SILENT_S
from rotemina.app.motion.stop import PROGRAM
from rotemina.drivers.samples import DeviceState

BEGUN = {
    "go_to": lambda session: session.go_to({"x": 0.05}),
    "play": lambda session: session.play(there_and_back()),
}


@pytest.mark.parametrize("begin", BEGUN)
def test_a_window_that_hangs_stops_what_moves(stepped, begin):
    session = stepped.session
    session.screen.beat()
    BEGUN[begin](session)
    stepped.step(0.02, round(0.9 * SILENT_S / 0.02))
    assert session.snapshot().stop is None
    assert session.snapshot().activity is not DeviceState.IDLE
    stepped.step(0.02, 7)
    stop = session.snapshot().stop
    assert (stop.by, stop.why) == (PROGRAM, "the window does not respond")
    stepped.until_idle()
    assert session.snapshot().stop is stop, "stopped once, not in every cycle"


def test_a_window_that_beats_is_not_in_the_way(stepped):
    session = stepped.session
    session.go_to({"x": 0.05})
    for _ in range(8):
        session.screen.beat()
        stepped.step(PERIOD_S)
    assert session.snapshot().stop is None


def test_without_a_window_nobody_is_waited_for(stepped):
    stepped.session.screen.beat()
    stepped.session.screen.end()
    stepped.session.go_to({"x": 0.05})
    stepped.step(0.02, 100)
    assert stepped.session.snapshot().stop is None


def test_a_window_that_hangs_at_rest_stops_what_is_begun_then(stepped):
    """A stick, or a click that was on its way, moves nothing that nobody sees."""
    stepped.session.screen.beat()
    stepped.step(0.02, 100)
    assert stepped.session.snapshot().stop is None
    stepped.session.go_to({"x": 0.05})
    stepped.step(0.02, 4)
    assert stepped.session.snapshot().stop is not None
    assert not stepped.session.pulse.silent
