"""A replay is controlled by its banner and cannot be mistaken for the machine."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt

from rotemina.app.errors import RecordingError, RequestRefusedError
from rotemina.app.workbench.recording_replay import find_mismatch, open_recording
from rotemina.drivers.contract import DeviceState
from rotemina.sim.robot_files import load_robot

PANELS = ("plots",)

LONG_MS = 30_000
ROBOT = load_robot("rotemina")


@pytest.fixture
def recording(make_recording, tmp_path):
    return make_recording(tmp_path / "run.arrows")


def get_notice_texts(window):
    return [notice.text for notice in window.notices.notices()]


def open_paused(qtbot, window, path):
    """Open a recording and pause it."""
    with qtbot.waitSignal(window.workbench.replaying.changed, timeout=LONG_MS):
        window.workbench.open_replay(path)
    paced = window.workbench.replaying.paced
    paced.pause()
    return paced


def seek(qtbot, window, at_s):
    window.workbench.replaying.paced.seek(at_s)
    qtbot.waitSignals([window.workbench.shown] * 2, timeout=LONG_MS).wait()


def test_panels_show_the_replay_and_the_tool_bar_the_machine(qtbot, window, recording):
    bench, bar = window.workbench, window.replay_bar
    assert bar.isHidden()
    paced = open_paused(qtbot, window, recording)
    assert bar.isVisible()
    assert bar.title.text() == "Replay, not the machine: run"
    seek(qtbot, window, 0.25)  # in the middle of a move
    assert bar.phase.text() == "Moving"
    assert bar.time.text() == "0:00.2 / 0:01.2"
    assert window._bar.phase.text() == "Locked"  # the state of the machine
    assert window._bar.reason_label.text().startswith("A replay of run.arrows is displayed")
    seek(qtbot, window, 1.1)
    row = window.panels["control"].rows["x"]
    qtbot.waitUntil(lambda: row._readout.text().startswith("28.000"), timeout=LONG_MS)
    assert not row.plus.isEnabled()
    # Plots are drawn one after another.
    curve = window.panels["plots"].plots["x"].plot._curves["command"]
    qtbot.waitUntil(lambda: curve.getData()[1].max() == pytest.approx(28.0), timeout=LONG_MS)
    assert curve.getData()[1].min() == pytest.approx(27.5)
    # No panel, menu or joystick can move the hidden machine; a stop still works.
    before = bench.session.stop_requested_s
    bench.jog("y", 1e-3)
    bench.home()
    assert all(
        "a replay of run.arrows is displayed" in text for text in get_notice_texts(window)[:2]
    )
    with pytest.raises(RequestRefusedError, match="go back to live"):
        bench.session.move_velocity({"y": 1e-3}, owner="joystick")
    qtbot.mouseClick(window.stop_button, Qt.MouseButton.LeftButton)
    assert bench.session.stop_requested_s != before
    # The banner controls position, speed and Play.
    line = bar.timeline
    qtbot.mouseClick(
        line, Qt.MouseButton.LeftButton, pos=QPoint(line.width() // 2, line.height() // 2)
    )
    assert paced.position_s == pytest.approx(0.6, abs=0.05)
    bar.speed.setCurrentIndex(bar.speed.findData(0.1))
    assert paced.speed == 0.1
    qtbot.mouseClick(bar.play, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: paced.position_s > 0.65, timeout=LONG_MS)
    window.panels["plots"].pause.setChecked(True)
    qtbot.mouseClick(bar.live, Qt.MouseButton.LeftButton)
    assert bench.source is bench.session
    assert bar.isHidden()
    assert not window.panels["plots"].pause.isChecked()  # so no plot of the replay remains
    qtbot.waitUntil(lambda: row._readout.text().startswith("27.500"), timeout=LONG_MS)
    # A moving machine is never hidden.
    bench.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: bench.session.snapshot().activity is DeviceState.MOVING)
    bench.open_replay(recording)
    qtbot.waitUntil(
        lambda: any("the machine is moving" in text for text in get_notice_texts(window)),
        timeout=LONG_MS,
    )
    assert bench.source is bench.session
    assert bench.session.snapshot().lock_reason is None
    bench.stop()


def test_a_recording_of_another_robot_is_refused_with_the_command_to_show_it(
    make_recording, tmp_path
):
    path = make_recording(tmp_path / "its run.arrows", "fsm")
    with pytest.raises(RecordingError, match="rotemina --robot") as error:
        open_recording(path, ROBOT)
    assert f"info --robot-file '{path}' > robot.toml" in str(error.value)
    assert np.isfinite(open_recording(path, load_robot("fsm")).recording.ended_s)


def test_another_robot_file_with_the_same_axes_is_reported(recording):
    replay = open_recording(recording, ROBOT)
    assert find_mismatch(replay, replay.robot) is None
    replay.recording.metadata = {**replay.recording.metadata, "robot_file": "other"}
    assert "recorded with another robot file" in find_mismatch(replay, ROBOT)
