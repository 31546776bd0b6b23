"""Job and Events in a window: what runs, pause and stop, and what has happened."""

from pathlib import Path

from rotemina.app.motion.compared_run import compared
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.penetration.status import PenetrationStatus, Phase
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import SessionState
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.job import words
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.first_trajectory import example_for

PANELS = ("events",)
LONG_MS = 30_000


def test_what_runs_is_told_with_its_share_and_the_time_that_is_left():
    robot = load_robot("rotemina")
    playing = PlaybackState(
        PlaybackPhase.PLAYING, row=1999, rows=8001, path_s=2.0, duration_s=8.0, speed=0.5
    )
    told = words.playback(playing, "tour", robot)
    assert told == ("tour", "row 2000 of 8001", "0:12 left", 0.25)
    moved = PlaybackState(PlaybackPhase.PAUSED, rows=8001, moved={"x": 2.7e-3})
    assert words.playback(moved, "tour", robot).doing == "X moved 2.7 mm since the pause"
    assert words.playback(PlaybackState(), "", robot) == ("No trajectory is loaded", "", "", None)
    assert words.penetration(PenetrationStatus()) is None
    held = words.penetration(PenetrationStatus(Phase.HELD, reason="stopped"))
    assert held[:2] == ("held", "stopped")
    lost = words.recording(Path("d/a.arrows"), 61.0, 2_000_000, "no space")
    assert lost[:3] == ("a.arrows", "not recording: no space", "1:01")
    moving = SessionState(activity=DeviceState.MOVING, owners={"x": OPERATOR})
    assert words.motion(moving).name == "Operator moves X"
    assert words.motion(SessionState(activity=DeviceState.PLAYING)) is None


def test_a_playback_and_a_recording_are_steered_and_told(qtbot, window):
    bench, job, events = window.workbench, window.panels["job"], window.panels["events"]
    window.bring_up("events")
    window.bring_up("job")
    qtbot.waitUntil(lambda: job.playback.name.text() == "No trajectory is loaded", timeout=LONG_MS)
    assert not job.play.isEnabled()
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("tour", example_for(bench.robot))
    bench.operation.start_recording({})
    bench.jog("x", 1e-5)
    qtbot.waitUntil(
        lambda: any("27.5100 mm" in one.text for one in events.journal.entries), timeout=LONG_MS
    )
    qtbot.waitUntil(job.play.isEnabled, timeout=LONG_MS)
    job.play.click()
    qtbot.waitUntil(lambda: job.playback.bar.value() > 0, timeout=LONG_MS)
    assert job.play.text() == "Pause"
    assert not job.play.isEnabled()  # so soon, a press would have been meant for Play
    qtbot.waitUntil(job.play.isEnabled, timeout=LONG_MS)
    job.play.click()
    qtbot.waitUntil(lambda: "paused" in job.playback.doing.text(), timeout=LONG_MS)
    assert job.recording.isVisibleTo(job)
    job.end.click()
    qtbot.waitUntil(lambda: job.playback.doing.text() == "loaded", timeout=LONG_MS)
    job.end_recording.click()
    qtbot.waitUntil(lambda: not job.recording.isVisibleTo(job), timeout=LONG_MS)
    bench.run_changed.emit(compared(bench.session.model, "tour", bench.record))
    assert not job.result.isHidden()
    assert job.result.gaps.count() == len(bench.robot.axes)
    said = " | ".join(one.text for one in events.journal.entries)
    for text in ("Playing tour", "is paused at row", "tour ended", ".arrows ended"):
        assert text in said
    window.bring_up("events")

    def listed():
        return [events.list.item(row).text() for row in range(events.list.count())]

    qtbot.waitUntil(lambda: "✓ Saved the recording " in " ".join(listed()[:2]), timeout=LONG_MS)
    assert len(listed()) == len(events.journal.entries)
