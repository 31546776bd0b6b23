"""The recorder as an operator meets it: from a stick's move to the same move played again."""

import errno

import pytest
from PySide6.QtCore import Qt, QTimer

from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.recorder.recording_controls import AT_START
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap

LONG_MS = 30_000


def click(qtbot, button):
    qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def shown(window):
    window.docks["recorder"].raise_()
    return window.panels["recorder"]


def record_a_move(qtbot, window):
    """Move x by the pad while it is recorded; return where it began and came to rest."""
    operation, session = window.workbench.operation, window.workbench.session
    section = shown(window).recording
    assert not section.note.isEnabled()
    click(qtbot, section.record)
    qtbot.waitUntil(lambda: section.record.text() == "■ End recording", timeout=LONG_MS)
    qtbot.waitUntil(window._bar.recording.isVisible, timeout=LONG_MS)
    start = session.snapshot().command["x"]
    hand = QTimer(interval=20)
    hand.timeout.connect(lambda: operation.pad.deflect("x", 0.8))
    hand.start()
    qtbot.waitUntil(lambda: session.snapshot().command["x"] > start + 2e-5, timeout=LONG_MS)
    hand.stop()
    operation.pad.release_all()
    stands = [start, 0.0]  # the latest command, and since when

    def rests():
        now = session.snapshot()
        if now.command["x"] != stands[0] or now.activity is not DeviceState.IDLE:
            stands[:] = now.command["x"], now.device_time_s
        return now.device_time_s > stands[1] + 0.2  # no lease of a speed lasts so long

    qtbot.waitUntil(rests, timeout=LONG_MS)
    section.note.setText("moved by hand")
    qtbot.keyClick(section.note, Qt.Key.Key_Return)
    assert section.note.text() == ""
    noted_s = session.snapshot().device_time_s
    later = noted_s + 0.1  # the last command must have stood before the end
    qtbot.waitUntil(lambda: session.snapshot().device_time_s > later, timeout=LONG_MS)
    click(qtbot, section.record)
    qtbot.waitUntil(window._bar.recording.isHidden, timeout=LONG_MS)
    return start, session.snapshot().command["x"]


def replay_to_the_note(qtbot, window, reached):
    """Show the one recording, jump to its note, and let the stretch end there."""
    replaying, panel = window.workbench.replaying, shown(window)
    qtbot.waitUntil(lambda: len(panel.recordings.table.entries_model.entries) == 1, timeout=LONG_MS)
    panel.recordings.table.selectRow(0)
    session = window.workbench.session  # which shows no recording while it moves

    def stands():
        now = session.snapshot()
        return now.activity is DeviceState.IDLE and not now.queued

    qtbot.waitUntil(stands, timeout=LONG_MS)
    with qtbot.waitSignal(replaying.changed, timeout=LONG_MS):
        click(qtbot, panel.recordings.open)
    replaying.paced.pause()
    assert panel.tabs.currentIndex() == 0  # the tab under the mouse stays
    assert panel.news.is_new(1)
    panel.tabs.setCurrentIndex(1)
    row = [one.text for one in panel.events.model.events].index("moved by hand")
    panel.events.jump(row)
    there = pytest.approx(reached)
    source = window.workbench.source
    qtbot.waitUntil(lambda: source.snapshot().command.get("x") == there, timeout=LONG_MS)
    table = panel.events.table
    qtbot.waitUntil(lambda: table.currentIndex().row() == row, timeout=LONG_MS)
    click(qtbot, panel.recordings.end_here)
    assert float(panel.recordings.end.text()) == pytest.approx(replaying.paced.at_s, abs=1e-3)
    click(qtbot, window.replay_bar.live)


def test_a_stick_moves_x_is_recorded_shown_exported_and_played_again(qtbot, window, tmp_path):
    bench, view = window.workbench, window.panels["recorder"].recordings
    start, reached = record_a_move(qtbot, window)
    replay_to_the_note(qtbot, window, reached)

    view.export(view.chosen, tmp_path / "part.csv")
    qtbot.waitUntil(lambda: any("Exported" in one for one in notices(window)), timeout=LONG_MS)
    record = read_record(tmp_path / "part.csv")
    assert record.duration_s == pytest.approx(float(view.end.text()), abs=0.2)
    assert record.signal("x", Tap.CMD)[-1] == pytest.approx(reached)
    view.export(view.chosen, view.chosen.path)
    why = "it is the recording itself"
    qtbot.waitUntil(lambda: any(why in one for one in notices(window)), timeout=LONG_MS)

    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        click(qtbot, view.to_trajectory)
    commands = bench.plan.trajectory.signal("x", Tap.CMD)
    assert commands[[0, -1]] == pytest.approx([start, reached])
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        bench.play()
    assert bench.run.record.signal("x", Tap.CMD)[-1] == pytest.approx(reached, abs=1e-7)


def test_a_start_after_a_crash_and_a_recording_that_ends_with_the_window(
    qtbot, make_robot_window, make_recording, settings, tmp_path, monkeypatch
):
    folder = tmp_path / "recordings"
    busy = make_recording(folder / "busy.arrows", ended=False).with_name("busy.arrows.part")
    (folder / "crashed.arrows.part").write_bytes(busy.read_bytes())
    settings.set(AT_START, True)
    window = make_robot_window()
    panel, operation = shown(window), window.workbench.operation
    qtbot.waitUntil(lambda: operation.recording is not None, timeout=LONG_MS)
    writer = operation.recording.writer

    # What a crash left is named, apart from what others record; its own is neither.
    qtbot.waitUntil(panel.unfinished.isVisible, timeout=LONG_MS)
    assert "crashed.arrows.part" in panel.unfinished.text.text()
    assert "Another program is recording busy.arrows.part" in panel.unfinished.text.text()
    assert writer.path.name not in panel.unfinished.text.text()
    assert notices(window) == [
        "Interrupted recordings: crashed.arrows.part. Recover them in the panel Recorder."
    ]
    click(qtbot, panel.unfinished.recover)
    qtbot.waitUntil(lambda: len(panel.recordings.table.entries_model.entries) == 1, timeout=LONG_MS)
    assert notices(window)[0] == "Recovered crashed.arrows"
    qtbot.waitUntil(panel.unfinished.recover.isHidden, timeout=LONG_MS)
    panel.recordings.table.selectRow(0)
    panel.recordings.begin.setText("1,5")
    click(qtbot, panel.recordings.to_trajectory)
    assert "start: '1,5' is not valid" in notices(window)[0]

    # A full disk is told, and seen, until there is room.
    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(writer._file, "append", full)
        complaint = panel.recording.complaint
        qtbot.waitUntil(complaint.isVisible, timeout=LONG_MS)
        assert "The recording has failed: No space left" in complaint.text()
        sign = window._bar.recording
        qtbot.waitUntil(lambda: sign.property("tone") == "danger", timeout=LONG_MS)
        qtbot.waitUntil(lambda: "the motion continues" in notices(window)[0], timeout=LONG_MS)
    qtbot.waitUntil(complaint.isHidden, timeout=LONG_MS)

    window.workbench.close()
    assert Recording.open(writer.path).count > 0
    assert list(folder.glob("*.part")) == [busy]


def test_an_empty_remark_is_asked_for(qtbot, window):
    section = shown(window).recording
    click(qtbot, section.record)
    qtbot.waitUntil(section.note.isEnabled, timeout=LONG_MS)
    assert not section.keep.isEnabled()
    assert "type a remark first" in section.keep.toolTip()
    qtbot.keyClick(section.note, Qt.Key.Key_Return)
    assert notices(window)[0] == "Nothing was noted: type a remark first."
    qtbot.keyClicks(section.note, "seen")
    assert section.keep.isEnabled()  # at once
