"""The control menu: every way to move an axis, and when it is refused."""

import re

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication

from rotemina.drivers.samples import DeviceState

LONG_MS = 30_000


@pytest.fixture
def panel(window):
    return window.panels["control"]


def settled_at(session, axis, position, tolerance):
    state = session.snapshot()
    idle = state.activity is DeviceState.IDLE
    return (
        idle
        and abs(state.command[axis] - position) < 1e-12
        and (abs(state.measured[axis] - position) < tolerance)
    )


def test_every_axis_is_shown_with_its_unit_steps_and_goes_to_typed_targets(qtbot, window, panel):
    qtbot.waitSignal(window.workbench.refreshed).wait()
    assert list(panel.rows) == ["x", "y", "z", "thx", "thy", "zn"]
    texts = {axis: row._readout.text() for axis, row in panel.rows.items()}
    # The last digit is the encoder's step, which its noise may turn.
    assert re.fullmatch(r"27\.(4999|500[01]) mm", texts["x"])
    assert re.fullmatch(r"58\d\.\d µrad", texts["thx"])
    assert re.fullmatch(r"32\.[45]\d\d µm", texts["zn"])
    session = window.workbench.session
    for axis, step in (("x", 1e-5), ("thy", 1e-6), ("zn", 1e-8)):
        start = session.snapshot().command[axis]
        row = panel.rows[axis]
        qtbot.waitUntil(row.plus.isEnabled, timeout=LONG_MS)
        qtbot.mouseClick(row.plus, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(
            lambda at=start + step, axis=axis: settled_at(session, axis, at, 5e-6), timeout=LONG_MS
        )
        qtbot.mouseClick(row.minus, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(
            lambda at=start, axis=axis: settled_at(session, axis, at, 5e-6), timeout=LONG_MS
        )
    row = panel.rows["z"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    qtbot.keyClicks(row.target, "40.25")
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: settled_at(session, "z", 0.04025, 1e-6), timeout=LONG_MS)


def test_what_must_not_move_is_refused_and_a_large_move_is_confirmed(qtbot, window, panel):
    session, row = window.workbench.session, panel.rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(row.go, Qt.MouseButton.LeftButton)
    assert "is not a position" in window.notices.notices()[0].text
    qtbot.keyClicks(row.target, "2,8")
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    assert "decimal point" in window.notices.notices()[0].text
    row.target.clear()
    qtbot.keyClicks(row.target, "55.5")
    qtbot.mouseClick(row.go, Qt.MouseButton.LeftButton)
    notice = window.notices.notices()[0]
    assert "x" in notice.text
    assert "55 mm" in notice.text
    assert session.snapshot().command["x"] == pytest.approx(0.0275)
    row.target.clear()
    now = [100.0]
    row._clock = lambda: now[0]
    qtbot.keyClicks(row.target, "41.25")
    qtbot.waitUntil(lambda: row.status.text() == "to 41.2500 mm", timeout=LONG_MS)
    assert row.left.text() == "+13.7500 mm"
    held = QKeyEvent(
        QEvent.Type.KeyPress, Qt.Key.Key_Return, Qt.KeyboardModifier.NoModifier, "", autorep=True
    )
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    now[0] += 5.0
    QApplication.sendEvent(row.target, held)  # Enter that is held is no second press
    qtbot.waitUntil(lambda: row.go.text() == "Move?", timeout=LONG_MS)
    assert session.snapshot().command["x"] == pytest.approx(0.0275)
    qtbot.keyClicks(row.target, "5")  # another number is another question
    qtbot.waitUntil(lambda: row.go.text() == "Go", timeout=LONG_MS)
    panel.head.speed.choose(0.01)
    qtbot.mouseClick(row.go, Qt.MouseButton.LeftButton)
    now[0] += 5.0
    qtbot.mouseClick(row.go, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    session.stop()
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    window_ = session.history.tail()
    speed = np.abs(np.diff(window_.command[:, 0]) / np.diff(window_.device_time_s)).max()
    assert speed <= 0.0101 * window.workbench.robot.axes["x"].max_speed  # as was chosen


def test_an_axis_goes_while_its_button_is_held_and_all_lock_without_a_device(qtbot, window, panel):
    session, row = window.workbench.session, panel.rows["x"]
    qtbot.waitUntil(row.plus.isEnabled, timeout=LONG_MS)
    panel.steps["micro"].hold("m")
    panel.head.speed.choose(0.1)
    begin = session.snapshot().command["x"]
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow, timeout=LONG_MS)

    def halted():
        return session.snapshot().activity is DeviceState.IDLE and not row.holding.busy

    qtbot.mousePress(row.plus, Qt.MouseButton.LeftButton)
    assert row.holding.busy
    qtbot.waitUntil(lambda: session.snapshot().command["x"] > begin + 1e-4, timeout=LONG_MS)
    qtbot.mouseRelease(row.plus, Qt.MouseButton.LeftButton)
    assert not row.holding.busy
    qtbot.waitUntil(halted, timeout=LONG_MS)
    # Nor does it go on where its dock is hidden while it is held.
    qtbot.waitUntil(row.minus.isEnabled, timeout=LONG_MS)
    qtbot.mousePress(row.minus, Qt.MouseButton.LeftButton)
    assert row.holding.busy
    window.docks["control"].hide()
    qtbot.waitUntil(halted, timeout=LONG_MS)
    assert not window.notices.notices()
    window.workbench.session.close()
    qtbot.waitUntil(lambda: not row.plus.isEnabled(), timeout=LONG_MS)
    assert not row.go.isEnabled()
    assert row._readout.property("stale")


def test_the_palette_leaves_out_what_must_be_held(qtbot, window):
    steps = window.panels["control"].steps["micro"]

    def offered():
        return {one.what for one in window._entries() if one.where == "Control"}

    lengths, angles = {"X −", "X +", "Z −", "Z +"}, {"θx −", "θx +"}
    qtbot.waitUntil(lambda: lengths | angles <= offered(), timeout=LONG_MS)
    steps.hold("m")  # a click begins and ends at once: by the palette it would do nothing
    qtbot.waitUntil(lambda: not lengths & offered(), timeout=LONG_MS)
    assert angles <= offered()  # angles of the other stage still go step by step
    steps.boxes["m"].setCurrentIndex(0)
    qtbot.waitUntil(lambda: lengths <= offered(), timeout=LONG_MS)


def test_the_pages_keep_positions_change_modes_and_arm(qtbot, window, panel):
    session, page = window.workbench.session, panel.positions
    panel.tabs.setCurrentIndex(1)
    qtbot.keyClicks(page.name, "here")
    qtbot.waitUntil(page.keep.isEnabled, timeout=LONG_MS)
    begin = session.snapshot().command
    qtbot.mouseClick(page.keep, Qt.MouseButton.LeftButton)
    assert page.names.currentText() == "here"
    assert "X\u00a027.5000\u00a0mm" in page.place.text()
    session.jog("thx", 1e-5)
    qtbot.waitUntil(lambda: settled_at(session, "thx", begin["thx"] + 1e-5, 1e-5), timeout=LONG_MS)
    qtbot.waitUntil(page.go.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(page.go, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: settled_at(session, "thx", begin["thx"], 1e-5), timeout=LONG_MS)
    for presses_left in (1, 0):
        assert (page.names.count() == 0) is False
        qtbot.mouseClick(page.delete, Qt.MouseButton.LeftButton)
        assert page.names.count() == presses_left
    assert not page.positions.kept
    panel.tabs.setCurrentIndex(0)
    operation = window.workbench.operation
    qtbot.mouseClick(panel.hand.modes["nano"], Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: operation.teleoperator.state.mode == "nano", timeout=LONG_MS)
    qtbot.waitUntil(lambda: "nano" in panel.head.device.text(), timeout=LONG_MS)
    assert not panel.hand.over.isEnabled()
    panel.tabs.setCurrentIndex(3)
    page = panel.penetration
    assert "62 µm are needed" in page.message.text()
    panel.rows["zn"].target.setText("64")
    panel.rows["zn"].confirmation.take(64e-6, session.snapshot().command["zn"], -100.0)
    panel.rows["zn"]._go()
    qtbot.waitUntil(page.arm.isEnabled, timeout=LONG_MS)
    assert not page.button.isEnabled()
    qtbot.mouseClick(page.arm, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: page.arm.text() == "Disarm", timeout=LONG_MS)
    assert page.button.isEnabled()
    assert page.phase.text().startswith("armed")
    qtbot.waitUntil(lambda: panel.rows["x"].status.text().startswith("penetration"))
    qtbot.mouseClick(page.arm, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: page.arm.text() == "Arm", timeout=LONG_MS)


@pytest.mark.parametrize("modifier", ["NoModifier", "ShiftModifier"])
def test_escape_withdraws_a_large_move_that_was_asked_about(qtbot, window, panel, modifier):
    session, row = window.workbench.session, panel.rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    before = session.snapshot().command["x"]
    row._clock = iter(range(0, 100, 10)).__next__  # no press is a double click
    qtbot.keyClicks(row.target, "2")
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    assert row.confirmation.asked is not None
    qtbot.keyClick(row.target, Qt.Key.Key_Escape, Qt.KeyboardModifier[modifier])
    session.release()
    qtbot.keyClick(row.target, Qt.Key.Key_Return)  # before any refresh has seen the stop
    state = session.snapshot()
    assert (state.command["x"], state.queued, dict(state.owners)) == (before, 0, {})


def test_a_stop_withdraws_that_a_position_is_deleted(qtbot, panel, window):
    page, bench = panel.positions, window.workbench
    qtbot.waitUntil(lambda: bench.session.snapshot().position_known, timeout=LONG_MS)
    page.name.setText("bench")
    page._keep()
    page._delete()
    assert page.delete.text() == "Sure?"
    bench.stop()
    page._delete()
    assert "bench" in page.positions.kept
