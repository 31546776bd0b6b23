"""The control panel: all ways to move an axis, and when a move is refused."""

import re
from dataclasses import replace
from itertools import count

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication

from rotemina.app.motion.session import OneSidedApproach, load_ranges
from rotemina.drivers.contract import DeviceState
from rotemina.sim.robot import AxisEffect

LONG_MS = 30_000


@pytest.fixture
def panel(window):
    return window.panels["control"]


def is_settled_at(session, axis, position, tolerance):
    state = session.snapshot()
    idle = state.activity is DeviceState.IDLE
    return (
        idle
        and abs(state.command[axis] - position) < 1e-12
        and (abs(state.measured[axis] - position) < tolerance)
    )


def test_every_axis_shows_its_unit_and_moves_by_steps_and_to_typed_targets(qtbot, window, panel):
    qtbot.waitSignal(window.workbench.refreshed).wait()
    assert list(panel.rows) == ["x", "y", "z", "thx", "thy", "zn"]
    texts = {axis: row._readout.text() for axis, row in panel.rows.items()}
    # The last digit is one encoder step, so encoder noise may change it.
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
            lambda position=start + step, axis=axis: is_settled_at(session, axis, position, 5e-6),
            timeout=LONG_MS,
        )
        qtbot.mouseClick(row.minus, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(
            lambda position=start, axis=axis: is_settled_at(session, axis, position, 5e-6),
            timeout=LONG_MS,
        )
    row = panel.rows["z"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    qtbot.keyClicks(row.target, "40.25")
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: is_settled_at(session, "z", 0.04025, 1e-6), timeout=LONG_MS)
    # The palette offers no jog.
    assert [e.text for e in window._make_palette_entries() if e.title.endswith(("−", "+"))] == []


def test_invalid_targets_are_refused_and_a_large_move_must_be_confirmed(qtbot, window, panel):
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
    clock_s = [100.0]
    row._clock = lambda: clock_s[0]
    qtbot.keyClicks(row.target, "41.25")
    qtbot.waitUntil(lambda: row.status.text() == "to 41.2500 mm", timeout=LONG_MS)
    assert row.room_left.text() == "+13.7500 mm"
    repeated_enter = QKeyEvent(
        QEvent.Type.KeyPress, Qt.Key.Key_Return, Qt.KeyboardModifier.NoModifier, "", autorep=True
    )
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    clock_s[0] += 5.0
    # The auto-repeat of a held Enter is not a second press.
    QApplication.sendEvent(row.target, repeated_enter)
    qtbot.waitUntil(lambda: row.go.text() == "Move?", timeout=LONG_MS)
    assert session.snapshot().command["x"] == pytest.approx(0.0275)
    qtbot.keyClicks(row.target, "5")  # another number needs another confirmation
    qtbot.waitUntil(lambda: row.go.text() == "Go", timeout=LONG_MS)
    panel.overview.speed.choose_fraction(0.01)
    qtbot.mouseClick(row.go, Qt.MouseButton.LeftButton)
    clock_s[0] += 5.0
    qtbot.mouseClick(row.go, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    session.stop()
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    history = session.history.tail()
    speed = np.abs(np.diff(history.command[:, 0]) / np.diff(history.device_time_s)).max()
    assert speed <= 0.0101 * window.workbench.robot.axes["x"].max_speed  # the chosen 1 %


def test_a_held_button_jogs_until_release_and_rows_lock_without_a_device(qtbot, window, panel):
    session, row = window.workbench.session, panel.rows["x"]
    qtbot.waitUntil(row.plus.isEnabled, timeout=LONG_MS)
    panel.steps["micro"].choose_hold("m")
    panel.overview.speed.choose_fraction(0.1)
    start = session.snapshot().command["x"]
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow, timeout=LONG_MS)

    def is_halted():
        return session.snapshot().activity is DeviceState.IDLE and not row.hold_to_jog.is_active

    qtbot.mousePress(row.plus, Qt.MouseButton.LeftButton)
    assert row.hold_to_jog.is_active
    qtbot.waitUntil(lambda: session.snapshot().command["x"] > start + 1e-4, timeout=LONG_MS)
    qtbot.mouseRelease(row.plus, Qt.MouseButton.LeftButton)
    assert not row.hold_to_jog.is_active
    qtbot.waitUntil(is_halted, timeout=LONG_MS)
    # Hiding the dock while the button is held also ends the motion.
    qtbot.waitUntil(row.minus.isEnabled, timeout=LONG_MS)
    qtbot.mousePress(row.minus, Qt.MouseButton.LeftButton)
    assert row.hold_to_jog.is_active
    window.docks["control"].hide()
    qtbot.waitUntil(is_halted, timeout=LONG_MS)
    assert not window.notices.notices()
    window.workbench.session.close()
    qtbot.waitUntil(lambda: not row.plus.isEnabled(), timeout=LONG_MS)
    assert not row.go.isEnabled()
    assert row._readout.property("stale")


def change_pin_with_guide(qtbot, window, page, start):
    """Set the load and work positions and change the pin with the guide, with a stop in between."""
    session = window.workbench.session
    for name, position in (("load", start["x"] + 2e-4), ("work", start["x"])):
        session.go_to({"x": position})
        qtbot.waitUntil(
            lambda position=position: is_settled_at(session, "x", position, 1e-5), timeout=LONG_MS
        )
        qtbot.waitUntil(page.place_buttons[name].isEnabled, timeout=LONG_MS)
        page.place_buttons[name].click()
        assert page.place_buttons[name].text() == "Set here?"
        page.place_buttons[name].click()
    assert page.positions.positions["work"]["x"] == pytest.approx(start["x"])
    page.change.click()
    guide = page._guide
    for number in range(7):
        qtbot.waitUntil(guide.action_button.isEnabled, timeout=LONG_MS)
        guide.action_button.click()
        qtbot.waitUntil(lambda number=number: guide.step_index > number, timeout=LONG_MS)
    floor = float("-inf")
    qtbot.waitUntil(guide.action_button.isEnabled, timeout=LONG_MS)
    guide.action_button.click()
    window.workbench.stop()  # cancels the confirmation
    guide.action_button.click()
    assert session.bounds.keep_out.floor == floor
    qtbot.waitUntil(
        lambda: guide.action_button.text() == "Teach here?" and guide.action_button.isEnabled()
    )
    guide.action_button.click()
    qtbot.waitUntil(lambda: session.bounds.keep_out.floor > floor, timeout=LONG_MS)
    qtbot.waitUntil(guide.isHidden, timeout=LONG_MS)
    state = session.snapshot()
    assert state.command["z"] == session.robot.axes["z"].range[1]  # the guide never lowers the tip
    assert state.command["x"] == pytest.approx(start["x"])
    assert state.latch_reason is None
    session.bounds.clear_floor()


def test_the_pages_save_positions_change_modes_and_arm_a_penetration(qtbot, window, panel):
    session, page = window.workbench.session, panel.positions
    panel.tabs.setCurrentIndex(1)
    qtbot.keyClicks(page.name_field, "here")
    qtbot.waitUntil(page.save_button.isEnabled, timeout=LONG_MS)
    start = session.snapshot().command
    qtbot.mouseClick(page.save_button, Qt.MouseButton.LeftButton)
    assert page.name_choice.currentText() == "here"
    assert "X\u00a027.5000\u00a0mm" in page.position_text.text()
    session.jog("thx", 1e-5)
    qtbot.waitUntil(
        lambda: is_settled_at(session, "thx", start["thx"] + 1e-5, 1e-5), timeout=LONG_MS
    )
    qtbot.waitUntil(page.go.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(page.go, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: is_settled_at(session, "thx", start["thx"], 1e-5), timeout=LONG_MS)
    qtbot.mouseClick(page.delete, Qt.MouseButton.LeftButton)
    assert page.delete.text() == "Delete?"
    window.workbench.stop()  # cancels the question
    for count_left in (1, 0):
        qtbot.mouseClick(page.delete, Qt.MouseButton.LeftButton)
        assert page.name_choice.count() == count_left
    assert not page.positions.positions
    change_pin_with_guide(qtbot, window, page, start)
    panel.tabs.setCurrentIndex(0)
    operation = window.workbench.operation
    qtbot.mouseClick(panel.hand.modes["nano"], Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: operation.teleoperator.state.mode == "nano", timeout=LONG_MS)
    qtbot.waitUntil(lambda: "nano" in panel.overview.device.text(), timeout=LONG_MS)
    assert not panel.hand.take_over.isEnabled()
    panel.tabs.setCurrentIndex(3)
    page = panel.penetration
    assert "the run needs 62 µm" in page.message.text()
    panel.rows["zn"].target.setText("64")
    panel.rows["zn"].confirmation.request_permit(64e-6, session.snapshot().command["zn"], -100.0)
    panel.rows["zn"]._go_to_target()
    qtbot.waitUntil(page.arm.isEnabled, timeout=LONG_MS)
    assert not page.main_button.isEnabled()
    qtbot.mouseClick(page.arm, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: page.arm.text() == "Disarm", timeout=LONG_MS)
    assert page.main_button.isEnabled()
    assert page.phase.text().startswith("armed")
    qtbot.waitUntil(lambda: session.snapshot().owners.get("x", "").startswith("penetration"))
    qtbot.mouseClick(page.arm, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: page.arm.text() == "Arm", timeout=LONG_MS)


def test_escape_cancels_an_unconfirmed_large_move(qtbot, window, panel, press_escape):
    session, row = window.workbench.session, panel.rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    start = session.snapshot().command["x"]
    row._clock = count(0, 10).__next__  # no press counts as a double click
    for modifier in (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier):
        qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
        row.target.clear()
        qtbot.keyClicks(row.target, "2")
        qtbot.keyClick(row.target, Qt.Key.Key_Return)
        assert row.confirmation.unconfirmed_move is not None
        press_escape(row.target, modifier)
        session.release()
        qtbot.keyClick(row.target, Qt.Key.Key_Return)  # before the refresh after the stop
        state = session.snapshot()
        assert (state.command["x"], state.queued, dict(state.owners)) == (start, 0, {})
        row.confirmation.cancel()


def test_an_axis_card_grades_the_difference_between_command_and_reading(window, panel):
    row, state = panel.rows["zn"], window.workbench.session.snapshot()
    assert row._bar.end_texts == ("0", "65 µm")
    cases = (0.0, "plain", "+0.000"), (4.7e-6, "apart", "+4.700"), (-2.4e-5, "beyond", "-24.000")
    for deviation, grade, text in cases:
        measured = {**state.measured, "zn": state.command["zn"] + deviation}
        row.refresh(replace(state, measured=measured, age_s=0.0))
        assert (row.difference.property("grade"), row.difference.text()) == (grade, text)
    row.show_range((2e-5, 4e-5), [(0.0, 1e-5)])
    assert not row.grab().toImage().isNull()


def test_the_axes_page_narrows_a_range_and_sets_a_one_sided_approach(qtbot, window, panel):
    session, page, row = window.workbench.session, panel.axes, panel.rows["x"]
    panel.tabs.setCurrentIndex(panel.tabs.count() - 1)
    qtbot.waitUntil(page.narrow.isEnabled, timeout=LONG_MS)
    assert (page.low_field.text(), page.high_field.text()) == ("0.0000", "55.0000")
    page.high_field.setText("55.1")
    qtbot.mouseClick(page.narrow, Qt.MouseButton.LeftButton)
    assert "outside its range 0 mm to 55 mm" in window.notices.notices()[0].text
    page.low_field.setText("20")
    page.high_field.setText("30.5")
    qtbot.keyClick(page.high_field, Qt.Key.Key_Return)
    assert session.ranges.narrowed_ranges == {"x": (0.02, 0.0305)}
    assert load_ranges(window.workbench.settings, session.robot) == {"x": (0.02, 0.0305)}
    qtbot.waitUntil(lambda: "20.0000 mm … 30.5000 mm" in row._bar.toolTip(), timeout=LONG_MS)
    assert row._bar._forbidden[:2] == ((0.0, 0.02), (0.0305, 0.055))
    qtbot.waitUntil(page.restore.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(page.restore, Qt.MouseButton.LeftButton)
    assert (
        session.ranges.narrowed_ranges
        == load_ranges(window.workbench.settings, session.robot)
        == {}
    )
    assert page.high_field.text() == "55.0000"

    page.width_field.setText("0.9")
    page.side.setCurrentIndex(1)
    page.side.activated.emit(1)
    assert "at most 550 µm" in window.notices.notices()[0].text
    assert page.side.currentData() is None  # shows the setting in use, not the refused one
    page.width_field.setText("0.02")
    page.side.setCurrentIndex(1)
    page.side.activated.emit(1)
    assert session.backlash.applied == {"x": OneSidedApproach(2e-5, rising=True)}
    qtbot.waitUntil(lambda: row.name.text() == "X (↑)", timeout=LONG_MS)
    qtbot.waitUntil(row.plus.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(row.plus, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: row.name.text() == "X ↑", timeout=LONG_MS)
    assert not page.use_backlash.isEnabled()
    backlash = AxisEffect(axis="x", id="backlash", parameters={"width": 1e-6})
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    session.use_model(replace(session.model, id="corrected", effects=(backlash,)))
    qtbot.waitUntil(page.use_backlash.isEnabled, timeout=LONG_MS)
    assert page.backlash_text.text() == "Measured backlash: 0.0010 mm"
    qtbot.mouseClick(page.use_backlash, Qt.MouseButton.LeftButton)
    assert session.backlash.applied == {"x": OneSidedApproach(pytest.approx(1.5e-6), rising=True)}
    page.axis.setCurrentIndex(page.axis.findData("zn"))
    page.refresh(session.snapshot())
    assert not page.side.isEnabled()
    assert not page.use_backlash.isVisible()
