"""The control menu: every way to move an axis, and when it is refused."""

import re
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QRect, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication

from rotemina.app.motion.backlash import Approach
from rotemina.app.range_settings import kept_ranges
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.model import AxisEffect

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


def test_the_palette_offers_no_jog(qtbot, window):
    window.bring_up("control")
    qtbot.waitUntil(window.panels["control"].rows["x"].plus.isEnabled, timeout=LONG_MS)
    assert [e.text for e in window._entries() if e.what.endswith(("−", "+"))] == []


def changed_step_by_step(qtbot, window, page, begin):
    """Set load and work, change the pin by the guide; a stop and a lock stand in between."""
    session = window.workbench.session
    for name, at in (("load", begin["x"] + 2e-4), ("work", begin["x"])):
        session.go_to({"x": at})
        qtbot.waitUntil(lambda at=at: settled_at(session, "x", at, 1e-5), timeout=LONG_MS)
        qtbot.waitUntil(page.places[name].isEnabled, timeout=LONG_MS)
        page.places[name].click()
        assert page.places[name].text() == "Set here?"
        page.places[name].click()
    assert page.positions.kept["work"]["x"] == pytest.approx(begin["x"])
    page.change.click()
    guide = page._guide
    for number in range(7):
        qtbot.waitUntil(guide.do.isEnabled, timeout=LONG_MS)
        guide.do.click()
        qtbot.waitUntil(lambda number=number: guide.at > number, timeout=LONG_MS)
    floor = float("-inf")
    qtbot.waitUntil(guide.do.isEnabled, timeout=LONG_MS)
    guide.do.click()
    window.workbench.stop()  # withdraws the question
    guide.do.click()
    assert session.bounds.keep_out.floor == floor
    qtbot.waitUntil(lambda: guide.do.text() == "Teach here?" and guide.do.isEnabled())
    guide.do.click()
    qtbot.waitUntil(lambda: session.bounds.keep_out.floor > floor, timeout=LONG_MS)
    qtbot.waitUntil(guide.isHidden, timeout=LONG_MS)
    state = session.snapshot()
    assert state.command["z"] == session.robot.axes["z"].range[1]  # nothing came down by itself
    assert state.command["x"] == pytest.approx(begin["x"])
    assert state.latched is None
    session.bounds.clear_floor()


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
    changed_step_by_step(qtbot, window, page, begin)
    panel.tabs.setCurrentIndex(0)
    operation = window.workbench.operation
    qtbot.mouseClick(panel.hand.modes["nano"], Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: operation.teleoperator.state.mode == "nano", timeout=LONG_MS)
    qtbot.waitUntil(lambda: "nano" in panel.head.device.text(), timeout=LONG_MS)
    assert not panel.hand.over.isEnabled()
    panel.tabs.setCurrentIndex(3)
    page = panel.penetration
    assert "the run needs 62 µm" in page.message.text()
    panel.rows["zn"].target.setText("64")
    panel.rows["zn"].confirmation.take(64e-6, session.snapshot().command["zn"], -100.0)
    panel.rows["zn"]._go()
    qtbot.waitUntil(page.arm.isEnabled, timeout=LONG_MS)
    assert not page.button.isEnabled()
    qtbot.mouseClick(page.arm, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: page.arm.text() == "Disarm", timeout=LONG_MS)
    assert page.button.isEnabled()
    assert page.phase.text().startswith("armed")
    qtbot.waitUntil(lambda: session.snapshot().owners.get("x", "").startswith("penetration"))
    qtbot.mouseClick(page.arm, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: page.arm.text() == "Arm", timeout=LONG_MS)


@pytest.mark.parametrize("modifier", ["NoModifier", "ShiftModifier"])
def test_escape_withdraws_a_large_move_that_was_asked_about(
    qtbot, window, panel, press_escape, modifier
):
    session, row = window.workbench.session, panel.rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    before = session.snapshot().command["x"]
    row._clock = iter(range(0, 100, 10)).__next__  # no press is a double click
    qtbot.keyClicks(row.target, "2")
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    assert row.confirmation.asked is not None
    press_escape(row.target, Qt.KeyboardModifier[modifier])
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
    assert page.delete.text() == "Delete?"
    bench.stop()
    page._delete()
    assert "bench" in page.positions.kept


def test_cards_have_large_digits_and_labelled_ends_where_there_is_room(qtbot, window, panel):
    row, session = panel.rows["zn"], window.workbench.session
    parts = [row.status, row.difference, row._readout, row._bar, row.go, row.left]

    def all_in_sight():
        below = row.mapTo(panel, QPoint(0, row.height())).y()
        places = [QRect(one.mapTo(row, QPoint()), one.size()) for one in parts]
        assert below <= panel.tabs.mapTo(panel, QPoint()).y()
        assert all(row.rect().contains(place) for place in places), places
        assert not any(one.intersects(two) for one, two in combinations(places, 2)), places

    for width, height, digits, roomy in ((1920, 1080, 30, True), (1280, 800, 17, False)):
        window.resize(width, height)
        qtbot.waitUntil(all_in_sight, timeout=LONG_MS // 3)
        assert row._readout.font().pixelSize() == digits
        track = row._bar.track()
        assert (track.left() > 0 and track.right() < row._bar.width()) is roomy
    assert row._bar.ends == ("0", "65 µm")
    state = session.snapshot()
    cases = (0.0, "plain", "+0.000"), (4.7e-6, "apart", "+4.700"), (-2.4e-5, "beyond", "-24.000")
    for apart, grade, text in cases:
        measured = {**state.measured, "zn": state.command["zn"] + apart}
        row.refresh(replace(state, measured=measured, age_s=0.0))
        assert (row.difference.property("grade"), row.difference.text()) == (grade, text)
    row.show_range((2e-5, 4e-5), [(0.0, 1e-5)])
    assert not row.grab().toImage().isNull()


def test_a_range_is_narrowed_and_an_approach_is_chosen_on_the_page_of_axes(qtbot, window, panel):
    session, page, row = window.workbench.session, panel.axes, panel.rows["x"]
    panel.tabs.setCurrentIndex(panel.tabs.count() - 1)
    qtbot.waitUntil(page.narrow.isEnabled, timeout=LONG_MS)
    assert (page.low.text(), page.high.text()) == ("0.0000", "55.0000")
    page.high.setText("55.1")
    qtbot.mouseClick(page.narrow, Qt.MouseButton.LeftButton)
    assert "outside its range 0 mm to 55 mm" in window.notices.notices()[0].text
    page.low.setText("20")
    page.high.setText("30.5")
    qtbot.keyClick(page.high, Qt.Key.Key_Return)
    assert session.ranges.narrowed == {"x": (0.02, 0.0305)}
    assert kept_ranges(window.workbench.settings, session.robot) == {"x": (0.02, 0.0305)}
    qtbot.waitUntil(lambda: "20.0000 mm … 30.5000 mm" in row._bar.toolTip(), timeout=LONG_MS)
    assert row._bar._forbidden[:2] == ((0.0, 0.02), (0.0305, 0.055))
    qtbot.waitUntil(page.whole.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(page.whole, Qt.MouseButton.LeftButton)
    assert session.ranges.narrowed == kept_ranges(window.workbench.settings, session.robot) == {}
    assert page.high.text() == "55.0000"

    page.width_field.setText("0.9")
    page.side.setCurrentIndex(1)
    page.side.activated.emit(1)
    assert "at most 550 µm" in window.notices.notices()[0].text
    assert page.side.currentData() is None  # what is in use, not what was refused
    page.width_field.setText("0.02")
    page.side.setCurrentIndex(1)
    page.side.activated.emit(1)
    assert session.backlash.applied == {"x": Approach(2e-5, rising=True)}
    qtbot.waitUntil(lambda: row.name.text() == "X (↑)", timeout=LONG_MS)
    qtbot.waitUntil(row.plus.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(row.plus, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: row.name.text() == "X ↑", timeout=LONG_MS)
    assert not page.use_play.isEnabled()
    found = AxisEffect(axis="x", id="backlash", parameters={"width": 1e-6})
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    session.use_model(replace(session.model, id="corrected", effects=(found,)))
    qtbot.waitUntil(page.use_play.isEnabled, timeout=LONG_MS)
    assert page.play.text() == "Measured backlash: 0.0010 mm"
    qtbot.mouseClick(page.use_play, Qt.MouseButton.LeftButton)
    assert session.backlash.applied == {"x": Approach(pytest.approx(1.5e-6), rising=True)}
    page.axis.setCurrentIndex(page.axis.findData("zn"))
    page.refresh(session.snapshot())
    assert not page.side.isEnabled()
    assert not page.use_play.isVisible()
