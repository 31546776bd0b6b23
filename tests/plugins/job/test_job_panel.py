"""The Job and Events panels: running jobs, pause and stop, and the list of events."""

from pathlib import Path

from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.penetration import PenetrationPhase, PenetrationStatus
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState, compare_with_model
from rotemina.app.motion.state import SessionState
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.job import words
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import make_example

PANELS = ("events",)
LONG_MS = 30_000


def test_jobs_are_described_with_progress_and_time_left():
    robot = load_robot("rotemina")
    playing = PlaybackState(
        PlaybackPhase.PLAYING, row=1999, rows=8001, path_s=2.0, duration_s=8.0, speed=0.5
    )
    job = words.describe_playback_job(playing, "tour", robot)
    assert job == ("tour", "row 2000 of 8001", "0:12 left", 0.25)
    moved_in_pause = PlaybackState(PlaybackPhase.PAUSED, rows=8001, moved={"x": 2.7e-3})
    assert (
        words.describe_playback_job(moved_in_pause, "tour", robot).activity
        == "X moved 2.7 mm since the pause"
    )
    assert words.describe_playback_job(PlaybackState(), "", robot) == (
        "No trajectory is loaded",
        "",
        "",
        None,
    )
    assert words.describe_penetration_job(PenetrationStatus()) is None
    held = words.describe_penetration_job(
        PenetrationStatus(PenetrationPhase.HELD, reason="stopped")
    )
    assert held[:2] == ("held", "stopped")
    failed_recording = words.describe_recording_job(Path("d/a.arrows"), 61.0, 2_000_000, "no space")
    assert failed_recording[:3] == ("a.arrows", "not recording: no space", "1:01")
    moving = SessionState(activity=DeviceState.MOVING, owners={"x": OPERATOR})
    assert words.describe_motion_job(moving).name == "Operator moves X"
    assert words.describe_motion_job(SessionState(activity=DeviceState.PLAYING)) is None


def test_a_playback_and_a_recording_are_controlled_and_listed(qtbot, window):
    workbench, job, events = window.workbench, window.panels["job"], window.panels["events"]
    window.bring_up("events")
    window.bring_up("job")
    qtbot.waitUntil(lambda: job.playback.name.text() == "No trajectory is loaded", timeout=LONG_MS)
    assert not job.play.isEnabled()
    with qtbot.waitSignal(workbench.plan_changed, timeout=LONG_MS):
        workbench.plan_trajectory("tour", make_example(workbench.robot))
    workbench.operation.start_recording({})
    workbench.jog("x", 1e-5)
    qtbot.waitUntil(
        lambda: any("27.5100 mm" in entry.text for entry in events.journal.entries), timeout=LONG_MS
    )
    qtbot.waitUntil(job.play.isEnabled, timeout=LONG_MS)
    job.play.click()
    qtbot.waitUntil(lambda: job.playback.bar.value() > 0, timeout=LONG_MS)
    assert job.play.text() == "Pause"
    assert not job.play.isEnabled()  # a press right now would be meant for Play
    qtbot.waitUntil(job.play.isEnabled, timeout=LONG_MS)
    job.play.click()
    qtbot.waitUntil(lambda: "paused" in job.playback.activity.text(), timeout=LONG_MS)
    assert job.recording.isVisibleTo(job)
    job.end.click()
    qtbot.waitUntil(lambda: job.playback.activity.text() == "loaded", timeout=LONG_MS)
    job.end_recording.click()
    qtbot.waitUntil(lambda: not job.recording.isVisibleTo(job), timeout=LONG_MS)
    workbench.run_changed.emit(
        compare_with_model(workbench.session.model, "tour", workbench.record)
    )
    assert not job.result.isHidden()
    assert job.result.gaps.count() == len(workbench.robot.axes)
    entry_texts = " | ".join(entry.text for entry in events.journal.entries)
    for text in ("Playing tour", "is paused at row", "tour ended", ".arrows ended"):
        assert text in entry_texts
    window.bring_up("events")

    def list_texts():
        return [events.entry_list.item(row).text() for row in range(events.entry_list.count())]

    qtbot.waitUntil(lambda: "✓ Saved the recording " in " ".join(list_texts()[:2]), timeout=LONG_MS)
    assert len(list_texts()) == len(events.journal.entries)
