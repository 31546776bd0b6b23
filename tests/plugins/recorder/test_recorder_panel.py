"""The recorder panel: a move of the stick is recorded, replayed, exported and played again."""

import errno

import pytest
from PySide6.QtCore import Qt, QTimer

from rotemina.app.motion.recording import Recording
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.recorder.recording_controls import AT_START_SETTING
from rotemina.sim.records import Tap, read_record

LONG_MS = 30_000


def click(qtbot, button):
    qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def list_notices(window):
    return [notice.text for notice in window.notices.notices()]


def raise_panel(window):
    window.docks["recorder"].raise_()
    return window.panels["recorder"]


def record_a_move(qtbot, window):
    """Record a move of x by the pad; return its first and last position."""
    operation, session = window.workbench.operation, window.workbench.session
    section = raise_panel(window).recording
    assert not section.note_field.isEnabled()
    click(qtbot, section.record)
    qtbot.waitUntil(lambda: section.record.text() == "■ End recording", timeout=LONG_MS)
    # The header may hide the chip of the recording for lack of space.
    qtbot.waitUntil(lambda: operation.recording is not None, timeout=LONG_MS)
    start = session.snapshot().command["x"]
    pad_timer = QTimer(interval=20)
    pad_timer.timeout.connect(lambda: operation.pad.deflect("x", 0.8))
    pad_timer.start()
    qtbot.waitUntil(lambda: session.snapshot().command["x"] > start + 2e-5, timeout=LONG_MS)
    pad_timer.stop()
    operation.pad.release_all()
    latest_command = [start, 0.0]  # the latest command, and the time since it is constant

    def has_rested():
        state = session.snapshot()
        if state.command["x"] != latest_command[0] or state.activity is not DeviceState.IDLE:
            latest_command[:] = state.command["x"], state.device_time_s
        # This is longer than any speed command stays valid.
        return state.device_time_s > latest_command[1] + 0.2

    qtbot.waitUntil(has_rested, timeout=LONG_MS)
    assert not section.note_button.isEnabled()
    assert "type a remark first" in section.note_button.toolTip()
    qtbot.keyClick(section.note_field, Qt.Key.Key_Return)
    assert list_notices(window)[0] == "Nothing was noted: type a remark first."
    qtbot.keyClicks(section.note_field, "moved by hand")
    assert section.note_button.isEnabled()  # without a refresh
    qtbot.keyClick(section.note_field, Qt.Key.Key_Return)
    assert section.note_field.text() == ""
    noted_s = session.snapshot().device_time_s
    later = noted_s + 0.1  # the recording must include the constant last command
    qtbot.waitUntil(lambda: session.snapshot().device_time_s > later, timeout=LONG_MS)
    click(qtbot, section.record)
    qtbot.waitUntil(lambda: operation.recording is None, timeout=LONG_MS)
    qtbot.waitUntil(window._bar.recording.isHidden, timeout=LONG_MS)
    return start, session.snapshot().command["x"]


def replay_to_the_note(qtbot, window, reached):
    """Open the only recording, jump to its note, and end the section there."""
    replaying, panel = window.workbench.replaying, raise_panel(window)
    qtbot.waitUntil(lambda: len(panel.recordings.table.entries_model.entries) == 1, timeout=LONG_MS)
    panel.recordings.table.selectRow(0)
    session = window.workbench.session  # recordings cannot be opened during motion

    def is_at_rest():
        state = session.snapshot()
        return state.activity is DeviceState.IDLE and not state.queued

    qtbot.waitUntil(is_at_rest, timeout=LONG_MS)
    with qtbot.waitSignal(replaying.changed, timeout=LONG_MS):
        click(qtbot, panel.recordings.open)
    replaying.paced.pause()
    assert panel.tabs.currentIndex() == 0  # the current tab stays
    assert panel.news.is_new(1)
    panel.tabs.setCurrentIndex(1)
    row = [event.text for event in panel.events.model.events].index("moved by hand")
    panel.events.jump_to_event(row)
    expected = pytest.approx(reached)
    source = window.workbench.source
    qtbot.waitUntil(lambda: source.snapshot().command.get("x") == expected, timeout=LONG_MS)
    table = panel.events.table
    qtbot.waitUntil(lambda: table.currentIndex().row() == row, timeout=LONG_MS)
    click(qtbot, panel.recordings.end_here)
    assert float(panel.recordings.end.text()) == pytest.approx(replaying.paced.position_s, abs=1e-3)
    click(qtbot, window.replay_bar.live)


def test_a_move_of_the_stick_is_recorded_replayed_exported_and_played_again(
    qtbot, window, tmp_path
):
    workbench, view = window.workbench, window.panels["recorder"].recordings
    start, reached = record_a_move(qtbot, window)
    replay_to_the_note(qtbot, window, reached)

    view.export_section(view.selected_entry, tmp_path / "part.csv")
    qtbot.waitUntil(
        lambda: any("Exported" in notice for notice in list_notices(window)), timeout=LONG_MS
    )
    record = read_record(tmp_path / "part.csv")
    assert record.duration_s == pytest.approx(float(view.end.text()), abs=0.2)
    assert record.signal("x", Tap.CMD)[-1] == pytest.approx(reached)
    view.export_section(view.selected_entry, view.selected_entry.path)
    message = "it is the recording itself"
    qtbot.waitUntil(
        lambda: any(message in notice for notice in list_notices(window)), timeout=LONG_MS
    )

    with qtbot.waitSignal(workbench.plan_changed, timeout=LONG_MS):
        click(qtbot, view.trajectory_button)
    commands = workbench.plan.trajectory.signal("x", Tap.CMD)
    assert commands[[0, -1]] == pytest.approx([start, reached])
    with qtbot.waitSignal(workbench.run_changed, timeout=LONG_MS):
        workbench.play()
    assert workbench.run.record.signal("x", Tap.CMD)[-1] == pytest.approx(reached, abs=1e-7)


def test_after_a_crash_files_are_recovered_and_a_full_disk_is_reported(
    qtbot, make_robot_window, make_recording, settings, tmp_path, monkeypatch
):
    folder = tmp_path / "recordings"
    busy = make_recording(folder / "busy.arrows", ended=False).with_name("busy.arrows.part")
    (folder / "crashed.arrows.part").write_bytes(busy.read_bytes())
    settings.set(AT_START_SETTING, True)
    window = make_robot_window()
    panel, operation = raise_panel(window), window.workbench.operation
    qtbot.waitUntil(lambda: operation.recording is not None, timeout=LONG_MS)
    writer = operation.recording.writer

    # Files left by a crash and recordings of other programs are listed, but not the own recording.
    qtbot.waitUntil(panel.interrupted.isVisible, timeout=LONG_MS)
    assert "crashed.arrows.part" in panel.interrupted.text.text()
    assert "Another program is recording busy.arrows.part" in panel.interrupted.text.text()
    assert writer.path.name not in panel.interrupted.text.text()
    assert list_notices(window) == [
        "Interrupted recordings: crashed.arrows.part. Recover them in the panel Recorder."
    ]
    click(qtbot, panel.interrupted.recover)
    qtbot.waitUntil(lambda: len(panel.recordings.table.entries_model.entries) == 1, timeout=LONG_MS)
    assert list_notices(window)[0] == "Recovered crashed.arrows"
    qtbot.waitUntil(panel.interrupted.recover.isHidden, timeout=LONG_MS)
    panel.recordings.table.selectRow(0)
    panel.recordings.begin.setText("1,5")
    click(qtbot, panel.recordings.trajectory_button)
    assert "start: '1,5' is not valid" in list_notices(window)[0]

    # A full disk is reported and shown until there is free space.
    def fail_with_full_disk(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(writer._file, "append", fail_with_full_disk)
        complaint = panel.recording.complaint
        qtbot.waitUntil(complaint.isVisible, timeout=LONG_MS)
        assert "The recording has failed: No space left" in complaint.text()
        recording_indicator = window._bar.recording
        qtbot.waitUntil(lambda: recording_indicator.property("tone") == "danger", timeout=LONG_MS)
        qtbot.waitUntil(lambda: "the motion continues" in list_notices(window)[0], timeout=LONG_MS)
    qtbot.waitUntil(complaint.isHidden, timeout=LONG_MS)

    window.workbench.close()
    assert Recording.open(writer.path).count > 0
    assert list(folder.glob("*.part")) == [busy]
