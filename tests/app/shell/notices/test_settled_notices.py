"""Notices of the window go as soon as their cause is resolved."""

from rotemina.app.motion.state import ConnectionState
from rotemina.drivers.contract import ConnectionLostError
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.trajectory import make_example

LONG_MS = 30_000
LOST = message("engine", "{url}: the port has disappeared").fill(url="COM9")


class UnpluggableSimulator(Simulator):
    """A simulator whose link can be cut."""

    cut = False

    def _read(self):
        if self.cut:
            raise ConnectionLostError(LOST)
        return super()._read()


def get_notice_texts(window):
    return [notice.text for notice in window.notices.notices()]


def has_notice(window, part):
    return any(part in text for text in get_notice_texts(window))


def test_a_lost_link_notice_goes_when_the_link_is_back_or_another_device_is_used(
    make_robot_window, qtbot
):
    window = make_robot_window(driver=UnpluggableSimulator)
    bench, session = window.workbench, window.workbench.session
    for restore_link in (bench.reconnect, lambda: bench.use_driver(Simulator, {})):
        qtbot.waitUntil(
            lambda: session.snapshot().connection is ConnectionState.CONNECTED, timeout=LONG_MS
        )
        session.driver.cut = True
        qtbot.waitUntil(lambda: has_notice(window, "disappeared"), timeout=LONG_MS)
        session.driver.cut = False
        restore_link()
        qtbot.waitUntil(lambda: not has_notice(window, "disappeared"), timeout=LONG_MS)
    assert type(session.driver) is Simulator


def test_a_refusal_goes_with_the_next_accepted_action(qtbot, window):
    bench = window.workbench
    bench.emergency_stop()
    for _ in range(2):
        bench.jog("x", 1e-5)
    assert [notice.count for notice in window.notices.notices()] == [2]
    bench.release()
    bench.jog("x", 1e-5)
    assert get_notice_texts(window) == []
    bench.go_to({"x": 99.0})
    assert len(get_notice_texts(window)) == 1
    window.notices._clock = lambda: 1e12  # much later
    bench.jog("x", 1e-5)
    assert get_notice_texts(window) == []


def test_finished_work_settles_only_its_own_failure(qtbot, window, tmp_path):
    bench = window.workbench
    finished = []

    def fail():
        raise ConnectionLostError(LOST)

    for kind in ("one", "other"):  # for the same reason, so it is one notice
        bench.work(kind, "", fail, finished.append)
    qtbot.waitUntil(
        lambda: [notice.count for notice in window.notices.notices()] == [2], timeout=LONG_MS
    )
    for kind, remains in (("one", True), ("other", False)):
        bench.work(kind, "", lambda kind=kind: kind, finished.append)
        qtbot.waitUntil(lambda kind=kind: finished[-1:] == [kind], timeout=LONG_MS)
        assert has_notice(window, "disappeared") is remains


def test_a_missing_trajectory_and_an_unsaved_record_are_settled_by_loading_and_saving(
    qtbot, window, tmp_path, monkeypatch
):
    def refuse(*_):
        raise InputError(LOST)

    monkeypatch.setattr("rotemina.app.workbench.played_records.write_playback", refuse)
    bench = window.workbench
    bench.play()
    assert has_notice(window, "no trajectory to play")
    bench.plan_trajectory("first", make_example(bench.robot).select_rows(slice(0, 100)))
    qtbot.waitUntil(lambda: bench.plan is not None, timeout=LONG_MS)
    qtbot.waitUntil(lambda: not has_notice(window, "no trajectory to play"), timeout=LONG_MS)
    bench.play()
    qtbot.waitUntil(lambda: has_notice(window, "disappeared"), timeout=LONG_MS)
    bench.records.save_record(tmp_path / "by-hand.csv")
    qtbot.waitUntil(lambda: not has_notice(window, "disappeared"), timeout=LONG_MS)
    assert has_notice(window, "Saved")
