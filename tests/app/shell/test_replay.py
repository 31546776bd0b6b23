"""A recording in place of the machine: seen, steered by the banner, and never mistaken for it."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.shell.replaying import opened, remark
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.file import load_robot

PANELS = ("plots",)

LONG_MS = 30_000
ROBOT = load_robot("rotemina")


@pytest.fixture
def recording(make_recording, tmp_path):
    return make_recording(tmp_path / "run.arrows")


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def show(qtbot, window, path):
    """Open a recording and hold it."""
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
    paced = show(qtbot, window, recording)
    assert bar.isVisible()
    assert bar.title.text() == "Replay, not the machine: run"
    seek(qtbot, window, 0.25)  # in mid-move
    assert bar.phase.text() == "Moving"
    assert bar.time.text() == "0:00.2 / 0:01.2"
    assert window._bar.phase.text() == "Locked"  # the machine's own
    assert window._bar.doing.text().startswith("A replay of run.arrows is displayed")
    seek(qtbot, window, 1.1)
    row = window.panels["control"].rows["x"]
    qtbot.waitUntil(lambda: row._readout.text().startswith("28.000"), timeout=LONG_MS)
    assert not row.plus.isEnabled()
    curve = window.panels["plots"].plots["x"].plot._curves["command"]  # plots are drawn in turn
    qtbot.waitUntil(lambda: curve.getData()[1].max() == pytest.approx(28.0), timeout=LONG_MS)
    assert curve.getData()[1].min() == pytest.approx(27.5)
    # Neither a panel, nor a menu, nor a stick moves what nobody sees; a stop goes through.
    before = bench.session.stop_asked_s
    bench.jog("y", 1e-3)
    bench.home()
    assert all("a replay of run.arrows is displayed" in text for text in notices(window)[:2])
    with pytest.raises(RefusedError, match="go back to live"):
        bench.session.move_velocity({"y": 1e-3}, owner="joystick")
    qtbot.mouseClick(window.stop_button, Qt.MouseButton.LeftButton)
    assert bench.session.stop_asked_s != before
    # The timeline jumps where it is clicked, the speed and Play are the banner's.
    line = bar.timeline
    qtbot.mouseClick(
        line, Qt.MouseButton.LeftButton, pos=QPoint(line.width() // 2, line.height() // 2)
    )
    assert paced.at_s == pytest.approx(0.6, abs=0.05)
    bar.speed.setCurrentIndex(bar.speed.findData(0.1))
    assert paced.speed == 0.1
    qtbot.mouseClick(bar.play, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: paced.at_s > 0.65, timeout=LONG_MS)
    window.panels["plots"].pause.setChecked(True)
    qtbot.mouseClick(bar.live, Qt.MouseButton.LeftButton)
    assert bench.source is bench.session
    assert bar.isHidden()
    assert not window.panels["plots"].pause.isChecked()  # no picture of the replay stays
    qtbot.waitUntil(lambda: row._readout.text().startswith("27.500"), timeout=LONG_MS)
    # A machine that moves is not hidden.
    bench.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: bench.session.snapshot().activity is DeviceState.MOVING)
    bench.open_replay(recording)
    qtbot.waitUntil(
        lambda: any("the machine is moving" in text for text in notices(window)), timeout=LONG_MS
    )
    assert bench.source is bench.session
    assert bench.session.snapshot().locked is None
    bench.stop()


def test_a_recording_of_another_robot_comes_with_the_command_that_shows_it(
    make_recording, tmp_path
):
    path = make_recording(tmp_path / "its run.arrows", "fsm")
    with pytest.raises(RecordingError, match="rotemina --robot") as refused:
        opened(path, ROBOT)
    assert f"info --robot-file '{path}' > robot.toml" in str(refused.value)
    assert np.isfinite(opened(path, load_robot("fsm")).recording.ended_s)


def test_another_robot_file_with_the_same_axes_is_remarked(recording):
    replay = opened(recording, ROBOT)
    assert remark(replay, replay.robot) is None
    replay.recording.metadata = {**replay.recording.metadata, "robot_file": "other"}
    assert "recorded with another robot file" in remark(replay, ROBOT)
