"""Notices of the window go when what they tell of is over, each by what it knows of its cause."""

import pytest

from rotemina.app.motion.state import Connection
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.trajectory.first_trajectory import example_for

LONG_MS = 30_000
LOST = message("engine", "{url}: the port has disappeared").fill(url="COM9")


class Unplugged(Simulator):
    """A simulator whose link can be cut."""

    cut = False

    def _read(self):
        if self.cut:
            raise ConnectionLostError(LOST)
        return super()._read()


def texts(window):
    return [notice.text for notice in window.notices.notices()]


def seen(window, part):
    return any(part in text for text in texts(window))


@pytest.fixture
def unplugged(make_robot_window, qtbot):
    """A window on a simulator whose link has been lost."""
    window = make_robot_window(driver=Unplugged)
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().locked is None, timeout=LONG_MS)
    session.driver.cut = True
    qtbot.waitUntil(lambda: seen(window, "disappeared"), timeout=LONG_MS)
    return window


def test_a_lost_links_notice_goes_when_there_is_a_link_again(qtbot, unplugged):
    bench = unplugged.workbench
    bench.session.driver.cut = False
    bench.reconnect()
    qtbot.waitUntil(
        lambda: bench.session.snapshot().connection is Connection.CONNECTED, timeout=LONG_MS
    )
    qtbot.waitUntil(lambda: not seen(unplugged, "disappeared"), timeout=LONG_MS)


def test_a_lost_links_notice_goes_when_another_device_is_used(qtbot, unplugged):
    bench = unplugged.workbench
    assert bench.use_driver(Simulator, {})
    qtbot.waitUntil(lambda: not seen(unplugged, "disappeared"), timeout=LONG_MS)


def test_what_was_missing_is_no_longer_asked_for_once_it_is_there(qtbot, window):
    bench = window.workbench
    bench.play()
    assert seen(window, "no trajectory to play")
    bench.plan_trajectory("first", example_for(bench.robot))
    qtbot.waitUntil(lambda: not seen(window, "no trajectory to play"), timeout=LONG_MS)


def test_a_refusal_goes_when_the_same_is_taken_and_with_the_next_action(qtbot, window):
    bench = window.workbench
    bench.emergency_stop()
    for _ in range(2):
        bench.jog("x", 1e-5)
    assert [notice.count for notice in window.notices.notices()] == [2]
    bench.release()
    bench.jog("x", 1e-5)
    assert texts(window) == []
    bench.go_to({"x": 99.0})
    assert len(texts(window)) == 1
    window.notices._clock = lambda: 1e12  # much later
    bench.jog("x", 1e-5)
    assert texts(window) == []


def test_work_that_is_done_settles_its_earlier_failure_alone(qtbot, window, tmp_path):
    bench = window.workbench
    done = []

    def fail():
        raise ConnectionLostError(LOST)

    for kind in ("one", "other"):  # for the same reason, so it is one notice
        bench.work(kind, "", fail, done.append)
    qtbot.waitUntil(
        lambda: [notice.count for notice in window.notices.notices()] == [2], timeout=LONG_MS
    )
    for kind, left in (("one", True), ("other", False)):
        bench.work(kind, "", lambda kind=kind: kind, done.append)
        qtbot.waitUntil(lambda kind=kind: done[-1:] == [kind], timeout=LONG_MS)
        assert seen(window, "disappeared") is left


def test_a_record_that_could_not_be_kept_is_settled_when_it_is_saved(
    qtbot, window, tmp_path, monkeypatch
):
    def refuse(*_):
        raise InputError(LOST)

    monkeypatch.setattr("rotemina.app.shell.played_records.write_played", refuse)
    bench = window.workbench
    bench.plan_trajectory("first", example_for(bench.robot).part(slice(0, 100)))
    qtbot.waitUntil(lambda: bench.plan is not None, timeout=LONG_MS)
    bench.play()
    qtbot.waitUntil(lambda: seen(window, "disappeared"), timeout=LONG_MS)
    bench.save_record(tmp_path / "by-hand.csv")
    qtbot.waitUntil(lambda: not seen(window, "disappeared"), timeout=LONG_MS)
    assert seen(window, "Saved")
